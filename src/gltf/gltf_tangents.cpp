#include "cotan/gltf.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/try.hpp"
#include "gltf/json/lookup.hpp"

namespace cotan {

using gltf::Json;

namespace {

std::string whyNoTangents(const GltfGeometry& geometry)
{
    if (geometry.indices.empty())
        return "no triangles";
    if (geometry.normals.empty())
        return "no NORMAL";
    if (geometry.texcoords.empty())
        return fmt::format("no TEXCOORD_{}", geometry.texcoordSet);
    return {};
}

Result<GltfPrimitiveGeometry> readPrimitive(const GltfDocument& document, std::size_t m, std::size_t p)
{
    COTAN_TRY(geometry, gltfGeometry(document, m, p, NormalSlot::surface, std::nullopt, TexcoordSpace::file));
    const Json& mesh = rootOf(document)["meshes"][m];
    GltfPrimitiveGeometry read{m, p, mesh.value("name", fmt::format("mesh {}", m)), std::move(*geometry), {}};
    if (mesh["primitives"].size() > 1)
        read.name += fmt::format("/{}", p);
    read.reason = whyNoTangents(read.geometry);
    makeUnit(read.geometry.normals);
    return read;
}

bool hasNormalMap(const Json& root, std::size_t m, std::size_t p)
{
    const auto materials = materialsOf(root, root["meshes"][m]["primitives"][p]);
    return std::any_of(materials.begin(), materials.end(), [&](std::size_t k) {
        return std::ranges::any_of(kNormalSlots,
                                   [&](NormalSlot slot) { return normalMapOf(root, k, slot).texture >= 0; });
    });
}

// Calls visit(geometry, row) for each primitive that the options select and returns all rows. `row` then has the
// members that the file alone determines.
template<class Visit>
Result<std::vector<PrimitiveTangents>> rowsOf(const GltfDocument& document, const TangentsOptions& options,
                                              const Visit& visit)
{
    if (!readsTangents(options.frame))
        return usageError(fmt::format("tangents: expected the frame mikktspace, area-weighted or vertex; found {}",
                                      name(options.frame)));
    std::vector<PrimitiveTangents> rows;
    std::size_t all = 0, done = 0;
    for (std::size_t m = 0; m < countOf(rootOf(document), "meshes"); ++m)
        all += rootOf(document)["meshes"][m]["primitives"].size();
    const Status status = forEachPrimitive(rootOf(document), [&](std::size_t m, std::size_t p) -> Status {
        if (!options.mappedOnly || hasNormalMap(rootOf(document), m, p)) {
            COTAN_TRY(read, readPrimitive(document, m, p));
            PrimitiveTangents& row =
                rows.emplace_back(PrimitiveTangents{m, p, read->name, read->geometry.indices.size() / 3,
                                                    !read->geometry.tangents.empty(), false, read->reason});
            visit(*read, row);
        }
        if (options.progress && !options.progress(double(++done) / double(all)))
            return stoppedError();
        return Done{};
    });
    if (!status)
        return status.error();
    return rows;
}

} // namespace

Result<std::vector<GltfPrimitiveGeometry>> gltfPrimitives(const GltfDocument& document)
{
    std::vector<GltfPrimitiveGeometry> all;
    const Status status = forEachPrimitive(rootOf(document), [&](std::size_t m, std::size_t p) -> Status {
        COTAN_TRY(read, readPrimitive(document, m, p));
        all.push_back(std::move(*read));
        return Done{};
    });
    if (!status)
        return status.error();
    return all;
}

Result<GiveTangentsResult> giveTangents(GltfDocument& document, const TangentsOptions& options)
{
    GiveTangentsResult given;
    std::vector<GltfCornerTangents> tangents;
    auto rows = rowsOf(document, options, [&](const GltfPrimitiveGeometry& read, PrimitiveTangents& row) {
        if (!row.reason.empty()) {
            ++given.skipped;
        } else if (row.stored && !options.replace) {
            ++given.kept;
        } else {
            row.generated = true;
            tangents.push_back(
                {row.mesh, row.primitive, generateTangents(options.frame, read.view(), options.threads)});
        }
    });
    if (!rows)
        return rows.error();
    COTAN_TRY(added, setGltfTangents(document, tangents));
    given.primitives = std::move(*rows);
    given.generated = tangents.size();
    given.verticesAdded = *added;
    return given;
}

Result<CompareTangentsResult> compareTangents(const GltfDocument& document, const TangentsOptions& options)
{
    CompareTangentsResult compared;
    auto rows = rowsOf(document, options, [&](const GltfPrimitiveGeometry& read, PrimitiveTangents& row) {
        if (!row.reason.empty())
            return;
        if (!row.stored) {
            ++compared.without;
            return;
        }
        row.difference = tangentDifference(read.view(), read.geometry.tangents,
                                           generateTangents(options.frame, read.view(), options.threads));
        append(compared.whole, *row.difference);
        // Not for nearly equal ones: flat and evenly tessellated meshes have both.
        if (options.frame == Frame::mikktspace && verdictOf(*row.difference) == TangentVerdict::off)
            row.areaWeighted =
                verdictOf(tangentDifference(read.view(), read.geometry.tangents,
                                            generateTangents(Frame::areaWeighted, read.view(), options.threads)))
                == TangentVerdict::equal;
    });
    if (!rows)
        return rows.error();
    compared.primitives = std::move(*rows);
    return compared;
}

} // namespace cotan
