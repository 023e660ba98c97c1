// The formats that are read and written here by their own libraries. What a build lacks the library for says so
// (missing_codecs.cpp).
#pragma once

#include <cstddef>
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

// Direct, because here every checksum counts, nothing may be printed, and rows can be decoded straight into place.

// As decodeImage. Palettes are expanded, 1-, 2- and 4-bit samples scaled to the full range, a
// transparent colour becomes alpha. Chunks about colour spaces are ignored.
Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// Writes unorm8 or unorm16. An image whose alpha is 1 everywhere is stored without alpha, which
// reads back the same. `name` is for messages.
Status writePng(const std::filesystem::path& file, const Image& image, const std::string& name);

// As openRows, from the start of the file. Nothing: it cannot be read by rows.
std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, OpenFile stream,
                                                              const LoadLimits& limits);

// As createRows, for components of 8 or 16 bits; `file` is where to write and appears at once. name: for messages.
Result<std::unique_ptr<RowWriter>> createPngRows(const std::filesystem::path& file, const RowFormat& format,
                                                 const std::string& name);

// ---- JPEG by libjpeg ------------------------------------------------------------------------

// Direct, because it is the commonest format in models beside PNG and the module of the other formats is slow to load.

// As decodeImage, for grey and YCbCr or RGB pictures. Nothing for those in CMYK.
std::optional<Result<Image>> readJpeg(std::span<const std::byte> bytes, const std::string& name,
                                      const LoadLimits& limits);

// As encodeLike, of an opaque picture of unorm8; quality: of the quantisation tables. Nothing where the old file is
// grey or no JPEG that is read here.
std::optional<Result<std::vector<std::byte>>> writeJpegLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality);

// ---- WebP by libwebp ------------------------------------------------------------------------

// Direct: OpenImageIO's reader multiplies colours by alpha.

// Whether this build has the library.
bool readsWebp();

// As decodeImage. Animations are refused.
Result<Image> readWebp(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// As createAnimation, for WebP and pictures of unorm8; `file` is where to write and appears at once. name: for
// messages.
Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(const std::filesystem::path& file,
                                                             const AnimationFormat& format, const std::string& name);

// As encodeLike, of a picture of unorm8; quality: 0 without losses. Nothing where this build has no libwebp.
std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality);

// ---- KTX2 ----------------------------------------------------------------------------------

// Whether this is a KTX2 whose pixels are stored in a way that nothing here decodes, for messages: "BasisU (ETC1S)",
// "BasisU (UASTC)", "ASTC", "ETC2"; empty otherwise.
std::string foreignKtx2(std::span<const std::byte> bytes);

// As decodeImage: the largest level. Blocks (BC1 to BC5, BC7) are decoded by readOther, which gets them as a DDS.
Result<Image> readKtx2(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// Fills all of `out`. Errors: ErrorKind::input where the data are damaged or have another length,
// ErrorKind::unavailable where this build lacks the library.
Status unpackZstd(std::span<const std::byte> packed, std::span<std::byte> out);
Status unpackZlib(std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace cotan
