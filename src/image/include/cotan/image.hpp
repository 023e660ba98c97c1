// Reads and writes image files as Image: PNG, JPEG and WebP by their own libraries, other formats by OpenImageIO.
//
//     auto image = cotan::readImage("map.png");
//     if (!image)
//         return fail(image.error().message);
//     image->frame = "smooth"; // PNG and EXR store for which frame a normal map was made
//     if (cotan::Status written = cotan::writeImage("map.exr", *image); !written)
//         return fail(written.error().message);
//
// openRows and createRows do the same a few rows at a time, for images that do not fit in memory.
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

// Whether these first bytes of a file are those of a PNG.
bool isPng(std::span<const std::byte> bytes);

// Format of an image by its first bytes: "PNG" or "JPEG", or "WebP", "KTX2", "DDS" or "AVIF", which extensions of glTF
// add. Empty for other data.
std::string imageFormatName(std::span<const std::byte> bytes);

// The same for image formats that cannot be read: by this library or this build or, where limits.decode is set, by any
// decoder that callers have (KTX2). Empty for all others.
std::string unreadableFormat(std::span<const std::byte> bytes, const LoadLimits& limits = {});

// Reads an image file. 8-bit files become unorm8, 16-bit ones unorm16, half and float float32. The values are those of
// the file: no colour conversion, no premultiplication. Image::frame is the value that PNG (tEXt or uncompressed iTXt
// before the pixels), EXR and KTX2 files have under the key cotanFrame.
// Errors (ErrorKind::input): not an image, damaged or truncated data, a wrong checksum, a size of zero or over the
// limits (checked before decoding). ErrorKind::unavailable: a format that cannot be read (unreadableFormat).
Result<Image> readImage(const std::filesystem::path& file, const LoadLimits& limits = {});

// The same for a file in memory, as glTF embeds PNG and JPEG. `name` is for messages.
Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits = {});

// Writes an image; the format follows the file's extension (.png .exr .tif .tga .jpg .hdr). The file appears complete
// or not at all: a temporary file in the same folder is renamed. PNG stores unorm8 and unorm16 unchanged and float32
// clamped to [0,1] at 8 bits; EXR stores floats. PNG and EXR also store a non-empty Image::frame as cotanFrame.
// Errors: ErrorKind::output if the folder cannot be written, ErrorKind::usage for an extension that cannot be written.
Status writeImage(const std::filesystem::path& file, const Image& image);

// Returns the bytes of a PNG file, compressed better and more slowly than by writeImage. image: unorm8 or unorm16, with
// all its data. Its frame is stored as by writeImage.
// Errors (ErrorKind::output): not enough memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

// ---- rows ----------------------------------------------------------------------------------

// Images a few rows at a time, for those that do not fit in memory.

// Reads the rows of an image from the top.
class RowReader {
public:
    virtual ~RowReader() = default;

    std::string name;          // for messages
    int width = 0, height = 0; // pixels
    PixelType type = PixelType::unorm8;
    bool alpha = false; // the file stores more than red, green and blue, or grey
    bool whole = false; // the image was decoded whole, since its format cannot be read by rows
    std::string frame;  // as Image::frame
    int channels = 4;   // as Image::channels

    // Fills the strip, which has the image's width and type and no more rows than remain, with the next rows. Errors:
    // as readImage. After an error only the destructor may be called.
    virtual Status read(Image& strip) = 0;
};

// Opens an image. PNG, TIFF, EXR and HDR are read row by row and may have any size: only a row, or a row of tiles, must
// stay within limits.imageBytes. Other formats and interlaced PNG are decoded whole, within limits.imageBytes. Errors:
// as readImage.
Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, const LoadLimits& limits = {});

// Describes the image to write. The alpha of the strips is dropped unless `alpha` is set.
struct RowFormat {
    int width = 0, height = 0;
    PixelType type = PixelType::unorm8;
    bool alpha = false;
    bool half = false;      // .exr: 16-bit floats
    std::string frame = {}; // as Image::frame; stored in .png and .exr only
};

// Writes the rows of an image from the top. The file appears with finish(); without it no file is left.
class RowWriter {
public:
    virtual ~RowWriter() = default;
    // Writes all rows of the strip, whose width and type are those of the RowFormat.
    virtual Status write(const Image& strip) = 0;
    virtual Status finish() = 0;
};

// Starts a file; formats and errors as writeImage. threads: the number that compression may use, if the format supports
// it; the bytes do not depend on it.
Result<std::unique_ptr<RowWriter>> createRows(const std::filesystem::path& file, const RowFormat& format,
                                              int threads = 1);

// ---- animations ----------------------------------------------------------------------------

struct AnimationFormat {
    int width = 0, height = 0;
    std::size_t images = 1;
    double rate = 24; // images per second
};

// Writes an animation. The complete file appears with finish(); without it no file does.
class AnimationWriter {
public:
    virtual ~AnimationWriter() = default;
    // Adds the next image, of the size in AnimationFormat; float32 is clamped to [0,1]. Errors: ErrorKind::output.
    virtual Status add(const Image& image) = 0;
    // Completes the file. Errors: ErrorKind::output.
    virtual Status finish() = 0;
};

// Whether the file's extension is that of an animation: .webp, .gif.
bool isAnimation(const std::filesystem::path& file);

// The frame rate that the file will have: GIF stores durations in hundredths of a second.
double animationRate(const std::filesystem::path& file, double rate);

// Starts an animation that repeats forever: WebP of quality 90 with alpha and times in milliseconds, or GIF with 256
// colours per image and no alpha.
// Errors: ErrorKind::usage for a side of over 16383 pixels (GIF: 65535), or for over 50 images per second in a GIF,
// which viewers slow down (WebP: 1000); ErrorKind::unavailable if this build lacks the library; those of
// OutputFile::begin.
Result<std::unique_ptr<AnimationWriter>> createAnimation(const std::filesystem::path& file,
                                                         const AnimationFormat& format);

// ---- the format of another file ------------------------------------------------------------

struct EncodedLike {
    std::vector<std::byte> bytes;
    std::string format;   // ImageFormat::name; "PNG" if the old format cannot be kept
    std::string mime;     // MIME type of `bytes`
    int quality = 0;      // 1 to 100, as encoders count it, of JPEG and of lossy WebP; else 0
    std::string reason{}; // why the old format was not kept, as half a sentence; empty if it was
};

// Encodes an image of unorm8 or unorm16 like the file `old`: JPEG with the quantisation tables, chroma subsampling and
// scan mode of the old file; WebP lossless, or with the quality that matches its quantiser (within a few steps, since
// encoders vary it across an image). All else becomes PNG, compressed better and more slowly than by writeImage: other
// formats, 16 bits, grey JPEGs, JPEGs if the new image has alpha, and formats whose library this build lacks. Errors
// (ErrorKind::output): not enough memory.
Result<EncodedLike> encodeLike(const Image& image, std::span<const std::byte> old);

} // namespace cotan
