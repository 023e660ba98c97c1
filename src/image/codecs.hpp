// The formats that are read and written by their own libraries. Formats whose library a build lacks return an error
// (missing_codecs.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "files/bytes.hpp"

namespace cotan {

// ---- PNG by libpng --------------------------------------------------------------------------

// libpng is used directly: every checksum is checked, nothing is printed, and rows are decoded straight into the image.

// As decodeImage. Palettes are expanded, 1-, 2- and 4-bit samples scaled to the full range, and a transparent colour
// becomes alpha. Chunks that describe colour spaces are ignored.
Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// Writes unorm8 or unorm16. An image whose alpha is 1 everywhere is stored without alpha, which is read back as 1.
// `name` is for messages.
Status writePng(OpenFile file, const Image& image, const std::string& name);

// As openRows; `stream` is rewound first. Returns nullopt for interlaced files, which cannot be read by rows.
std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, OpenFile stream,
                                                              const LoadLimits& limits);

// As createRows, for components of 8 or 16 bits. name: for messages.
Result<std::unique_ptr<RowWriter>> createPngRows(OpenFile file, const RowFormat& format, const std::string& name);

// ---- JPEG by libjpeg ------------------------------------------------------------------------

// libjpeg is used directly: JPEG is as common as PNG in models, and the module for other formats is slow to load.

// As decodeImage; CMYK becomes RGB, without a colour profile. Returns nullopt if this build has no libjpeg.
std::optional<Result<Image>> readJpeg(std::span<const std::byte> bytes, const std::string& name,
                                      const LoadLimits& limits);

// Blocks of a JPEG file: what it stores in some of its units, which are 8, 16 or more texels wide and high.
struct JpegBlocks {
    struct Component {
        int across = 1, down = 1;                 // blocks in a unit
        std::array<std::uint16_t, 64> steps{};    // quantisation, by frequency: 8 v + u
        std::vector<std::int16_t> coefficients{}; // in steps: 64 of each block, row by row, unit after unit
    };
    int unitWidth = 0, unitHeight = 0;       // texels
    std::vector<std::array<int, 2>> units{}; // the first texel of each, column and row
    bool rgb = false;                        // the components are red, green and blue; else Y, Cb and Cr
    std::array<Component, 3> components{};
};

// Reads about maxUnits units, spread over the image; those that its right and lower edge cut are left out. Returns
// nullopt for grey and CMYK files, for what readJpeg refuses, and in a build that has no libjpeg.
std::optional<JpegBlocks> readJpegBlocks(std::span<const std::byte> bytes, const LoadLimits& limits,
                                         std::size_t maxUnits);

// As encodeLike, of an opaque image of unorm8. quality: receives that of the quantisation tables. Returns nullopt if
// the old file is grey, CMYK or a JPEG that cannot be read.
std::optional<Result<std::vector<std::byte>>> writeJpegLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality);

// The JPEG file of an image of unorm8, without its alpha. quality: percent. Returns an empty text if this build has no
// libjpeg, or if there is not enough memory.
std::string writeJpeg(const Image& image, int quality);

// ---- WebP by libwebp ------------------------------------------------------------------------

// libwebp is used directly: OpenImageIO's reader multiplies colours by alpha.

// Whether this build has libwebp.
bool readsWebp();

// As decodeImage. Errors: also ErrorKind::input for animations.
Result<Image> readWebp(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// As createAnimation, for WebP and images of unorm8. name: for messages.
Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(OpenFile file, const AnimationFormat& format,
                                                             const std::string& name);

// As encodeLike, of an image of unorm8. quality: receives 0 if lossless. Returns nullopt if this build has no libwebp.
std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality);

// ---- KTX2 ----------------------------------------------------------------------------------

// Names the pixel encoding of a KTX2 file that cannot be decoded, for messages: "ASTC", "EAC with signed values". Empty
// for all other files.
std::string foreignKtx2(std::span<const std::byte> bytes);

// Names what this build lacks the library for: "Zstandard", "zlib", "BC6H". Empty for all other files.
std::string lackedByKtx2(std::span<const std::byte> bytes);

// The word of --compress for the blocks of a DDS or KTX2 file, of which only the header is read. Empty: another file,
// pixels, or blocks that no word names, such as BC1 and ETC.
std::string blockName(std::span<const std::byte> file);

// As decodeImage: the largest level. BC6H is passed to readOther as a DDS file.
Result<Image> readKtx2(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// Decompresses `packed` to exactly out.size() bytes. Errors: ErrorKind::input for damaged data or another size,
// ErrorKind::unavailable if this build lacks the library.
bool unpacksZstd(); // whether this build has the library
bool unpacksZlib();
Status unpackZstd(std::span<const std::byte> packed, std::span<std::byte> out);

// Packs with Zstandard. Empty in a build without it.
std::vector<std::byte> packZstd(std::span<const std::byte> data);
Status unpackZlib(std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace cotan
