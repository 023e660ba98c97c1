#include "convert_lines.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "bake/convert/choose_primitives.hpp"
#include "bake/lint/map_fit.hpp"
#include "gltf/json/lookup.hpp"
#include "lint_lines.hpp"

namespace cotan::app {

namespace {

// The line about a map that is left unchanged, but for its green.
std::string whyKept(const ConvertedMap& map)
{
    const ValueSummary& unconverted = map.figures.unconverted;
    if (map.surfaces > 0 && map.surfacesWithTangents == map.surfaces)
        return fmt::format("{}: unchanged: TANGENT stays on {}", map.name, counted(map.surfaces, "surface"));
    if (unconverted.count == 0)
        return fmt::format("{}: unchanged; not checked, since no triangle with an area, in uv too, uses it", map.name);
    const std::string change = map.greenReversed ? "only its green is reversed" : "unchanged";
    const ValueSummary& error = map.greenReversed ? map.figures.error : unconverted;
    return fmt::format("{}: {}: read with {} its error is {} degrees on {}{}", map.name, change, namesOf(map.readWith),
                       toText(error), counted(map.surfaces - map.surfacesWithTangents, "surface"),
                       fitsAsItIs(error) ? ", no more than that of rounding a new map" : "");
}

// "JPEG of quality 90,"
std::string formatOf(const ConvertedMap& map)
{
    return map.quality > 0 ? fmt::format("{} of quality {},", map.format, map.quality) : map.format;
}

GltfProvoked sumOf(const std::vector<GltfProvoked>& primitives)
{
    GltfProvoked sum;
    for (const GltfProvoked& p : primitives) {
        sum.triangles += p.triangles;
        sum.verticesBefore += p.verticesBefore;
        sum.verticesAfter += p.verticesAfter;
    }
    return sum;
}

double growthOf(const GltfProvoked& p)
{
    return p.verticesBefore > 0 ? double(p.verticesAfter) / double(p.verticesBefore) : 1;
}

Json rowOf(const GltfProvoked& p)
{
    return {{"triangles", p.triangles},
            {"vertices_before", p.verticesBefore},
            {"vertices_after", p.verticesAfter},
            {"growth", growthOf(p)}};
}

} // namespace

std::vector<std::string> mapLines(const ConvertedMap& map, const std::string& to)
{
    if (map.kept || map.greenReversed)
        return {whyKept(map)};
    const ReencodeFigures& r = map.figures;
    const double texels = double(map.width) * double(map.height);
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}: {}x{}, {:.1f} % covered by {}; read with {} unchanged, error {} degrees", map.name,
                                map.width, map.height, 100 * double(r.covered) / texels,
                                counted(map.surfaces, "surface"), to, toText(r.unconverted)));
    if (r.several > 0)
        lines.push_back(fmt::format(
            "  {} texels are used at several surface points; in {} ({:.2f} % of the covered) these differ by over {} "
            "degrees{}",
            r.several, r.disagreeing, 100 * double(r.disagreeing) / double(std::max<std::size_t>(r.covered, 1)),
            kDisagree, r.disagreeing > 0 ? fmt::format(": {} at the worst point", toText(r.disagreement)) : ""));
    lines.push_back(fmt::format("  converted and rounded to {} bits, error {} degrees; {} padding texels converted "
                                "too; {} {} bytes, before {}",
                                map.bits, toText(r.error), r.padded, formatOf(map), map.bytesAfter, map.bytesBefore));
    if (r.belowHorizon > 0)
        lines.push_back(fmt::format("  {} texels point below the horizon of the frame", r.belowHorizon));
    return lines;
}

std::vector<std::string> tangentsLines(const ConvertModelReport& report, const std::string& to)
{
    if (report.tangents == TangentsAfter::kept)
        return {};
    if (report.tangents == TangentsAfter::given)
        return {fmt::format("{} got TANGENT for {}", counted(report.primitivesGiven, "primitive"), to)};
    const TangentBytes& d = report.dropped;
    std::vector<std::string> lines = {
        d.bytes > 0
            ? fmt::format("TANGENT dropped from {}: {:.3g} bytes per vertex, {} vertices, {} bytes",
                          counted(d.primitives, "primitive"), double(d.bytes) / double(d.vertices), d.vertices, d.bytes)
            : "no TANGENT to drop"};
    const RotatedDirection* worst = nullptr;
    std::size_t rotated = 0;
    for (const RotatedDirection& direction : d.directions)
        if (!direction.stays) {
            ++rotated;
            if (!worst || direction.degrees.percentile95 > worst->degrees.percentile95)
                worst = &direction;
        }
    if (worst)
        lines.push_back(fmt::format("  anisotropic highlights of {} followed TANGENT; with {} they rotate by {} "
                                    "degrees in the worst one, {}",
                                    counted(rotated, "primitive"), to, toText(worst->degrees),
                                    primitiveField(worst->mesh, worst->primitive)));
    return lines;
}

std::string provokingLine(const std::vector<GltfProvoked>& primitives, ProvokingVertex provoking)
{
    const GltfProvoked sum = sumOf(primitives);
    if (primitives.empty())
        return "no triangles: no vertices were reordered";
    return fmt::format("{} of {}: {} vertices, before {}: {:.2f} times as many; vertex k provokes triangle k as its {}",
                       counted(sum.triangles, "triangle"), counted(primitives.size(), "primitive"), sum.verticesAfter,
                       sum.verticesBefore, growthOf(sum), wordOf(kProvokings, provoking));
}

Json provokingJson(const std::vector<GltfProvoked>& primitives, ProvokingVertex provoking)
{
    Json json = {{"vertex", wordOf(kProvokings, provoking)}};
    json.update(rowOf(sumOf(primitives)));
    json["primitives"] = Json::array();
    for (const GltfProvoked& p : primitives) {
        Json row = {{"mesh", p.mesh}, {"primitive", p.primitive}};
        row.update(rowOf(p));
        json["primitives"].push_back(std::move(row));
    }
    return json;
}

} // namespace cotan::app
