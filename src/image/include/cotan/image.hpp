// Image files to Image and back: PNG, JPEG and WebP by their own libraries, the rest through OpenImageIO.
//
//     auto image = cotan::readImage("map.png");
//     if (!image)
//         return fail(image.error().message);
//     image->frame = "smooth"; // PNG and EXR keep what a normal map was made for
//     if (cotan::Status written = cotan::writeImage("map.exr", *image); !written)
//         return fail(written.error().message);
//
// openRows and createRows do the same a few rows at a time, for images that memory does not hold.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cotan/files.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// ---- whole images --------------------------------------------------------------------------

// Whether a file of these first bytes is a PNG or a JPEG, the formats that glTF asks every reader to know.
bool isPng(std::span<const std::byte> bytes);
bool isJpeg(std::span<const std::byte> bytes);

// "PNG", "JPEG", or of those that extensions of glTF name "WebP", "KTX2", "DDS" and "AVIF": by a file's first bytes.
// Empty for all else.
std::string pictureFormat(std::span<const std::byte> bytes);

// The same for what is not read here, or not by this build; empty for all else.
std::string foreignFormat(std::span<const std::byte> bytes);

// Reads an image file. 8-bit files become unorm8, 16-bit ones unorm16, half and float float32.
// The stored values are kept: no colour conversion, no premultiplication. Image::frame is what PNG (tEXt or plain iTXt
// in front of the pixels), EXR and KTX2 say under the key cotanFrame.
// Errors (ErrorKind::input): not an image, broken or short data, a wrong checksum, a size of zero
// or over the limits (checked before decoding). ErrorKind::unavailable: a format that is not read here (foreignFormat).
Result<Image> readImage(const std::filesystem::path& file, const LoadLimits& limits = {});

// The same for bytes in memory (PNG or JPEG, as glTF embeds them). `name` is for messages.
Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits = {});

// Writes an image; the format follows the file's extension (.png .exr .tif .tga .jpg .hdr).
// The file appears whole or not at all: it is written beside its place, then renamed. PNG takes
// unorm8 and unorm16 as they are and float32 clamped to [0,1] at 8 bits; EXR keeps floats. PNG and EXR also store
// Image::frame, where it is not empty, under the key cotanFrame.
// Errors: ErrorKind::output where the folder cannot be written, ErrorKind::usage for an extension that nothing writes.
Status writeImage(const std::filesystem::path& file, const Image& image);

// The bytes of a PNG file, packed tighter and more slowly than writeImage does. image: unorm8 or
// unorm16, with all its data; its frame is stored as writeImage does.
// Errors (ErrorKind::output): not enough memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

// ---- rows ----------------------------------------------------------------------------------

// Pictures a few rows at a time, for those that memory does not hold.

// The rows of a picture, from the top.
class RowReader {
public:
    virtual ~RowReader() = default;

    std::string name;          // for messages
    int width = 0, height = 0; // pixels
    PixelType type = PixelType::unorm8;
    bool alpha = false; // the file stores more than red, green and blue, or grey
    bool whole = false; // the picture is in memory already: its format has no other way
    std::string frame;  // as Image::frame
    int channels = 4;   // as Image::channels

    // Fills the strip, which has the picture's width and type, with the next rows; no more than
    // remain. Errors: as readImage. After one, only the destructor may follow.
    virtual Status read(Image& strip) = 0;
};

// Opens a picture. PNG, TIFF, EXR and HDR are read row by row, of any size (a row, or a row of tiles, within
// limits.imageBytes); the others, and interlaced PNG, are decoded whole, within limits.imageBytes. Errors: as
// readImage.
Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, const LoadLimits& limits = {});

// What is to be written. Of the four components of a strip, alpha is left out unless asked for.
struct RowFormat {
    int width = 0, height = 0;
    PixelType type = PixelType::unorm8;
    bool alpha = false;
    bool half = false;      // .exr: floats of 16 bits
    std::string frame = {}; // as Image::frame; .png and .exr store it, others do not
};

// Takes the rows of a picture, from the top. The file appears with finish(); without it nothing is left.
class RowWriter {
public:
    virtual ~RowWriter() = default;
    // The next rows: as many as the strip has, of the width and type that were said.
    virtual Status write(const Image& strip) = 0;
    virtual Status finish() = 0;
};

// Begins a file; formats and errors as writeImage. threads: that compression may use, where it can; the bytes
// do not depend on it.
Result<std::unique_ptr<RowWriter>> createRows(const std::filesystem::path& file, const RowFormat& format,
                                              int threads = 1);

// ---- animations ----------------------------------------------------------------------------

struct AnimationFormat {
    int width = 0, height = 0;
    std::size_t pictures = 1;
    double rate = 24; // pictures a second
};

// The file appears with finish(), whole; without it nothing does.
class AnimationWriter {
public:
    virtual ~AnimationWriter() = default;
    // The next picture, of that size; float32 is clamped to [0,1]. Errors: ErrorKind::output.
    virtual Status add(const Image& picture) = 0;
    // After the last one. Errors: ErrorKind::output.
    virtual Status finish() = 0;
};

// Whether a file of that name holds many pictures: .webp, .gif.
bool isAnimation(const std::filesystem::path& file);

// The rate that the file will have: GIF counts in hundredths of a second.
double animationRate(const std::filesystem::path& file, double rate);

// WebP of quality 90 with alpha, each picture shown from its time to that of the next, in milliseconds; GIF of 256
// colours a picture and no alpha. Both repeat for ever.
// Errors: ErrorKind::usage for a side of over 16383 pixels (GIF 65535), over 50 pictures a second in a GIF, which
// viewers slow down, or 1000 in WebP; ErrorKind::unavailable where this build lacks the library; those of
// OutputFile::begin.
Result<std::unique_ptr<AnimationWriter>> createAnimation(const std::filesystem::path& file,
                                                         const AnimationFormat& format);

// ---- the format of another file ------------------------------------------------------------

struct EncodedLike {
    std::vector<std::byte> bytes;
    std::string format;   // ImageFormat::name, "PNG" where the other's cannot be kept
    std::string mime;     // of it
    int quality = 0;      // 1 to 100, as encoders count it, of JPEG and of WebP with losses; else 0
    std::string whyNot{}; // why it is not the other's format, as half a sentence; empty: it is
};

// Writes a picture of unorm8 or unorm16 as `old` is written: JPEG with the quantisation tables, the sampling of colours
// and the scans of the old file; WebP without losses, or with the quality that its quantiser stands for (a few steps
// off, since encoders choose others for parts of a picture); all else as PNG, packed tighter and more slowly than
// writeImage does. So are 16 bits, grey JPEGs, JPEGs with alpha in the new picture, and what this build has no library
// for. Errors (ErrorKind::output): not enough memory.
Result<EncodedLike> encodeLike(const Image& image, std::span<const std::byte> old);

} // namespace cotan
