// Where on a model to look: the worst places of what lint takes shares of.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/scene/scene.hpp"

namespace cotan {

struct HotSpot {
    std::string text; // "sheared over 10 degrees: 12.3 % of body, here 63"
    std::size_t mesh = 0;
    double share = 0;   // of the mesh's area, as lint has it
    double badness = 0; // what the list is sorted by
    Camera camera; // looks at the worst triangle of its kind along its normal, with an eighth of the model around it
    std::array<glm::vec3, 3> corners{}; // of that triangle, world
    std::string_view view;              // the view of `cotan view` and `render` that shows what is wrong
    bool storedTangents = false;        // which that view shows with the stored tangents only
};

// For each mesh, as its first instance moves it, and each of these that lint (cotan/lint/lint.hpp) finds on it: uv
// without area, stretched over kStretched, sheared over kSheared; w of stored tangents against the uv, stored tangents
// turned over kTurned. The worst first; at most `most`. Where something stands between the camera and its triangle, the
// camera is nearer, if the triangle fits into the picture from there.
std::vector<HotSpot> hotSpots(const Scene& scene, std::size_t most = 50);

} // namespace cotan
