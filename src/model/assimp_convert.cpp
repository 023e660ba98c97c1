#include "assimp_convert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>

#include <assimp/ObjMaterial.h>
#include <assimp/camera.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "cotan/vector.hpp"

namespace cotan {

namespace {

glm::vec3 toGlm(const aiVector3D& v) { return {v.x, v.y, v.z}; }

// Assimp's matrices are row-major, glm's are column-major.
glm::mat4 toGlm(const aiMatrix4x4& m)
{
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

// ---- materials -------------------------------------------------------------------------------

Wrap wrapFrom(aiTextureMapMode mode)
{
    if (mode == aiTextureMapMode_Mirror)
        return Wrap::mirror;
    return mode == aiTextureMapMode_Wrap ? Wrap::repeat : Wrap::clamp;
}

// Assimp scales, rotates about the centre and translates with v up; here v is down.
void setTransform(Texture& texture, const aiUVTransform& t)
{
    const float c = std::cos(t.mRotation), s = std::sin(t.mRotation);
    const glm::vec3 u(c * t.mScaling.x, -s * t.mScaling.y, 0.5f - 0.5f * c + 0.5f * s + t.mTranslation.x);
    const glm::vec3 v(s * t.mScaling.x, c * t.mScaling.y, 0.5f - 0.5f * s - 0.5f * c + t.mTranslation.y);
    // Substitutes v_up = 1 - v_down on both sides.
    texture.uRow = {u.x, -u.y, u.y + u.z};
    texture.vRow = {-v.x, v.y, 1.0f - v.y - v.z};
}

std::optional<float> number(const aiMaterial& source, const char* key, unsigned type, unsigned index)
{
    ai_real value = 0;
    if (source.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value))
        return std::nullopt;
    return value;
}

glm::vec3 color(const aiMaterial& source, const char* key, glm::vec3 fallback)
{
    aiColor3D value;
    const bool found = source.Get(key, 0, 0, value) == aiReturn_SUCCESS;
    const glm::vec3 stored(value.r, value.g, value.b);
    return found && isFinite(stored) ? glm::max(stored, glm::vec3(0)) : fallback;
}

// The first texture of the first of these types that the material has.
SourceMap findMap(const aiMaterial& source, std::initializer_list<aiTextureType> types)
{
    for (const aiTextureType type : types) {
        aiString path;
        unsigned uvSet = 0;
        std::array<aiTextureMapMode, 3> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
        if (source.GetTexture(type, 0, &path, nullptr, &uvSet, nullptr, nullptr, modes.data()) != aiReturn_SUCCESS
            || path.length == 0)
            continue;
        SourceMap map{path.C_Str(), {}, number(source, AI_MATKEY_OBJ_BUMPMULT(type, 0)).value_or(1)};
        map.use.texcoord = uvSet == 1 ? 1 : 0;
        map.use.sampler.wrapU = wrapFrom(modes[0]);
        map.use.sampler.wrapV = wrapFrom(modes[1]);
        aiUVTransform transform;
        if (source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS)
            setTransform(map.use, transform);
        return map;
    }
    return {};
}

// ---- meshes ----------------------------------------------------------------------------------

// Negative values and NaN become black.
float linearFromSrgb(float c) { return f32::cotan_srgb_to_linear(c > 0 ? std::min(c, 1.0f) : 0.0f); }

void copyPositions(const aiMesh& source, Mesh& mesh)
{
    mesh.positions.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        const glm::vec3 p = toGlm(source.mVertices[i]);
        if (!isFinite(p))
            failModel("mesh {}: position {}: expected finite numbers, found {} {} {}", mesh.name, i, p.x, p.y, p.z);
        mesh.positions.push_back(p);
    }
}

void copyTriangles(const aiMesh& source, Mesh& mesh)
{
    mesh.indices.reserve(std::size_t(source.mNumFaces) * 3);
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const aiFace& face = source.mFaces[f];
        if (face.mNumIndices != 3)
            continue; // points and lines
        for (unsigned c = 0; c < 3; ++c) {
            if (face.mIndices[c] >= source.mNumVertices)
                failModel("mesh {}: triangle {}: expected an index below {}, found {}", mesh.name, f,
                          source.mNumVertices, face.mIndices[c]);
            mesh.indices.push_back(face.mIndices[c]);
        }
    }
}

void copyTexcoords(const aiMesh& source, Mesh& mesh, Scene& scene)
{
    for (std::size_t set = 0; set < mesh.texcoords.size(); ++set) {
        if (!source.mTextureCoords[set])
            continue;
        std::size_t broken = 0;
        mesh.texcoords[set].reserve(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            const aiVector3D& t = source.mTextureCoords[set][i];
            const bool good = std::isfinite(t.x) && std::isfinite(t.y);
            broken += good ? 0 : 1;
            // These formats have v = 0 at the bottom row of the image; here it is the top row.
            mesh.texcoords[set].push_back(good ? glm::vec2(t.x, 1.0f - t.y) : glm::vec2(0));
        }
        if (broken > 0)
            scene.warnings.push_back(
                fmt::format("mesh {}: {} texture coordinates are not finite; set to 0", mesh.name, broken));
    }
}

