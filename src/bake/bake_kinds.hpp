// The names of the kinds of maps, for all who offer them.
#pragma once

#include <string_view>
#include <vector>

#include "core/named_values.hpp"
#include "cotan/bake.hpp"
#include "cotan/result.hpp"

namespace cotan {

inline constexpr Named<BakeKind> kBakeKinds[] = {{"normal", BakeKind::normal},
                                                 {"object-normal", BakeKind::objectNormal},
                                                 {"height", BakeKind::height},
                                                 {"ao", BakeKind::occlusion},
                                                 {"bent-normal", BakeKind::bentNormal},
                                                 {"object-bent-normal", BakeKind::objectBentNormal},
                                                 {"thickness", BakeKind::thickness},
                                                 {"curvature", BakeKind::curvature},
                                                 {"position", BakeKind::position},
                                                 {"base-color", BakeKind::baseColor},
                                                 {"roughness", BakeKind::roughness},
                                                 {"metallic", BakeKind::metallic},
                                                 {"roughness-metallic", BakeKind::roughnessMetallic},
                                                 {"emissive", BakeKind::emissive},
                                                 {"id", BakeKind::id}};

inline constexpr Named<IdBy> kIdBy[] = {
    {"material", IdBy::material}, {"object", IdBy::object}, {"vertex-color", IdBy::vertexColor}};

inline constexpr Named<BakeRays> kRays[] = {{"auto", BakeRays::automatic},
                                            {"averaged", BakeRays::averaged},
                                            {"straight", BakeRays::straight},
                                            {"vertex-color", BakeRays::vertexColor}};
inline constexpr Named<Occluders> kOccluders[] = {{"matched", Occluders::matched}, {"all", Occluders::all}};

inline constexpr std::string_view kPackedOrm = "orm"; // occlusion, roughness and metallic, as engines read them

// The kinds of a bake, and then those that only its packed maps need.
std::vector<BakeKind> kindsOf(const BakeModelOptions& options);

// Parses "R=ao,G=roughness,B=metallic,A=1", with "NAME:" before it for another name than "packed", or "orm", which is
// "orm:R=ao,G=roughness,B=metallic". Channels that are not given are 0, alpha 1. Errors: ErrorKind::usage.
Result<PackedMap> parsePackedMap(std::string_view text);

} // namespace cotan
