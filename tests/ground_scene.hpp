// A ball and a box above a plane, as a formula and as meshes, and rays around them to a disc light.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/render.hpp"
#include "cotan/scene.hpp"

namespace cotan::test {

// The solids as a formula and as meshes: a ball, and a box that is as wide as it is deep.
struct Solids {
    glm::dvec3 ballCentre{-0.6, 0.9, 0.1};
    double ballRadius = 0.4;
    glm::dvec3 boxLow{0.3, 0, -0.4}, boxHigh{0.7, 1.2, 0};

    bool stop(const glm::dvec3& from, const glm::dvec3& d) const
    {
        const glm::dvec3 c = from - ballCentre;
        const double b = glm::dot(c, d), root = b * b - glm::dot(c, c) + ballRadius * ballRadius;
        if (root > 0 && -b + std::sqrt(root) > 0)
            return true;
        double first = 1e-6, last = 1e9;
        for (int i = 0; i < 3; ++i) {
            const double in = (boxLow[i] - from[i]) / d[i], out = (boxHigh[i] - from[i]) / d[i];
            first = std::max(first, std::min(in, out));
            last = std::min(last, std::max(in, out));
        }
        return first < last;
    }
};

inline void add(Scene& scene, Mesh mesh, const glm::mat4& toWorld)
{
    scene.materials.resize(1);
    scene.materials[0].metallic = 0;
    Instance instance;
    instance.mesh = int(scene.meshes.size());
    instance.toWorld = toWorld;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(instance);
}

inline glm::mat4 translationScale(const glm::dvec3& at, const glm::dvec3& size)
{
    glm::mat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i][i] = float(size[i]);
    m[3] = glm::vec4(glm::vec3(at), 1);
    return m;
}

inline Scene sceneOf(const Solids& solids)
{
    Scene scene;
    add(scene, makeSphere(1, 96), translationScale(solids.ballCentre, glm::dvec3(solids.ballRadius)));
    add(scene, makeCube(1, 1),
        translationScale((solids.boxLow + solids.boxHigh) / 2.0, solids.boxHigh - solids.boxLow));
    return scene;
}

inline constexpr float kSoftness = 0.12f;

inline View sunnyView()
{
    View view;
    view.environment = false;
    view.shadowSoftness = kSoftness;
    view.lights.resize(1);
    view.lights[0].direction = glm::normalize(glm::vec3(0.6f, -0.9f, -0.5f));
    return view;
}

// The fraction of unoccluded rays to a disc around the light.
inline double tracedTransmittance(const Solids& solids, const glm::dvec3& from, const glm::dvec3& toLight,
                                  double softness)
{
    const glm::dvec3 right = glm::normalize(glm::cross(toLight, glm::dvec3(0, 1, 0))), up = glm::cross(right, toLight);
    constexpr int kSide = 24;
    int seen = 0, passed = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double x = (2 * (i % kSide) + 1.0) / kSide - 1, y = (2 * (i / kSide) + 1.0) / kSide - 1;
        if (x * x + y * y > 1)
            continue;
        ++seen;
        passed += !solids.stop(from, glm::normalize(toLight + (right * x + up * y) * softness));
    }
    return double(passed) / seen;
}

inline std::vector<std::unique_ptr<Renderer>> renderers()
{
    std::vector<std::unique_ptr<Renderer>> all;
    all.push_back(*openRenderer("reference"));
    auto gpu = openRenderer("auto");
    if (gpu && (*gpu)->note.empty())
        all.push_back(std::move(*gpu));
    return all;
}

} // namespace cotan::test
