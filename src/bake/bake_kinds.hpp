// The names of the kinds of maps, for all who offer them.
#pragma once

#include "core/named_values.hpp"
#include "cotan/bake.hpp"

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

} // namespace cotan
