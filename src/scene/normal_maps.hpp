// How the normal maps of a scene are interpreted: the direction of green and the frame; and how to replace maps.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan {

// ---- green -----------------------------------------------------------------------------------

// Some files store every TANGENT.w with the wrong sign beside a normal map whose green is flipped: the two errors
// cancel, but each alone is wrong. When such a file is drawn without its tangents, the result should still be what its
// tangents show.

// Fractions of the area that has a normal map and tangents. If w contradicts the texture coordinates on at least the
// first fraction, green is flipped; on at least the second, the contradiction is reported.
inline constexpr double kGreenReversedFrom = 0.9, kGreenMentionedFrom = 0.1;

// Interprets normal maps as the stored tangents imply. Where TANGENT.w contradicts the texture coordinates on at least
// kGreenReversedFrom of a map's area, green of the map and w of the tangents change sign together
// (Material::greenReversed): frames from stored tangents give the same result as before, and all other frames now agree
// with them. A corner contradicts if the stored bitangent points against dP/dv and the stored tangent along dP/du;
// triangles without area in space or in uv, and meshes without tangents, do not count. Materials that share a normal
// map, including clear coat maps, are decided together. A material whose anisotropy has a direction map is not changed.
// Returns one line for each map that was changed, and for each on which at least kGreenMentionedFrom of the area
// contradicts.
std::vector<std::string> reconcileGreenWithTangents(Scene& scene);

// Undoes reconcileGreenWithTangents for a material, or for all if -1: green as declared, w as stored.
void restoreDeclaredGreen(Scene& scene, int material = -1);

// ---- the frame -------------------------------------------------------------------------------

// The frame that the files name for the scene's normal maps (Material::normalFrame, otherwise Image::frame of the map);
// nothing if they name none. If materials differ, the frame with the largest world-space area is returned; `others` is
// the number of materials with a normal map for another frame or for none.
struct NamedFrame {
    Frame frame = Frame::cotangent;
    std::size_t others = 0;
};
std::optional<NamedFrame> namedFrame(const Scene& scene);

// Where the normal maps of a scene come from.
enum class MapSource {
    model, // a model's file: made for MikkTSpace unless it names a frame, as glTF specifies
    own,   // an image that the user applied to a model
    shape, // an image that the user applied to a built-in shape, or the built-in scene
};

// Returns the frame that `auto` stands for: the named one, if any. Otherwise cotangent for shapes, for scenes without
// normal maps, and for an applied image that the texture coordinates repeat; orthonormal (MikkTSpace's convention
// without tangents) in all other cases.
Frame autoFrame(const Scene& scene, MapSource source);

// Returns a one-line warning if the maps are named for a frame other than `frame` or for several; otherwise empty.
std::string frameNote(const Scene& scene, Frame frame);

// ---- another map -----------------------------------------------------------------------------

// Adds the image to the scene and assigns it to `slot` of the materials with a default sampler; uv set and transform of
// the replaced texture are kept (uv set 0 if there was none). material: index into scene.materials, checked by the
// caller; -1: all. change(Material&): further changes to each material.
template<class Change>
void assignImage(Scene& scene, Image image, Texture Material::*slot, int material, const Change& change)
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

// Like assignImage for a normal map, with full strength and the frame that the image names. The tangents of the meshes
// are restored to those of the file.
inline void putNormalMap(Scene& scene, Image image, const Convention& format, int material = -1)
{
    restoreDeclaredGreen(scene, material);
    const std::optional<Frame> named = frameFromName(image.frame);
    assignImage(scene, std::move(image), &Material::normalMap, material, [&](Material& m) {
        m.normalScale = 1;
        m.normalFormat = format;
        m.normalFrame = named;
    });
}

} // namespace cotan
