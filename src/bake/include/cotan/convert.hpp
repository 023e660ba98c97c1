// Converts all normal maps of a glTF file to another frame:
//
//     auto document = cotan::openGltfDocument("in.glb");
//     if (!document)
//         return fail(document.error().message);
//     auto report = cotan::convertModel(*document, {.frames = {cotan::Frame::mikktspace, cotan::Frame::smooth}});
//     if (!report)
//         return fail(report.error().message);
//     for (const cotan::ConvertedMap& map : report->maps)
//         std::printf("%s: %s\n", map.name.c_str(), map.kept ? "stays as it is" : "converted");
//     auto written = cotan::writeGltf(*document, "out.glb");
//
// It can also put a new normal map into a file. Part of the library cotan::bake.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/files.hpp"
#include "cotan/frame.hpp"
#include "cotan/frame_choice.hpp"
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- what to convert ------------------------------------------------------------------------

struct FramePair {
    Frame from = Frame::mikktspace, to = Frame::cotangent; // neither may depend on the view
    TangentOrigin fromTangents = TangentOrigin::stored, toTangents = TangentOrigin::generated;
};

struct ConvertModelOptions {
    FramePair frames{}; // neither may depend on the view
    int bits = 0;       // of the new maps, 8 or 16: converts all; 0: as the old map, and maps that fit stay
    // How engines that read the maps expand stored numbers: biased, 2c - 1, as glTF says and stock engines do; or
    // exact, Cotan's own. New maps are written like that, and material extras record it (kUnsignedKey). Old maps are
    // read like that unless their extras say otherwise. Maps that a clear coat reads are written exact.
    Expansion expansion = Expansion::biased;
    // Chooses the frame of each primitive by measurement (chooseFrames) in place of frames.to, and keeps all maps:
    // drops tangents where nobody can see it, and names the frame in the primitive's extras. Needs keepMaps and
    // readMaps. The materials of all variants count; many of them share the points and triangles that are judged.
    std::optional<ChoiceLimits> choose{};
    // Keeps all maps, byte for byte, to be read with frames.to, which must not read tangents; only drops tangents.
    // Where the tangents of the file reverse green of a map on all surfaces that show it, they are dropped and green of
    // the map is reversed, unless its file would grow by over 10 %. Otherwise, the surfaces on which they reverse it
    // keep them.
    bool keepMaps = false;
    bool readMaps = true;      // false, with keepMaps: the maps are not even decoded, and the report has none
    bool keepTangents = false; // keep TANGENT where the new frame does not read it
    int threads = 0;           // 0: all cores; the result does not depend on it
    std::size_t memory = 0;    // bytes that the triangles may take besides the document; 0: no limit
    LoadLimits limits{};       // for reading the images
    // Encodes each new map as a PNG file, in place of Cotan's own writers, on the caller's thread. The file is decoded
    // again for ReencodeFigures::error. Other bytes are taken unread, for callers who replace them later. May be empty.
    std::function<Result<std::vector<std::byte>>(const Image&)> encode{};
    Progress progress{}; // called from any thread, also from several at once
};

// ---- results --------------------------------------------------------------------------------

inline constexpr double kDisagree = 0.5; // degrees: about the maximum error of rounding to 8 bits

// Statistics of the conversion of one map, in texels and degrees.
struct ReencodeFigures {
    std::size_t covered = 0;      // texels whose centre some triangle covers
    std::size_t padded = 0;       // other texels, converted at the nearest surface point
    std::size_t several = 0;      // covered texels that show several surface points
    std::size_t disagreeing = 0;  // texels with an error over kDisagree at one of their points, before rounding
    std::size_t belowHorizon = 0; // covered texels with z <= 0
    ValueSummary moved;           // degrees between old and new decoded texel, for covered texels
    ValueSummary disagreement;    // degrees at the worst point of each disagreeing texel, before rounding
    ValueSummary unconverted;     // mapError of the old map, read with the new frame
    ValueSummary error;           // mapError of the new map, after rounding
};

// Result for one normal map.
struct ConvertedMap {
    std::size_t image = 0; // index into the file's images, before the conversion
    std::string name;
    std::size_t surfaces = 0;  // primitives that read it, once for each material and distinct placing
    int width = 0, height = 0; // texels
    bool kept = false; // unchanged, byte for byte: keepMaps, or the new frame reads it as well as a rounded new map
    std::vector<Frame> readWith{}; // frames that read a map that stays, in their order
    bool greenReversed = false;    // kept but for green, which is reversed: so the file's tangents showed the map
    std::size_t surfacesWithTangents = 0; // of `surfaces`, with keepMaps: they keep TANGENT, which reverses green
    bool alsoElsewhere = false; // the old map stays in the file too, because another slot of a material reads it
    int bits = 0;               // of the new map, 8 or 16 per component; 0 if kept
    std::string format{};       // of the image file that is then in the model: "PNG", "JPEG", "WebP"
    int quality = 0;            // of a new JPEG or lossy WebP, 1 to 100: about that of the old one; otherwise 0
    ReencodeFigures figures{};  // of the map in the file, with the losses of its format; of a kept map only
                                // `unconverted`, whose count is 0 if no surface shows the map
    std::size_t bytesBefore = 0, bytesAfter = 0; // of the image file
};

// How far anisotropic highlights (KHR_materials_anisotropy) rotate when the new frame defines their direction.
struct RotatedDirection {
    std::size_t mesh = 0, primitive = 0, material = 0;
    ValueSummary degrees; // directionTurn; empty if the new frame has no direction: no uv
    bool stays = false;   // TANGENT stays: the rotation exceeds kTurnedDirection, or nothing else defines the direction
};

