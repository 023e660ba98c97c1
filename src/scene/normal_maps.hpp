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

// Fractions of a compared area.
inline constexpr double kGreenReversedFrom = 0.9, kGreenMentionedFrom = 0.1;

// What the stored tangents of a mesh show of green, as areas: where corners could be compared with dP/du and dP/dv, and
// where these contradict: the stored bitangent points against dP/dv and the stored tangent along dP/du.
struct StoredGreen {
    bool present = false; // the mesh has tangents
    double compared = 0, contradicting = 0;

    void add(const StoredGreen& o) { compared += o.compared, contradicting += o.contradicting; }
    double fraction() const { return compared > 0 ? contradicting / compared : 0; }
};

// uv: those that the tangents belong to, one per vertex. Triangles without area in space or in uv, and corners without
// a tangent or normal, do not count.
StoredGreen storedGreen(const Mesh& mesh, const std::vector<glm::vec2>& uv);

// Whether the map is read with green flipped on a mesh without its tangents: the mesh contradicts on at least
// kGreenReversedFrom of its area. If it contradicts on less, but on more than kGreenMentionedFrom, or nothing of it
// could be compared, all meshes with the map decide. A mesh that has no tangents reads green as declared.
bool readsReversed(const StoredGreen& mesh, const StoredGreen& map);

// Whether material i is the one with index `material`, or a copy of it; any material if `material` is -1.
inline bool isMaterial(const Scene& scene, std::size_t i, int material)
{
    return material < 0 || int(i) == material || scene.materials[i].copyOf == material;
}

// Interprets normal maps as the stored tangents imply: where a mesh reads its map reversed (readsReversed), green of
// the material and w of the tangents change sign together (Material::greenReversed). Frames from stored tangents then
// give the same result as before, and all other frames agree with them. A material that other meshes read too is copied
// (Material::copyOf); one whose anisotropy has a direction map is not changed. Returns one line for each map that is
// flipped on some mesh, or on which at least kGreenMentionedFrom of the area contradicts.
std::vector<std::string> reconcileGreenWithTangents(Scene& scene);

// Undoes reconcileGreenWithTangents for a material, or for all if -1: green as declared, w as stored, no copies.
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

// The frame that the file names for the maps of one material, likewise; and for one mesh, whose own name counts first.
std::optional<Frame> namedFrameOf(const Scene& scene, const Material& material);
std::optional<Frame> namedFrameOf(const Scene& scene, const Mesh& mesh);

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

// The frame that the maps are for, against which errors are measured: the one that the file names, `mikktspace` for
// other maps of models. `exact` for maps in `cotangent` or `triangle`, whose directions it has for a whole triangle.
Frame meantFrame(const Scene& scene, MapSource source);

// Returns a one-line warning if the maps are named for a frame other than `frame` or for several; otherwise, and for
// frames of meshes (none), empty.
std::string frameNote(const Scene& scene, std::optional<Frame> frame);

// ---- another map -----------------------------------------------------------------------------

// Adds the image to the scene and assigns it to `slot` of the materials with a default sampler; uv set and transform of
// the replaced texture are kept (uv set 0 if there was none). material: as for isMaterial, checked by the caller.
// change(Material&): further changes to each material.
template<class Change>
void assignImage(Scene& scene, Image image, Texture Material::*slot, int material, const Change& change)
{
    const int number = int(scene.images.size());
    scene.images.push_back(std::move(image));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!isMaterial(scene, i, material))
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
