#include "bake/reports.hpp"

#include <cmath>

#include <fmt/format.h>

#include "scene/geometry.hpp"

namespace cotan {

Json toJson(const ValueSummary& s)
{
    return {{"count", s.count}, {"mean", s.mean}, {"percentile95", s.percentile95}, {"maximum", s.maximum}};
}

Json countsOf(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangleCount();
    return {{"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"materials", scene.materials.size()},
            {"images", scene.images.size()},
            {"triangles", triangles},
            {"triangles_drawn", trianglesDrawn(scene)},
            {"warnings", scene.warnings}};
}

// ---- lint -----------------------------------------------------------------------------------

namespace {

Json toJson(const PrimitiveLint& p)
{
    Json j = {{"mesh", p.mesh},
              {"material", p.material},
              {"placing", p.placing},
              {"placings", p.placings},
              {"normal_map", p.image},
              {"not_judged", p.notJudged},
              {"tangents_for", p.tangentsFor},
              {"made_for", name(p.madeFor)},
              {"triangles", p.triangles},
              {"has_uv", p.hasUv}};
    j["uv"] = {{"area", p.uv.area},
               {"degenerate", p.uv.degenerate},
               {"mirrored", p.uv.mirrored},
               {"overlapping", p.uv.overlapping},
               {"overlapping_mirrored", p.uv.overlappingMirrored},
               {"stretched", p.uv.stretched},
               {"sheared", p.uv.sheared},
               {"stretch", toJson(p.uv.stretch)},
               {"shear_degrees", toJson(p.uv.shear)},
               {"gradient", p.uv.gradient},
               {"largest_uv", p.uv.largestUv}};
    j["edge_steps"] = {{"edges", p.steps.edges},
                       {"cotangent", toJson(p.steps.cotangent)},
                       {"orthonormal", toJson(p.steps.orthonormal)}};
    if (p.stored.present)
        j["stored_tangents"] = {{"reversed_w", p.stored.reversedW},
                                {"rotated", p.stored.rotated},
                                {"degrees_from_dpdu", toJson(p.stored.angle)}};
    for (const Reading& r : p.readings)
        j["read_with"][r.name] = toJson(r.error);
    j["rounding_degrees"] = p.precision;
    j["half_a_degree_at"] = p.closest;
    return j;
}

Json toJson(const GreenEvidence& g)
{
    Json faults = Json::array();
    for (const maps::Fault& fault : g.faults)
        faults.push_back({{"kind", name(fault.kind)}, {"text", fault.text}});
    return {{"image", g.image},
            {"name", g.name},
            {"decided", g.decided()},
            {"as_declared", g.asDeclared()},
            {"green", name(g.verdict.green)},
            {"confidence", name(g.verdict.confidence)},
            {"reason", g.verdict.reason},
            {"agreement", g.verdict.agreement},
            {"votes", g.verdict.votes},
            {"verdict", greenVerdict(g)},
            {"faults", faults},
            {"note", g.note.empty() ? Json(nullptr) : Json(g.note)},
            {"reversed_by_tangents", g.reversedByTangents}};
}

Json number(double value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

Json toJson(const FrameDecision& d)
{
    constexpr const char* kMeanings[] = {"named", "stored", "mikktspace"};
    constexpr const char* kReasons[] = {"no_map", "named", "fits", "keeps", "not_judged"};
    Json candidates = Json::array();
    for (const FrameCandidate& c : d.candidates)
        candidates.push_back({{"frame", name(c.frame)},
                              {"stored", c.tangents == TangentOrigin::stored},
                              {"points", c.points},
                              {"mean", number(c.mean)},
                              {"percentile95", number(c.percentile95)},
                              {"percentile99", number(c.percentile99)},
                              {"maximum", number(c.maximum)}});
    return {{"mesh", d.mesh},
            {"meaning", kMeanings[std::size_t(d.meaning)]},
            {"reason", kReasons[std::size_t(d.reason)]},
            {"frame", name(d.frame)},
            {"tangents_stay", !d.dropsTangents()},
            {"candidates", candidates},
            {"not_judged", d.notJudged},
            {"text", textOf(d)}};
}

Json toJson(const MapFit& f)
{
    return {{"image", f.image},
            {"name", f.name},
            {"orthonormal", toJson(f.orthonormal)},
            {"cotangent", toJson(f.cotangent)},
            {"smooth", toJson(f.smooth)}};
}

} // namespace

std::string greenVerdict(const GreenEvidence& g)
{
    if (!g.decided())
        return "undecidable from the map (" + (g.verdict.reason.empty() ? "it was not read" : g.verdict.reason) + ")";
    return fmt::format("{} ({})", g.asDeclared() ? "as declared" : "opposite to the declaration",
                       name(g.verdict.confidence));
}

Json toJson(const LintCheck& check)
{
    if (!check.limits.any())
        return nullptr;
    const auto limit = [](double value) { return value >= 0 ? Json(value) : Json(nullptr); };
    Json j = {{"passed", check.passed()},
              {"limit", limit(check.limits.degrees)},
              {"limit_area", limit(check.limits.area)},
              {"frame", check.limits.frame},
              {"failures", Json::array()}};
    for (const LintFailure& f : check.failures) {
        const bool measured = f.limit >= 0;
        j["failures"].push_back({{"kind", f.kind},
                                 {"where", f.where},
                                 {"value", measured ? Json(f.value) : Json(nullptr)},
                                 {"limit", limit(f.limit)},
                                 {"text", f.text}});
    }
    return j;
}

std::vector<std::string> warningsOf(const LintReport& report, std::vector<std::string> ofFile)
{
    for (std::string& line : lintWarnings(report))
        ofFile.push_back(std::move(line));
    return ofFile;
}

Json listsOf(const LintReport& report)
{
    Json lists = {
        {"primitives", Json::array()}, {"maps", Json::array()}, {"fits", Json::array()}, {"decisions", Json::array()}};
    for (const PrimitiveLint& p : report.primitives)
        lists["primitives"].push_back(toJson(p));
    for (const GreenEvidence& g : report.maps)
        lists["maps"].push_back(toJson(g));
    for (const MapFit& f : report.fits)
        lists["fits"].push_back(toJson(f));
    for (const FrameDecision& d : report.decisions)
        lists["decisions"].push_back(toJson(d));
    return lists;
}

// ---- convert --------------------------------------------------------------------------------

// A kept map has no fields about converted texels, since none was looked at.
Json toJson(const ConvertedMap& map)
{
    const ReencodeFigures& r = map.figures;
    Json json = {{"image", map.image},
                 {"name", map.name},
                 {"surfaces", map.surfaces},
                 {"size", {map.width, map.height}},
                 {"kept", map.kept},
                 {"read_with", Json::array()},
                 {"green_reversed", map.greenReversed},
                 {"surfaces_with_tangents", map.surfacesWithTangents},
                 {"bits", map.bits},
                 {"format", map.format},
                 {"quality", map.quality > 0 ? Json(map.quality) : Json(nullptr)},
                 {"texels_covered", r.covered},
                 {"texels_padded", r.padded},
                 {"texels_overlapped", r.several},
                 {"texels_that_disagree", r.disagreeing},
                 {"disagreement_degrees", toJson(r.disagreement)},
                 {"moved_degrees", toJson(r.moved)},
                 {"degrees_unconverted", toJson(r.unconverted)},
                 {"degrees_after_rounding", toJson(r.error)},
                 {"below_horizon", r.belowHorizon},
                 {"kept_elsewhere", map.alsoElsewhere},
                 {"bytes_before", map.bytesBefore},
                 {"bytes_after", map.bytesAfter}};
    for (const Frame frame : map.readWith)
        json["read_with"].push_back(name(frame));
    if (map.greenReversed)
        for (const char* figure : {"texels_covered", "texels_padded", "texels_overlapped", "texels_that_disagree",
                                   "disagreement_degrees", "moved_degrees", "below_horizon"})
            json.erase(figure);
    if (map.kept)
        for (const char* figure :
             {"bits", "quality", "texels_covered", "texels_padded", "texels_overlapped", "texels_that_disagree",
              "disagreement_degrees", "moved_degrees", "degrees_after_rounding", "below_horizon", "kept_elsewhere"})
            json.erase(figure);
    return json;
}

Json decisionsJson(const std::vector<PrimitiveDecision>& decisions)
{
    Json list = Json::array();
    for (const PrimitiveDecision& d : decisions) {
        Json json = toJson(d.decision);
        json["mesh"] = d.primitive.mesh;
        json["primitive"] = d.primitive.primitive;
        list.push_back(std::move(json));
    }
    return list;
}

Json tangentsJson(const ConvertModelReport& report)
{
    if (report.tangents == TangentsAfter::kept)
        return {{"kept", true}};
    if (report.tangents == TangentsAfter::given)
        return {{"given_primitives", report.primitivesGiven}};
    const TangentBytes& d = report.dropped;
    Json json = {{"dropped_primitives", d.primitives},
                 {"bytes_per_vertex", d.vertices > 0 ? double(d.bytes) / double(d.vertices) : 0},
                 {"vertices", d.vertices},
                 {"bytes", d.bytes}};
    for (const RotatedDirection& direction : d.directions)
        json["anisotropy"].push_back({{"mesh", direction.mesh},
                                      {"primitive", direction.primitive},
                                      {"material", direction.material},
                                      {"rotated_degrees", toJson(direction.degrees)},
                                      {"tangents_stay", direction.stays}});
    return json;
}

} // namespace cotan
