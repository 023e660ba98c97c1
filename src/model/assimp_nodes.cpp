#include <cmath>
#include <map>
#include <vector>

#include <assimp/camera.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "assimp_convert.hpp"
#include "cotan/vector.hpp"

namespace cotan {

namespace {

constexpr float kPi = 3.14159265f;

// Assimp's matrices are stored by rows, glm's by columns.
glm::mat4 toGlm(const aiMatrix4x4& m)
{
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

void addCamera(const aiCamera& source, const glm::mat4& toWorld, Scene& scene)
{
    const auto vector = [](const aiVector3D& v) { return glm::vec3(v.x, v.y, v.z); };
    Camera camera;
    camera.name = source.mName.C_Str();
    camera.eye = glm::vec3(toWorld * glm::vec4(vector(source.mPosition), 1));
    camera.target = camera.eye + glm::vec3(toWorld * glm::vec4(vector(source.mLookAt), 0));
    camera.up = glm::vec3(toWorld * glm::vec4(vector(source.mUp), 0));
    const float aspect = source.mAspect > 0 ? source.mAspect : 4.0f / 3.0f;
    const float tangent = std::tan(source.mHorizontalFOV / 2) / aspect;
    camera.verticalFieldOfView = 2 * std::atan(tangent);
    camera.orthographic = source.mOrthographicWidth > 0;
    if (camera.orthographic)
        camera.verticalExtent = 2 * source.mOrthographicWidth / aspect;

    const float area = glm::length(glm::cross(camera.target - camera.eye, camera.up));
    const bool usable = area > 0 && std::isfinite(area) && std::isfinite(glm::length(camera.eye))
        && camera.verticalFieldOfView > 0.01f && camera.verticalFieldOfView < kPi;
    if (usable)
        scene.cameras.push_back(camera);
    else
        scene.warnings.push_back(fmt::format("camera {}: is degenerate; left out", camera.name));
}

struct Visit {
    const aiNode* node;
    glm::mat4 toWorld;
};

void addInstances(const Visit& visit, const std::vector<int>& meshes, Scene& scene)
{
    for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
        const unsigned mesh = visit.node->mMeshes[i];
        if (mesh < meshes.size() && meshes[mesh] >= 0)
            scene.instances.push_back({visit.node->mName.C_Str(), meshes[mesh], visit.toWorld});
    }
}

} // namespace

Status convertNodes(const aiScene& source, const std::string& file, const std::vector<int>& meshes,
                    const LoadLimits& limits, Scene& scene)
{
    std::map<std::string, const aiCamera*> cameras; // by the name of their node
    for (unsigned i = 0; i < source.mNumCameras; ++i)
        cameras.emplace(source.mCameras[i]->mName.C_Str(), source.mCameras[i]);

    std::vector<Visit> open{{source.mRootNode, glm::mat4(1)}};
    for (std::size_t visited = 0; !open.empty(); ++visited) {
        Visit visit = open.back();
        open.pop_back();
        if (visited >= limits.nodes)
            return inputError(fmt::format("{}: over the limit of {} nodes", file, limits.nodes));
        visit.toWorld = visit.toWorld * toGlm(visit.node->mTransformation);
        if (!isFinite(visit.toWorld))
            return inputError(fmt::format("{}: node {}: expected a finite transform", file, visit.node->mName.C_Str()));
        addInstances(visit, meshes, scene);
        if (const auto camera = cameras.find(visit.node->mName.C_Str()); camera != cameras.end())
            addCamera(*camera->second, visit.toWorld, scene);
        for (unsigned i = visit.node->mNumChildren; i-- > 0;) // the first child is next
            open.push_back({visit.node->mChildren[i], visit.toWorld});
    }
    return Done{};
}

} // namespace cotan
