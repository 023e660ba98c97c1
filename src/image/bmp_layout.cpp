// Whether the compression of a BMP file goes with its bits and its number of pixels.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "file_layout.hpp"

namespace cotan::oiio {

// Microsoft's BITMAPINFOHEADER. Runs are of 8 bits a pixel, or of 4: of others OpenImageIO reads in front of its rows.
Problem checkBmp(File& file, const LoadLimits& limits)
{
    Numbers numbers = numbersOf(file);
    // Of others OpenImageIO takes width and height from what its memory held.
    constexpr std::array<std::uint64_t, 6> kHeaders = {12, 40, 52, 56, 108, 124};
    const std::uint64_t header = numbers.at(14, 4);
    if (std::ranges::find(kHeaders, header) == kHeaders.end())
        return fmt::format("headers of {} bytes are not read here", header);
    if (14 + header > numbers.size())
        return "its header goes on behind the end of the file";
    if (header == kHeaders[0]) // OS/2's, without a compression
        return std::nullopt;
    const std::uint64_t bits = numbers.at(28, 2), compression = numbers.at(30, 4);
    const std::uint64_t width = numbers.at(18, 4), below = numbers.at(22, 4);
    const std::uint64_t height = below < 0x80000000 ? below : 0x100000000 - below; // negative: rows from above
    const std::uint64_t ofRuns = compression == 1 ? 8 : compression == 2 ? 4 : 0;
    if (ofRuns != 0 && bits != ofRuns)
        return fmt::format("it has {} bits a pixel, its compression {} has {}", bits, compression, ofRuns);
    // OpenImageIO takes memory for all of them before anybody sees their number.
    if (ofRuns != 0 && height != 0 && width > limits.imageBytes / height)
        return tooMuchMemory(
            fmt::format("{} x {} pixels of a byte, the limit is {} bytes", width, height, limits.imageBytes));
    return std::nullopt;
}

} // namespace cotan::oiio
