// The shadow of a scene on a level plane, which nothing else is seen of.
#pragma once

#include <optional>
#include <vector>

#include "cotan/scene/ground.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

struct GroundOptions {
    std::optional<float> height; // of the plane, world y; none: of the scene's lowest point
};

// The shadow that the scene throws on the plane in the light of the view: lights, environment or environmentMap,
// shadows, shadowSoftness; nothing else of it is read. The light that casts shadows falls through a disc as wide as
// the softness says; what comes from all around is dimmed by how much of the sky the scene hides, as if the sky were
// even. Each is told by rays through columns (what is between the lowest and the highest surface along the light, or
// upright, counts as full), so a hole in what stands can be missed by the light from the sky, not by the other.
// Translucent materials throw none, masked ones that of what their mask leaves. Nothing for a scene without extent,
// or when it gets no light. The same bytes for any number of threads. Takes about 0.1 s of processor time.
std::optional<GroundMap> makeGround(const Scene& scene, const View& view, const GroundOptions& options = {});

} // namespace cotan
