// Surroundings as light: from a picture, or by a formula.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/environment.hpp"

namespace cotan {

// Linear radiance from a unit direction, world, y up. Called from several threads. Values that are not finite or
// negative count as 0, larger ones than 65504 as that.
using Radiance = std::function<glm::vec3(glm::vec3 direction)>;

struct EnvironmentOptions {
    float rotation = 0;  // radians around y: the surroundings turn counter-clockwise, seen from above
    float intensity = 1; // factor on all radiance
};

// The atlas of a radiance. The same bytes for any number of threads.
// samples: a side, in each texel of the finest tile; enough that nothing in the radiance is smaller.
EnvironmentMap makeEnvironment(const Radiance& radiance, int samples, const EnvironmentOptions& options = {});

// The atlas of a picture in equirectangular projection: twice as wide as high, up on top, its middle towards +x, and
// +z a quarter of the width to the right of it.
// Errors: ErrorKind::input for another shape or another type than float32.
Result<EnvironmentMap> environmentOfPicture(const Image& picture, const EnvironmentOptions& options = {});

// The built-in ones: "studio" (soft boxes in a dark room), "overcast", "evening".
const std::vector<std::string>& environmentNames();

// Nothing for a name that is not among them.
std::optional<Radiance> builtinRadiance(const std::string& name);

} // namespace cotan
