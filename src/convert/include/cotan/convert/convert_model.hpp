// Makes all normal maps of a glTF file for another frame, in one call.
//
//     auto document = openGltfDocument("in.glb");
//     auto report = convertModel(*document, {.frames = {Frame::mikktspace, Frame::smooth}});
//     auto written = writeGltf(*document, "out.glb");
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cotan/convert/map_jobs.hpp"
#include "cotan/convert/reencode.hpp"
#include "cotan/convert/tangents.hpp"
#include "cotan/files/limits.hpp"
#include "cotan/gltf/edit.hpp"
#include "cotan/progress.hpp"

namespace cotan {

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
// it, or drops it where nothing else does. The materials say for which frame their maps are then (named_frame.hpp).
// New maps have the format of the old ones where that is written here (encodeLike), and a note says where it is not,
// and what it costs. Maps in formats that are not read here stay as they are, and a note says so. Errors:
// ErrorKind::usage for a frame that depends on the view and other bits; ErrorKind::input for a picture that cannot be
// read or is over the limits, more than 50,000 triangles that each cover a map of 2048 rows, triangles that take more
// than options.memory, found before anything is done, compressed geometry, and materials that name another frame than
// frames.from;
// ErrorKind::output where there is no memory for a PNG; ErrorKind::stopped. On error the document is unchanged.
Result<ConvertModelReport> convertModel(GltfDocument& document, const ConvertModelOptions& options);

} // namespace cotan
