// The frame that a scene's normal maps are to be read with, where nobody names one.
#pragma once

#include <optional>
#include <string>

#include "cotan/scene.hpp"

namespace cotan {

// The frame that the files name for the scene's normal maps (Material::normalFrame, else Image::frame of the map); none
// where they name none. Where
// materials differ, it is the one with the largest area of the world; `others` says how many of the materials with a
// normal map are for another frame, those that name none among them.
struct NamedFrame {
    Frame frame = Frame::cotangent;
    std::size_t others = 0;
};
std::optional<NamedFrame> namedFrame(const Scene& scene);

// Whether the texture coordinates of some mesh that shows a normal map reach over more than one copy of it.
bool repeatsNormalMaps(const Scene& scene);

// Where the normal maps of a scene come from.
enum class MapSource {
    model, // the file of a model: made for MikkTSpace where it names no frame, as glTF says
    own,   // an image that was put on a model
    shape, // an image that was put on a built-in shape, or the built-in scene
};

// The frame `auto`: the one that is named; else for maps of a model orthonormal, the reading of MikkTSpace without
// tangents; for an image that was put on a model the same, but cotangent where the texture coordinates repeat it; for
// shapes, and for scenes without a normal map, cotangent.
Frame autoFrame(const Scene& scene, MapSource source);

// What to tell somebody who draws the scene with that frame: a line where the maps are named for another one, or for
// several; empty otherwise.
std::string frameNote(const Scene& scene, Frame frame);

} // namespace cotan