struct TangentBytes {
    std::size_t vertices = 0; // that had TANGENT
    std::size_t bytes = 0;    // of their accessors, morph targets included
    std::size_t primitives = 0;
    std::vector<RotatedDirection> directions; // of all primitives with TANGENT and anisotropy
};

// A normal map that stays unchanged because its format is not read here.
struct UnreadMap {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::string format; // for example "AVIF"
    std::string advice; // what to do, one line
};

enum class TangentsAfter { given, kept, dropped };

struct PrimitiveDecision {
    SourcePrimitive primitive;
    FrameDecision decision; // with all candidates
};

struct ConvertModelReport {
    std::vector<ConvertedMap> maps;                  // in the order of the file's images
    TangentsAfter tangents = TangentsAfter::dropped; // given: the new frame reads them; kept: keepTangents
    std::size_t primitivesGiven = 0;                 // primitives with new tangents
    TangentBytes dropped;
    std::vector<PrimitiveDecision> decisions; // with options.choose: of all primitives that are drawn
    std::vector<UnreadMap> unread;            // normal maps that stay because their format is not read here
    std::vector<std::string> notes;           // what the user should know, one line each
};

// Converts every normal map of the file to another frame: decodes each texel with the old frame at its surface points,
// and encodes it with the new one (see reencode). Then gives the primitives TANGENT if the new frame reads it, or drops
// it where nothing else does. The materials name the frame of their maps then (nameFrame). A new map has the format of
// the old one if that can be written here (encodeLike); otherwise a note says why and what that costs. Maps in formats
// that are not read here stay unchanged, and a note says so.
// Errors: ErrorKind::usage for a frame that depends on the view, other bits, and keepMaps with keepTangents or a frame
// that reads tangents; ErrorKind::input for an image that cannot be read or exceeds the limits, triangles in more than
// 4e7 rows of texels of one map in all, triangles that take more than options.memory, compressed geometry, and
// materials or images that name another frame than frames.from; ErrorKind::output if there is no memory for a PNG;
// ErrorKind::stopped. On error the document is unchanged.
Result<ConvertModelReport> convertModel(GltfDocument& document, const ConvertModelOptions& options);

// The same for a model that was opened with the limits that `options` has, and Pixels::normalMaps if frames are chosen.
// Its scene is used in place of another one, and is empty afterwards.
Result<ConvertModelReport> convertModel(OpenGltf& model, const ConvertModelOptions& options);

// ---- how maps are stored --------------------------------------------------------------------

// A function that makes a KTX2 of a normal map, with all its levels. name: for messages.
using EncodeTexture = std::function<Result<std::vector<std::byte>>(const Image& map, const std::string& name)>;

struct StoredMap {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::size_t bytesBefore = 0, bytesAfter = 0;
};

struct StoredMaps {
    std::vector<StoredMap> maps;    // in the order of the file's images
    std::vector<std::string> notes; // maps that stay as they are, one line each
};

// Stores every normal map that convertModel converts as KTX2, which `extension` names, such as KHR_texture_basisu; the
// model then requires readers of it. Maps that are KTX2 stay, and with KHR_texture_basisu, whose sides are multiples of
// four, maps of other sizes. Errors: those of mapJobs, of reading the images and of `encode`; ErrorKind::stopped. On
// error the document is unchanged.
Result<StoredMaps> storeNormalMaps(GltfDocument& document, const EncodeTexture& encode, const std::string& extension,
                                   const LoadLimits& limits = {}, const Progress& progress = {});

// ---- the frame that a file names ------------------------------------------------------------

// The frame named by the materials that have a normal map; none if they name none or no known frame. Errors
// (ErrorKind::input): the materials name different frames, so that no single conversion serves all.
Result<std::optional<Frame>> namedFrame(const GltfDocument& document);

// Writes into a material's extras which frame its normal maps are for; removes the entry for mikktspace, which is
// glTF's default. Other extras stay, unless `extras` is not an object.
void nameFrame(GltfDocument& document, std::size_t material, Frame frame);

// ---- inserting a map ------------------------------------------------------------------------

struct PutMapOptions {
    Frame frame = Frame::mikktspace;        // that the map was made for
    std::optional<std::string> material;    // name of the material; none: all, and primitives without one get one
    Expansion expansion = Expansion::exact; // how the map stores signed numbers; the materials record it
    bool keepTangents = false; // for frames of tangents: the map was made with the file's TANGENT, which stays.
                               // Otherwise it is generated. For other frames it is dropped as by dropTangents
    EncodeTexture encode{};    // by storeNormalMaps, with `extension`; empty: the normal map stays PNG
    std::string extension{};
};

// Makes materials read a PNG as their normal map, at full strength and with the uv set and transform of their previous
// map. `notes`: for the user, one line each. Errors (ErrorKind::input): "document: ..." unless exactly one material has
// the given name; compressed geometry.
Status putNormalMap(GltfDocument& document, std::vector<std::byte> png, const PutMapOptions& options,
                    std::vector<std::string>& notes);

// Maps for materials; null: none. All have one size and type.
struct MaterialImages {
    const Image* normal = nullptr;
    const Image* occlusion = nullptr;         // red
    const Image* roughnessMetallic = nullptr; // green and blue; may be the same image as the occlusion
    const Image* baseColor = nullptr;         // sRGB
    const Image* emissive = nullptr;          // sRGB
};

// Puts maps into the document, which the call changes, and writes it. Materials read them at full strength, with the uv
// set and transform of their normal maps; alpha of their base colour stays. Occlusion and roughness become one image.
// GltfWritten::notes begin with those of putNormalMap. Errors: those of putNormalMap, encodePng,
// storeNormalMaps and writeGltf.
Result<GltfWritten> writeModelWithMaps(GltfDocument& document, const MaterialImages& maps, const PutMapOptions& options,
                                       const std::filesystem::path& output);

} // namespace cotan
