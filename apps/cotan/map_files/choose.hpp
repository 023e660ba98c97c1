// Chooses the block format of a texture by what it costs in degrees.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cotan/frame_choice.hpp"
#include "files/json.hpp"
#include "map_file.hpp"
#include "maps/textures/make_texture.hpp"

namespace cotan::app {

enum class Device { desktop, mobile, web };

struct FormatBudget {
    ChoiceLimits limits{};          // of the angles between the map and what is stored
    Device device = Device::mobile; // desktop: BC5, BC7; mobile: ASTC of all sizes, EAC; web: UASTC; all: pixels
};

// A format that was tried, with the angles that it costs, in degrees.
struct TriedFormat {
    std::string compress; // the word of --compress
    double bitsPerTexel = 0, meanDegrees = 0, percentile99 = 0;
};

// {"compress", "bits_per_texel", "mean_degrees", "percentile99_degrees"}
Json toJson(const TriedFormat& format);

struct ChosenFormat {
    std::string compress; // the word of --compress
    maps::TexelCode code;
    maps::MadeTexture made;
    std::vector<TriedFormat> tried; // the smallest first
};

// Makes the texture in a format, candidate `number` of at most `count`, and measures it.
using MakeTexture =
    std::function<Result<maps::MadeTexture>(const maps::TexelCode& code, std::size_t number, std::size_t count)>;

// The smallest format within the budget; of equally small ones that with the least mean angle. Larger formats than the
// chosen one are not made.
// to: with three channels the formats hold three, with two, two. swizzle: a word of swizzleWords; formats that cannot
// have it are left out. file: the texture's name, for its container.
// Errors: ErrorKind::usage as codeFor; ErrorKind::limit if none is within; ErrorKind::unavailable if a format cannot be
// decoded; as `make`.
Result<ChosenFormat> chooseFormat(const Convention& to, const std::string& swizzle, const std::filesystem::path& file,
                                  const FormatBudget& budget, const MakeTexture& make);

// What the formats of models and engines would cost a normal map of three channels, read in `convention`: uastc, bc7,
// astc-6x6 and astc-8x8, and of two channels bc5 and eac-rg11. Large maps are sampled: 64 squares of 24 texels a side.
// Formats that this build cannot write are left out.
std::vector<TriedFormat> costsOf(const Image& map, const Convention& convention);

// What the file of a map has cost it already.
struct CostBefore {
    std::string format; // Image::blocks, or "jpeg"
    double meanDegrees = 0;
};

// Estimates that. A JPEG file, if it is in Image::jpeg: see jpegCost. Blocks: what they cost what they hold, on a grid
// that is half a block away, where none of the lines and planes fits that the blocks were fitted to. map: as decoded
// from the file, read in `convention`; Image::blocks names the format. Large maps are sampled as by costsOf.
// Nothing for pixels, a map smaller than 32 x 32, formats that this build cannot write but bc1, etc2 and etc1s, and
// BC3 with x in alpha, whose few codes of green hide what was rounded to them.
std::optional<CostBefore> costBefore(const Image& map, const Convention& convention);

} // namespace cotan::app
