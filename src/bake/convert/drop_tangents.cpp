#include "bake/convert/map_jobs.hpp"

#include <memory>
#include <set>

#include <fmt/format.h>

#include "gltf/json/lookup.hpp"

namespace cotan {

using gltf::Json;

namespace {

// How far the direction of a primitive's highlights turns with its worst placing.
Result<ValueSummary> turnOf(const GltfDocument& document, std::size_t m, std::size_t p,
                            const std::vector<glm::dmat3>& placed, const FramePair& frames)
{
    auto geometry = gltfGeometry(document, m, p);
    if (!geometry)
        return geometry.error();
    const auto mesh = std::make_shared<const Mesh>(gltfMesh(std::move(*geometry)));
    const MappedSurface surface =
        makeSurface(mesh, Texture{}, glm::dmat3(1), framesRead(frames, !mesh->tangents.empty()));
    ValueSummary worst;
    for (const glm::dmat3& linear : placed) {
        const MappedSurface moved = placedBy(surface, linear);
        const ValueSummary turn = directionTurn(moved, pointsOver(moved, kPointsOfSurface), frames);
        if (turn.count == 0)
            return turn;
        if (worst.count == 0 || turn.percentile95 > worst.percentile95)
            worst = turn;
    }
    return worst;
}

// What to say of a direction that does not stay where TANGENT goes.
std::string whyDirectionNeedsTangents(const TurnedDirection& d, Frame to)
{
    if (d.degrees.count == 0)
        return "the direction of its anisotropy is that of TANGENT alone, without uv to derive it from";
    return fmt::format("the direction of its anisotropy would turn by {:.1f} degrees with {} (95 % of {})",
                       d.degrees.percentile95, name(to), primitiveField(d.mesh, d.primitive));
}

} // namespace

Result<TangentBytes> dropTangents(GltfDocument& document, const FramePair& frames, std::vector<std::string>& notes)
{
    TangentBytes dropped;
    std::set<std::size_t> seen, told;
    const std::vector<MapSlot> foreign = foreignNormalMaps(document);
    const auto placed = gltfPlacings(rootOf(document));
    const Status status = forEachPrimitive(rootOf(document), [&](std::size_t m, std::size_t p) -> Status {
        const Json& root = rootOf(document);
        const Json& primitive = root["meshes"][m]["primitives"][p];
        if (!primitive["attributes"].contains("TANGENT"))
            return Done{};
        bool stays = false;
        const auto keepFor = [&](std::size_t material, const std::string& reason) {
            stays = true;
            if (told.insert(material).second)
                notes.push_back(fmt::format("materials[{}]: {}; TANGENT stays", material, reason));
        };
        for (const std::size_t material : materialsOf(root, primitive)) {
            for (const MapSlot& place : foreign)
                if (place.material == material)
                    keepFor(material, "its normal map, in a format that is not read here, is not converted");
            if (gltf::tangentReader(root["materials"][material]).empty())
                continue;
            const auto turn = turnOf(document, m, p, placed[m], frames);
            if (!turn)
                return turn.error();
            TurnedDirection& d = dropped.directions.emplace_back(TurnedDirection{m, p, material, *turn, false});
            d.stays = !directionStays(d.degrees);
            if (d.stays)
                keepFor(material, whyDirectionNeedsTangents(d, frames.to));
        }
        if (stays)
            return Done{};
        auto count = [&](const Json& attributes, bool base) {
            if (!attributes.contains("TANGENT"))
                return;
            const std::size_t index = attributes["TANGENT"].get<std::size_t>();
            if (!seen.insert(index).second)
                return;
            const gltf::Accessor accessor = gltf::readAccessor(root["accessors"][index]);
            dropped.vertices += base ? accessor.count : 0;
            dropped.bytes += accessor.count * gltf::elementSize(accessor);
        };
        count(primitive["attributes"], true);
        for (const Json& target : primitive.value("targets", Json::array()))
            count(target, false);
        dropped.primitives += dropGltfTangents(document, m, p);
        return Done{};
    });
    if (!status)
        return status.error();
    return dropped;
}

} // namespace cotan
