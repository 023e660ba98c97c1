// Connects a glTF file with the conversion of its normal maps: which primitives read which image, how new images are
// put into the file, and which tangents are then dropped.
#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bake/convert/reencode.hpp"
#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"
#include "gltf/json/views.hpp"
#include "scene/normal_maps.hpp"

namespace cotan {

// A normal map's slot in a material.
struct MapSlot {
    std::size_t material = 0;
    NormalSlot kind = NormalSlot::surface;

    auto operator<=>(const MapSlot&) const = default;
};

// The name that reports, and decoders of the caller, get for an image: its name, else its URI, else its number.
std::string imageName(const gltf::Json& root, std::size_t image);

// A primitive that reads a map through one of its materials.
struct MapReader {
    std::size_t mesh = 0, primitive = 0;
    MapSlot slot;
    double strength = 1; // the material's factor on the slopes
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    std::vector<glm::dmat3> transforms; // node transforms; each makes a surface
    std::size_t vertices = 0, triangles = 0;
    bool stored = false;   // has TANGENT
    StoredGreen green{};   // what TANGENT shows of the map's green
    bool reversed = false; // TANGENT reverses green: readsReversed
    bool keeps = false;    // TANGENT stays, since a coat, anisotropy or a decision needs it: it shows the map as before
    bool follows = false;  // keeps, and nothing else reads TANGENT: its w can follow green of the map
    std::optional<Frame> readWith{}; // as in MapUse
};

// Whether TANGENT reverses green that can be seen.
inline bool showsReversed(const MapReader& reader) { return reader.reversed && std::abs(reader.strength) > kFlattened; }

// An image and everything that reads it as a normal map.
struct MapJob {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::vector<MapReader> readers;
    std::vector<MapSlot> slots;        // slots that read it as a normal map
    std::vector<std::size_t> textures; // textures of the file that show the image
    bool alsoElsewhere = false;        // another kind of slot reads it too, so it must stay unchanged
};

// The jobs of a file, in the order of its images. A mesh is several surfaces if nodes place it by linear maps that are
// not rotations and uniform scales of one another, or if KHR_materials_variants gives it several materials. A coat's
// map is read on a surface of its own (makeCoatSurface). `notes` lists the maps that are left out. limits: for reading
// the images, here and below. unread: takes maps in formats that are not read here too. Errors (ErrorKind::input):
// compressed geometry.
Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes,
                                    const LoadLimits& limits = {}, bool unread = false);

// The number of surfaces that read the job's image.
std::size_t surfacesOf(const MapJob& job);

// Negates w of TANGENT, so that a map whose green was reversed is shown as before. Errors: those of setGltfTangents.
Status reverseBitangents(GltfDocument& document, std::size_t mesh, std::size_t primitive);

// Whether without TANGENT every surface that shows the map reads it with green reversed; none does; or both are there.
enum class GreenWithoutTangents { declared, reversed, both };
GreenWithoutTangents greenWithoutTangents(const MapJob& job);

// The surfaces, with the vertex data that frames.from and frames.to read. Errors: those of mapJobs.
Result<std::vector<MapUse>> usesOf(const GltfDocument& document, const MapJob& job, const FramePair& frames);

// About the maximum number of bytes that the job takes besides the document and the image.
std::size_t bytesOf(const MapJob& job, const FramePair& frames);

// Replaces a job's image where normal maps read it. mime: "image/png", "image/jpeg", or "image/webp", which
// EXT_texture_webp then names; or "image/ktx2", with the extension that names it in `namedBy`. Drops other forms of the
// old image (EXT_texture_webp, KHR_texture_basisu), which readers would prefer; `notes` says so.
void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> bytes, const std::string& mime,
                std::vector<std::string>& notes, const std::string& namedBy = {});

// The slots of normal maps in a format that is not read here, named by an extension or, against glTF, by the texture.
std::vector<MapSlot> foreignNormalMaps(const GltfDocument& document, const LoadLimits& limits = {});

// The images of these slots, in the order of the file's images.
std::vector<UnreadMap> unreadNormalMaps(const GltfDocument& document, const LoadLimits& limits = {});

// A primitive that keeps TANGENT, and why: the end of a note about `material`.
struct KeptTangents {
    std::size_t mesh = 0, primitive = 0, material = 0;
    std::string reason; // empty: without a note
};

// Drops TANGENT from all primitives except those of `kept`, and those whose materials need it: because glTF requires
// it, for a normal map of `foreign`, or for a direction that frames.to, or the frame of `decisions`, rotates. `notes`
// says so, one line each. Errors (ErrorKind::input): compressed geometry.
Result<TangentBytes> dropTangents(GltfDocument& document, const FramePair& frames, const std::vector<MapSlot>& foreign,
                                  const std::vector<KeptTangents>& kept,
                                  const std::vector<PrimitiveDecision>& decisions, std::vector<std::string>& notes);

} // namespace cotan
