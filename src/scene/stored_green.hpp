// Green of normal maps whose stored tangents contradict the texture coordinates.
//
// Some files store every TANGENT.w with the wrong sign beside a normal map whose green points the other way: together
// they are right, each alone is wrong. Drawing such a file without its tangents is to show what its tangents mean.
#pragma once

#include <string>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan {

// Fractions of the area that shows a normal map and has tangents. From the first on, w contradicts the texture
// coordinates on so much of it that green is read the other way; from the second on, it is mentioned.
inline constexpr double kGreenReversedFrom = 0.9, kGreenMentionedFrom = 0.1;

// Reads normal maps as the stored tangents mean them. Where TANGENT.w contradicts the texture coordinates on at least
// kGreenReversedFrom of the area of a map, green of the map and w of the tangents change sign together
// (Material::greenReversed): frames from the stored tangents show what they showed before, and all others show the
// same. A corner contradicts where the stored bitangent points against dP/dv and the stored tangent along dP/du;
// triangles without area, in space or in uv, do not count, nor do meshes without tangents. Materials that share a
// normal map, also that of a clear coat, are decided together. A material whose anisotropy has a map of directions
// keeps its declaration. Returns a line for each map that was changed, and for each on which at least
// kGreenMentionedFrom contradicts.
std::vector<std::string> followStoredTangents(Scene& scene);

// Takes that back for a material, or for all with -1: green as declared, w as stored.
void restoreDeclaredGreen(Scene& scene, int material = -1);

} // namespace cotan
