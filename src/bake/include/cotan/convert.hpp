// Makes all normal maps of a glTF file for another frame:
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
// and puts a map of one's own into a file. Part of the library cotan::bake.
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
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- what to convert ------------------------------------------------------------------------

struct FramePair {
    Frame from = Frame::mikktspace, to = Frame::cotangent; // view independent, both
    TangentOrigin fromTangents = TangentOrigin::stored, toTangents = TangentOrigin::generated;
};

struct ConvertedMap;

struct ConvertModelOptions {
    FramePair frames{}; // neither may depend on the view
    int bits = 0;       // of the new maps, 8 or 16: writes all anew; 0: bits of the old map, and a map that fits stays
    // How engines that read the maps take their numbers: biased, 2c - 1, as glTF says and stock engines do, or exact,
    // Cotan's own. New maps are written so, and material extras say so (kUnsignedKey); old ones are read so, unless
    // theirs say another. Maps that a clear coat reads are exact.
    Expansion expansion = Expansion::biased;
    // All maps stay, byte for byte, to be read with frames.to, which may not read tangents: only tangents go.
    bool keepMaps = false;
    bool keepTangents = false; // leave TANGENT where the new frame does not read it
    int threads = 0;           // 0: all cores; the result does not depend on it
    std::size_t memory = 0;    // bytes that the triangles may take besides the document; 0: any number
    LoadLimits limits{};       // of reading the pictures
    // The PNG file of each new map, in place of Cotan's own writers; on the thread of the caller. May be empty.
    std::function<Result<std::vector<std::byte>>(const Image&)> encode{};
    Progress progress{}; // from any thread, also from several at once
    // Gets each map when it is done, in the order of the report, on the thread of the caller.
    std::function<void(const ConvertedMap&)> mapDone{};
};

// ---- what comes of it -----------------------------------------------------------------------

inline constexpr double kDisagree = 0.5; // degrees: about what rounding to 8 bits costs at worst

// What a conversion did to a map, in texels and degrees.
struct ReencodeFigures {
    std::size_t covered = 0;      // texels whose centre some triangle covers
    std::size_t padded = 0;       // others, converted as at the nearest place
    std::size_t several = 0;      // covered by more than one place
    std::size_t disagreeing = 0;  // ... and off by over kDisagree in one of them, before rounding
    std::size_t belowHorizon = 0; // texels with z <= 0
    ValueSummary moved;           // degrees between old and new decoded texel, covered ones
    ValueSummary disagreement;    // degrees of the worst place, before rounding, of the disagreeing
    ValueSummary unconverted;     // mapError of the old map: off by so much if it were read with the new frame
    ValueSummary error;           // mapError of the new one, after rounding
};

// What became of one normal map.
struct ConvertedMap {
    std::size_t image = 0; // index into the file's images, before the conversion
    std::string name;
    std::size_t surfaces = 0;  // that read it: primitives, as materials and nodes show them
    int width = 0, height = 0; // texels
    bool kept = false; // stays, byte for byte: the new frame reads it as well as a rounded new one, or nothing shows it
    bool alsoElsewhere = false; // the old one stays in the file too: another slot of a material reads it
    int bits = 0;               // of the new one, 8 or 16 a component; 0 where it is kept
    std::string format{};       // of the picture file that is in the model then: "PNG", "JPEG", "WebP"
    int quality = 0;            // of a new JPEG, or of a WebP with losses, 1 to 100: about that of the old one; else 0
    ReencodeFigures figures{};  // as it is in the file, with what its format loses; of a map that is kept only
                                // `unconverted`; its count is 0 where nothing shows the map
    std::size_t bytesBefore = 0, bytesAfter = 0; // of the picture file
};

// How far highlights that are stretched along tangents (KHR_materials_anisotropy) turn when the new frame says where.
struct TurnedDirection {
    std::size_t mesh = 0, primitive = 0, material = 0;
    ValueSummary degrees; // directionTurn; empty where the new frame has no direction: no uv
    bool stays = false;   // TANGENT, for it: turned by over kTurnedDirection, or nothing else has the direction
};

