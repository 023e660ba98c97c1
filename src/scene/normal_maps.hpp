// What the normal maps of a scene mean: which way their green points, which frame they are for; and others put in their
// place.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan {

// ---- green -----------------------------------------------------------------------------------

// Some files store every TANGENT.w with the wrong sign beside a normal map whose green points the other way: together
// they are right, each alone is wrong. Drawing such a file without its tangents is to show what its tangents mean.

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

// ---- the frame -------------------------------------------------------------------------------

// The frame that the files name for the scene's normal maps (Material::normalFrame, else Image::frame of the map); none
// where they name none. Where materials differ, it is the one with the largest area of the world; `others` says how
// many of the materials with a normal map are for another frame, those that name none among them.
struct NamedFrame {
    Frame frame = Frame::cotangent;
    std::size_t others = 0;
};
std::optional<NamedFrame> namedFrame(const Scene& scene);

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

// ---- another map -----------------------------------------------------------------------------

// Adds the image to the scene and makes the materials read it in `slot`, repeated, by the uv set and transform of the
// picture that it takes the place of; where there was none, by uv set 0 as it is. material: index into scene.materials,
// which the caller has checked; -1: all of them. change(Material&): what else a material becomes by it.
template<class Change>
void putPicture(Scene& scene, Image image, Texture Material::*slot, int material, const Change& change)
{
    const int number = int(scene.images.size());
    scene.images.push_back(std::move(image));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (material >= 0 && int(i) != material)
            continue;
        Material& m = scene.materials[i];
        (m.*slot).image = number;
        (m.*slot).sampler = {};
        change(m);
    }
}

// The same for a normal map, at full strength and for the frame that the image names; the tangents of the meshes become
// those of the file again.
inline void putNormalMap(Scene& scene, Image image, const Convention& format, int material = -1)
{
    restoreDeclaredGreen(scene, material);
    const std::optional<Frame> named = frameFromName(image.frame);
    putPicture(scene, std::move(image), &Material::normalMap, material, [&](Material& m) {
        m.normalScale = 1;
        m.normalFormat = format;
        m.normalFrame = named;
    });
}

} // namespace cotan
