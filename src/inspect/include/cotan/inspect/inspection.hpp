// A scene in colours that show what a model is made of, to be drawn in place of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/scene/scene.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

enum class Inspection {
    checker,   // eight squares along u and v, numbered by colour
    density,   // texels per unit of length: green as the median, blue a quarter of it and less, red four times and more
    stretch,   // the longer axis over the shorter: black 1, blue 1.1, green 1.4, yellow 2, red 4, white 10 and more
    shear,     // degrees from a right angle: black 0, blue 0.5, green 2, yellow 5, red 15, white 45
    mirrored,  // blue as it is, orange mirrored, grey without area in uv
    w,         // of stored tangents: blue +1, orange -1, grey where there are none
    facing,    // blue from outside, red from inside
    baseColor, // this and what follows: one map with its factor, or a channel of it
    alpha,
    normalMap,
    normalMapRed,
    normalMapGreen,
    normalMapBlue,
    roughness,
    metallic,
    occlusion,
    emissive,
};

// Their names on the command line, in that order: "checker", "density", ... "normal-map-red" and so on.
std::span<const std::string_view> inspectionNames();
std::optional<Inspection> inspectionFromName(std::string_view name);

// The scene with unlit materials that show it. Cameras and instances stay. A mesh that several instances stretch
// differently counts as the first of them shows it.
Scene inspected(Scene scene, Inspection inspection);

// The view that draws it with its colours as they are: without light, tone curve and background.
View inspectionView(View view);

} // namespace cotan