struct TangentBytes {
    std::size_t vertices = 0; // that had TANGENT
    std::size_t bytes = 0;    // of their accessors, morph targets included
    std::size_t primitives = 0;
    std::vector<TurnedDirection> directions; // of all primitives with TANGENT and stretched highlights
};

// A normal map that stays as it is, since its format is not read here.
struct UnreadMap {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::string format; // "KTX2 with BasisU (ETC1S)"
    std::string advice; // what to do, one line
};

enum class TangentsAfter { given, kept, dropped };

struct ConvertModelReport {
    std::vector<ConvertedMap> maps;                  // in the order of the file's images
    TangentsAfter tangents = TangentsAfter::dropped; // given: the new frame reads them; kept: keepTangents
    std::size_t primitivesGiven = 0;                 // that have new tangents
    TangentBytes dropped;
    std::vector<UnreadMap> unread;  // normal maps that stay, since their format is not read here
    std::vector<std::string> notes; // what the user should know, one line each
};

// Makes every normal map of the file for another frame: each texel is decoded with the old frame at its places on the
// surfaces, and encoded with the new one (see reencode). Then gives the primitives TANGENT where the new frame reads
// it, or drops it where nothing else does. The materials say for which frame their maps are then (nameFrame).
// New maps have the format of the old ones where that is written here (encodeLike), and a note says where it is not,
// and what it costs. Maps in formats that are not read here stay as they are, and a note says so. Errors:
// ErrorKind::usage for a frame that depends on the view and other bits; ErrorKind::input for a picture that cannot be
// read or is over the limits, more than 50,000 triangles that each cover a map of 2048 rows, triangles that take more
// than options.memory, found before anything is done, compressed geometry, and materials that name another frame than
// frames.from;
// ErrorKind::output where there is no memory for a PNG; ErrorKind::stopped. On error the document is unchanged.
Result<ConvertModelReport> convertModel(GltfDocument& document, const ConvertModelOptions& options);

// ---- the frame that a file names ------------------------------------------------------------

// The frame that the materials with a normal map name; none where they name none, or what is no frame.
// Errors (ErrorKind::input): they name different ones, so that no one conversion serves all.
Result<std::optional<Frame>> namedFrame(const GltfDocument& document);

// Makes a material say that its normal maps are for the frame; for mikktspace, which glTF means without a name, it says
// nothing. What else is in its extras stays, but extras that are no object.
void nameFrame(GltfDocument& document, std::size_t material, Frame frame);

// ---- a map of one's own ---------------------------------------------------------------------

struct PutMapOptions {
    Frame frame = Frame::mikktspace;     // that the map was made for
    std::optional<std::string> material; // name of the one that gets it; none: all, and primitives without one get one
    Expansion expansion = Expansion::exact; // how the map stores signed numbers; the materials say it
    bool keepTangents = false; // for mikktspace and vertex: the file's TANGENT is what the map was made with. Else
                               // it is generated. For other frames it goes, as dropTangents has it
};

// Makes materials read a PNG as their normal map at full strength, by the uv set, the transform and the place in the
// file of the map that was there. `notes`: what the user should know, one line each.
// Errors (ErrorKind::input): "document: ..." where not exactly one material has that name; compressed geometry.
Status putNormalMap(GltfDocument& document, std::vector<std::byte> png, const PutMapOptions& options,
                    std::vector<std::string>& notes);

// A model with a new map in it: one named as glTF keeps all else as it was, another, which `scene` is from, becomes
// glTF. GltfWritten::notes begin with what putNormalMap has to say. Errors: as putNormalMap, openGltfDocument,
// encodePng and writeGltf.
Result<GltfWritten> writeModelWithMap(const Scene& scene, const std::filesystem::path& model, const Image& map,
                                      const PutMapOptions& options, const std::filesystem::path& output);

} // namespace cotan
