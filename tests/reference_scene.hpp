// Small hand-made scenes for the tests of the reference renderer, and their analytic results.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "cotan/frame.hpp"
#include "cotan/render.hpp"

namespace cotan::testing {

// A parallelogram with uv (0,0) at `origin`, (1,0) at origin + alongU, (0,1) at origin + alongV.
struct Patch {
    glm::dvec3 origin{-1, 1, 0};
    glm::dvec3 alongU{2, 0, 0};
    glm::dvec3 alongV{0, -2, 0}; // v runs down, as in glTF

    // Unit normal on the side from which the triangles are counterclockwise.
    glm::dvec3 normal() const { return glm::normalize(glm::cross(alongV, alongU)); }

    // Gradients of u and v in the plane: each is perpendicular to the other's edge.
    glm::dvec3 gradU() const
    {
        glm::dvec3 g = glm::cross(alongV, normal());
        return g / glm::dot(g, alongU);
    }
    glm::dvec3 gradV() const
    {
        glm::dvec3 g = glm::cross(normal(), alongU);
        return g / glm::dot(g, alongV);
    }

    // The perturbed normal if the longer gradient has length one (truth S); m is along (+u, +v, outwards).
    glm::dvec3 perturbed(glm::dvec3 m) const
    {
        double scale = 1 / std::max(glm::length(gradU()), glm::length(gradV()));
        return glm::normalize(normal() * m.z + (gradU() * m.x + gradV() * m.y) * scale);
    }
};

// A patch with square uv, so that every frame agrees on it.
inline const Patch kSquare;

inline Mesh meshOf(const Patch& p)
{
    Mesh mesh;
    for (int i = 0; i < 4; ++i) {
        double u = i & 1, v = i >> 1;
        mesh.positions.push_back(glm::vec3(p.origin + p.alongU * u + p.alongV * v));
        mesh.normals.push_back(glm::vec3(p.normal()));
        mesh.texcoords[0].push_back({u, v});
    }
    mesh.indices = {0, 2, 1, 1, 2, 3};
    return mesh;
}

// One instance of one mesh with a default material.
inline Scene sceneOf(Mesh mesh, glm::mat4 toWorld = glm::mat4(1))
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"", 0, toWorld});
    return scene;
}

inline Image solidImage(glm::ivec4 bytes, int size = 1)
{
    Image image = makeImage(size, size, PixelType::unorm8);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = std::byte(bytes[int(i % 4)]);
    return image;
}

// Gives material 0 a normal map of one colour, green along +v, in the exact expansion: code 128 + 127x means x.
inline void addNormalMap(Scene& scene, glm::ivec3 bytes)
{
    scene.images.push_back(solidImage({bytes, 255}));
    scene.materials[0].normalMap.image = int(scene.images.size()) - 1;
    scene.materials[0].normalFormat.greenUp = false;
}

// A small square view without lights, from (0,0,distance) towards the origin.
inline View viewOf(Output output, Frame frame = Frame::cotangent, float distance = 4)
{
    View view;
    view.width = view.height = 64;
    view.output = output;
    view.frame = frame;
    view.camera.eye = {0, 0, distance};
    return view;
}

inline Image rendered(const Scene& scene, const View& view, int threads = 0)
{
    Result<Image> result = renderReference(scene, view, threads);
    if (!result) {
        ADD_FAILURE() << result.error().message;
        return makeImage(view.width, view.height, PixelType::float32);
    }
    return std::move(*result);
}

inline glm::vec4 pixelOf(const Image& image, int x, int y)
{
    std::size_t at = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    glm::vec4 value;
    for (int c = 0; c < 4; ++c)
        value[c] = image.type == PixelType::float32 ? image.floats()[at + std::size_t(c)]
                                                    : float(image.bytes8()[at + std::size_t(c)]) / 255.0f;
    return value;
}

// Calls check(x, y, value) for every pixel with a surface; returns the number of calls.
template<class Check> int forCovered(const Image& image, Check check)
{
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            glm::vec4 value = pixelOf(image, x, y);
            if (value.w == 0)
                continue;
            ++count;
            check(x, y, value);
        }
    return count;
}

inline double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.295779513;
}

} // namespace cotan::testing
