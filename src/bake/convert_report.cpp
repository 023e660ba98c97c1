#include "bake/convert_report.hpp"

#include "bake/report_words.hpp"

namespace cotan {

// Of a map that stays, no texel was looked at: those figures are missing.
Json toJson(const ConvertedMap& map)
{
    const ReencodeFigures& r = map.figures;
    if (map.kept)
        return {{"image", map.image},
                {"name", map.name},
                {"surfaces", map.surfaces},
                {"size", {map.width, map.height}},
                {"kept", true},
                {"format", map.format},
                {"degrees_unconverted", toJson(r.unconverted)},
                {"bytes_before", map.bytesBefore},
                {"bytes_after", map.bytesAfter}};
    return {{"image", map.image},
            {"name", map.name},
            {"surfaces", map.surfaces},
            {"size", {map.width, map.height}},
            {"kept", false},
            {"bits", map.bits},
            {"format", map.format},
            {"quality", map.quality > 0 ? Json(map.quality) : Json(nullptr)},
            {"texels_covered", r.covered},
            {"texels_padded", r.padded},
            {"texels_in_several_places", r.several},
            {"texels_that_disagree", r.disagreeing},
            {"disagreement_degrees", toJson(r.disagreement)},
            {"moved_degrees", toJson(r.moved)},
            {"degrees_unconverted", toJson(r.unconverted)},
            {"degrees_after_rounding", toJson(r.error)},
            {"below_horizon", r.belowHorizon},
            {"kept_elsewhere", map.alsoElsewhere},
            {"bytes_before", map.bytesBefore},
            {"bytes_after", map.bytesAfter}};
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
    for (const TurnedDirection& turned : d.directions)
        json["anisotropy"].push_back({{"mesh", turned.mesh},
                                      {"primitive", turned.primitive},
                                      {"material", turned.material},
                                      {"turned_degrees", toJson(turned.degrees)},
                                      {"tangents_stay", turned.stays}});
    return json;
}

} // namespace cotan