// Files store vertex colours in sRGB.
void copyColors(const aiMesh& source, Mesh& mesh)
{
    if (!source.mColors[0])
        return;
    mesh.colors.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        const aiColor4D& c = source.mColors[0][i];
        mesh.colors.emplace_back(linearFromSrgb(c.r), linearFromSrgb(c.g), linearFromSrgb(c.b),
                                 std::isfinite(c.a) ? std::clamp(c.a, 0.0f, 1.0f) : 1.0f);
    }
}

// ---- nodes -----------------------------------------------------------------------------------

void addCamera(const aiCamera& source, const glm::mat4& toWorld, Scene& scene)
{
    Camera camera;
    camera.name = source.mName.C_Str();
    camera.eye = glm::vec3(toWorld * glm::vec4(toGlm(source.mPosition), 1));
    camera.target = camera.eye + glm::vec3(toWorld * glm::vec4(toGlm(source.mLookAt), 0));
    camera.up = glm::vec3(toWorld * glm::vec4(toGlm(source.mUp), 0));
    const float aspect = source.mAspect > 0 ? source.mAspect : 4.0f / 3.0f;
    const float tangent = std::tan(source.mHorizontalFOV / 2) / aspect;
    camera.verticalFieldOfView = 2 * std::atan(tangent);
    camera.orthographic = source.mOrthographicWidth > 0;
    if (camera.orthographic)
        camera.verticalExtent = 2 * source.mOrthographicWidth / aspect;

    const float area = glm::length(glm::cross(camera.target - camera.eye, camera.up));
    const bool usable = area > 0 && std::isfinite(area) && std::isfinite(glm::length(camera.eye))
        && camera.verticalFieldOfView > 0.01f && camera.verticalFieldOfView < std::numbers::pi_v<float>;
    if (usable)
        scene.cameras.push_back(camera);
    else
        scene.warnings.push_back(fmt::format("camera {}: degenerate; left out", camera.name));
}

struct Visit {
    const aiNode* node;
    glm::mat4 toWorld;
};

} // namespace

Material convertMaterial(const aiMaterial& source, TextureReader& textures, Scene& scene)
{
    SourceMaterial out;
    aiString name;
    const bool named = source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0;
    out.name = named ? name.C_Str() : "unnamed";
    out.color = color(source, "$clr.base", color(source, "$clr.diffuse", out.color));
    out.opacity = number(source, AI_MATKEY_OPACITY).value_or(1);
    out.shininess = number(source, AI_MATKEY_SHININESS).value_or(0);
    out.roughness = number(source, AI_MATKEY_ROUGHNESS_FACTOR);
    out.metallic = number(source, AI_MATKEY_METALLIC_FACTOR);
    out.emission = color(source, "$clr.emissive", out.emission);
    out.colorMap = findMap(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    out.opacityMap = findMap(source, {aiTextureType_OPACITY});
    out.roughnessMap = findMap(source, {aiTextureType_DIFFUSE_ROUGHNESS});
    out.metalnessMap = findMap(source, {aiTextureType_METALNESS});
    out.normalMap = findMap(source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT});
    out.emissionMap = findMap(source, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
    out.occlusionMap = findMap(source, {aiTextureType_AMBIENT_OCCLUSION});
    return makeMaterial(out, textures, scene);
}

Mesh convertMesh(const aiMesh& source, bool regenerateNormals, Scene& scene)
{
    Mesh mesh;
    mesh.name = source.mName.length ? source.mName.C_Str() : "unnamed";
    if (!source.mVertices || !source.mFaces)
        return mesh;
    copyTriangles(source, mesh);
    if (mesh.indices.empty())
        return mesh;
    copyPositions(source, mesh);
    copyTexcoords(source, mesh, scene);
    copyColors(source, mesh);
    if (source.mNormals && !regenerateNormals) {
        mesh.normals.reserve(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i)
            mesh.normals.push_back(toGlm(source.mNormals[i]));
    }
    finishMesh(mesh, "not finite", scene);
    return mesh;
}

void convertNodes(const aiScene& source, const std::vector<int>& meshes, const LoadLimits& limits, Scene& scene)
{
    std::map<std::string, const aiCamera*> cameras; // by node name
    for (unsigned i = 0; i < source.mNumCameras; ++i)
        cameras.emplace(source.mCameras[i]->mName.C_Str(), source.mCameras[i]);

    std::vector<Visit> open{{source.mRootNode, glm::mat4(1)}};
    for (std::size_t visited = 0; !open.empty(); ++visited) {
        Visit visit = open.back();
        open.pop_back();
        if (visited >= limits.nodes)
            failModel("over the limit of {} nodes", limits.nodes);
        visit.toWorld = visit.toWorld * toGlm(visit.node->mTransformation);
        if (!isFinite(visit.toWorld))
            failModel("node {}: expected a finite transform", visit.node->mName.C_Str());
        for (unsigned i = 0; i < visit.node->mNumMeshes; ++i)
            if (const unsigned mesh = visit.node->mMeshes[i]; mesh < meshes.size() && meshes[mesh] >= 0)
                scene.instances.push_back({visit.node->mName.C_Str(), meshes[mesh], visit.toWorld});
        if (const auto camera = cameras.find(visit.node->mName.C_Str()); camera != cameras.end())
            addCamera(*camera->second, visit.toWorld, scene);
        for (unsigned i = visit.node->mNumChildren; i-- > 0;) // so that the first child is visited next
            open.push_back({visit.node->mChildren[i], visit.toWorld});
    }
}

} // namespace cotan
