#include <algorithm>
#include <cmath>

#include <assimp/mesh.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "assimp_convert.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

bool finite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

float linearFromSrgb(float c)
{
    if (!(c > 0))
        return 0;
    return c <= 0.04045f ? c / 12.92f : std::pow((std::min(c, 1.0f) + 0.055f) / 1.055f, 2.4f);
}

Status copyPositions(const aiMesh& source, const std::string& file, Mesh& mesh)
{
    mesh.positions.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        const aiVector3D& p = source.mVertices[i];
        if (!finite(p))
            return inputError(fmt::format("{}: mesh {}: position {}: expected finite numbers, found {} {} {}", file,
                                          mesh.name, i, p.x, p.y, p.z));
        mesh.positions.emplace_back(p.x, p.y, p.z);
    }
    return Done{};
}

Status copyTriangles(const aiMesh& source, const std::string& file, Mesh& mesh)
{
    mesh.indices.reserve(std::size_t(source.mNumFaces) * 3);
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const aiFace& face = source.mFaces[f];
        if (face.mNumIndices != 3)
            continue; // points and lines
        for (unsigned c = 0; c < 3; ++c) {
            if (face.mIndices[c] >= source.mNumVertices)
                return inputError(fmt::format("{}: mesh {}: triangle {}: expected an index below {}, found {}", file,
                                              mesh.name, f, source.mNumVertices, face.mIndices[c]));
            mesh.indices.push_back(face.mIndices[c]);
        }
    }
    return Done{};
}

// False if one of them is not usable as a direction.
bool copyNormals(const aiMesh& source, Mesh& mesh)
{
    mesh.normals.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        const aiVector3D& n = source.mNormals[i];
        const glm::dvec3 normal(n.x, n.y, n.z);
        const double length = glm::length(normal);
        if (!finite(n) || !(length > 0))
            return false;
        mesh.normals.emplace_back(normal / length);
    }
    return true;
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
            // These formats have v = 0 at the bottom row of the picture; here it is the top.
            mesh.texcoords[set].push_back(good ? glm::vec2(t.x, 1.0f - t.y) : glm::vec2(0));
        }
        if (broken > 0)
            scene.warnings.push_back(
                fmt::format("mesh {}: {} texture coordinates are not finite; set to 0", mesh.name, broken));
    }
}

// Files hold vertex colours as they are seen: sRGB.
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

} // namespace

Result<Mesh> convertMesh(const aiMesh& source, const std::string& file, const MeshChoices& choices, Scene& scene)
{
    Mesh mesh;
    mesh.name = source.mName.length ? source.mName.C_Str() : "unnamed";
    if (!source.mVertices || !source.mFaces)
        return mesh;
    if (Status ok = copyTriangles(source, file, mesh); !ok)
        return ok.error();
    if (mesh.indices.empty())
        return mesh;
    if (Status ok = copyPositions(source, file, mesh); !ok)
        return ok.error();
    copyTexcoords(source, mesh, scene);
    copyColors(source, mesh);

    const bool stored = source.mNormals && !choices.regenerateNormals;
    const bool usable = stored && copyNormals(source, mesh);
    if (stored && !usable)
        scene.warnings.push_back(
            fmt::format("mesh {}: some normals are zero or not finite; all are made anew", mesh.name));
    if (!usable) {
        mesh.normals.clear();
        generateNormals(mesh, choices.creaseDegrees);
    }
    weldVertices(mesh);
    return mesh;
}

} // namespace cotan
