// Opens a glTF file, changes it like `tangents` and `convert`, writes it and reads it again: unchanged data must be
// equal, and changed data must be as set.
#include <bit>
#include <optional>
#include <vector>

#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "gltf/json/lookup.hpp"
#include "scene_checks.hpp"

using namespace cotan;
using namespace cotan::fuzz;

namespace {

struct Primitive {
    std::size_t mesh, index;
    GltfGeometry geometry;
};

// Returns all readable primitives.
std::vector<Primitive> primitivesOf(const GltfDocument& document)
{
    std::vector<Primitive> all;
    const auto meshes = rootOf(document).find("meshes");
    if (meshes == rootOf(document).end())
        return all;
    for (std::size_t m = 0; m < meshes->size(); ++m)
        for (std::size_t p = 0; p < (*meshes)[m].at("primitives").size(); ++p) {
            auto geometry = gltfGeometry(document, m, p, NormalSlot::surface, std::nullopt, TexcoordSpace::file);
            if (geometry)
                all.push_back({m, p, *std::move(geometry)});
            else
                checkError(geometry.error());
        }
    return all;
}

// Compares bits, so that NaN equals NaN.
template<class Vector>
bool sameCorners(const std::vector<Vector>& a, const GltfGeometry& ga, const std::vector<Vector>& b,
                 const GltfGeometry& gb)
{
    if (a.empty() != b.empty() || ga.indices.size() != gb.indices.size())
        return false;
    for (std::size_t c = 0; !a.empty() && c < ga.indices.size(); ++c)
        if (std::memcmp(&a[ga.indices[c]], &b[gb.indices[c]], sizeof(Vector)) != 0)
            return false;
    return true;
}

void checkEqual(const std::vector<Primitive>& before, const std::vector<Primitive>& after)
{
    COTAN_HOLDS(before.size() == after.size(), "{} {}", before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        const GltfGeometry &a = before[i].geometry, &b = after[i].geometry;
        COTAN_HOLDS(sameCorners(a.positions, a, b.positions, b), "positions of {}", i);
        COTAN_HOLDS(sameCorners(a.normals, a, b.normals, b), "normals of {}", i);
        COTAN_HOLDS(sameCorners(a.texcoords, a, b.texcoords, b), "texcoords of {}", i);
    }
}

// Writes the document, reads it again and compares. Returns the primitives read, or nothing if it cannot be written.
std::vector<Primitive> roundTrip(const GltfDocument& document, const std::filesystem::path& file,
                                 const std::vector<Primitive>& before)
{
    const auto written = writeGltf(document, file, smallLimits());
    if (!written) {
        checkError(written.error());
        return {};
    }
    const auto again = openGltfDocument(file, smallLimits());
    COTAN_HOLDS(bool(again), "{}", again ? "" : again.error().message);
    std::vector<Primitive> after = primitivesOf(*again);
    checkEqual(before, after);
    return after;
}

std::vector<GltfCornerTangents> tangentsOf(const std::vector<Primitive>& primitives)
{
    std::vector<GltfCornerTangents> all;
    for (const Primitive& p : primitives) {
        const GltfGeometry& g = p.geometry;
        checkTangents({g.positions, g.normals, g.texcoords, g.indices});
        auto corners = mikktspaceTangents({g.positions, g.normals, g.texcoords, g.indices}, 1);
        if (!corners.empty())
            all.push_back({p.mesh, p.index, std::move(corners)});
    }
    return all;
}

void checkTangentsRead(const std::vector<GltfCornerTangents>& set, const std::vector<Primitive>& read)
{
    for (const GltfCornerTangents& given : set)
        for (const Primitive& p : read) {
            if (p.mesh != given.mesh || p.index != given.primitive)
                continue;
            COTAN_HOLDS(p.geometry.indices.size() == given.corners.size(), "{}", given.corners.size());
            for (std::size_t c = 0; c < given.corners.size(); ++c) {
                glm::vec4 corner = given.corners[c];
                if (glm::vec3(corner) == glm::vec3(0)) // directions cancel, but glTF requires unit length
                    corner.x = 1;
                COTAN_HOLDS(p.geometry.tangents[p.geometry.indices[c]] == corner || !finite(corner), "corner {}", c);
            }
        }
}

// Whether corner i of `a` and corner k of `b` have bitwise equal attributes.
bool sameCorner(const GltfGeometry& a, std::size_t i, const GltfGeometry& b, std::size_t k)
{
    const auto same = [&](const auto& x, const auto& y) {
        return x.empty() == y.empty()
            && (x.empty() || std::memcmp(&x[a.indices[i]], &y[b.indices[k]], sizeof x[0]) == 0);
    };
    return same(a.positions, b.positions) && same(a.normals, b.normals) && same(a.tangents, b.tangents)
        && same(a.texcoords, b.texcoords);
}

// Makes a vertex per triangle, like `convert --provoking`: triangles must be equal up to a rotation of their corners.
void checkProvoking(GltfDocument document, const std::filesystem::path& file, ProvokingVertex provoking)
{
    const std::vector<Primitive> before = primitivesOf(document);
    if (const auto rows = setGltfProvoking(document, provoking); !rows)
        return checkError(rows.error());
    const auto written = writeGltf(document, file, smallLimits());
    if (!written)
        return checkError(written.error());
    // Vertex copies may exceed the limits.
    const auto again = openGltfDocument(file, smallLimits());
    if (!again)
        return checkError(again.error());
    const std::vector<Primitive> after = primitivesOf(*again);
    COTAN_HOLDS(before.size() == after.size(), "{} {}", before.size(), after.size());
    for (std::size_t p = 0; p < before.size(); ++p) {
        const GltfGeometry &a = before[p].geometry, &b = after[p].geometry;
        COTAN_HOLDS(a.indices.size() == b.indices.size(), "primitive {}", p);
        for (std::size_t f = 0; f < a.indices.size(); f += 3) {
            bool same = false;
            for (std::size_t rotation = 0; rotation < 3; ++rotation)
                same = same
                    || (sameCorner(a, f, b, f + rotation) && sameCorner(a, f + 1, b, f + (rotation + 1) % 3)
                        && sameCorner(a, f + 2, b, f + (rotation + 2) % 3));
            COTAN_HOLDS(same, "primitive {}, corner {}", p, f);
            COTAN_HOLDS(b.indices[f + (provoking == ProvokingVertex::last ? 2 : 0)] == f / 3, "corner {}", f);
        }
    }
}

// Replaces every image and copies the last texture and material, like `convert`.
void changeImages(GltfDocument& document)
{
    Image flat = makeImage(2, 2, PixelType::unorm8, "flat");
    const auto png = encodePng(flat);
    COTAN_HOLDS(bool(png));
    const auto count = [&](const char* name) {
        const auto found = rootOf(document).find(name);
        return found == rootOf(document).end() ? std::size_t(0) : found->size();
    };
    const std::size_t images = count("images"), textures = count("textures"), materials = count("materials");
    for (std::size_t i = 0; i < images; ++i) {
        const auto bytes = gltfImageBytes(document, i, smallLimits());
        if (!bytes)
            checkError(bytes.error());
        replaceGltfImage(document, i, *png, "image/png");
        const auto replaced = gltfImageBytes(document, i, smallLimits());
        COTAN_HOLDS(replaced && *replaced == *png, "image {}", i);
    }
    const std::size_t added = addGltfImage(document, *png, "image/png", "added");
    COTAN_HOLDS(added == images, "{}", added);
    if (textures > 0)
        COTAN_HOLDS(copyGltfTexture(document, textures - 1, added) == textures);
    if (materials > 0)
        COTAN_HOLDS(copyGltfMaterial(document, materials - 1) == materials);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    const std::span bytes(data, size);
    const auto file = scratch.write(startsWith(bytes, "glTF") ? "model.glb" : "model.gltf", bytes);
    auto document = openGltfDocument(file, smallLimits());
    if (!document) {
        checkError(document.error());
        return 0;
    }
    const std::vector<Primitive> before = primitivesOf(*document);
    roundTrip(*document, scratch / "repacked.glb", before);
    roundTrip(*document, scratch / "repacked.gltf", before);
    for (const auto provoking : {ProvokingVertex::first, ProvokingVertex::last})
        checkProvoking(*document, scratch / "provoking.glb", provoking);

    const std::vector<GltfCornerTangents> tangents = tangentsOf(before);
    if (const auto set = setGltfTangents(*document, tangents))
        checkTangentsRead(tangents, roundTrip(*document, scratch / "tangents.glb", before));
    else
        checkError(set.error());
    for (const Primitive& p : before)
        if (dropGltfTangents(*document, p.mesh, p.index))
            COTAN_HOLDS(gltfGeometry(*document, p.mesh, p.index)->tangents.empty());
    changeImages(*document);
    roundTrip(*document, scratch / "converted.glb", before);
    return 0;
}
