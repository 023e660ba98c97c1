// Files to Image and back, through OpenImageIO.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cotan/files/limits.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

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
// Errors: ErrorKind::output where the folder cannot be written, ErrorKind::usage for an extension
// that nothing writes.
Status writeImage(const std::filesystem::path& file, const Image& image);

// The bytes of a PNG file, packed tighter and more slowly than writeImage does. image: unorm8 or
// unorm16, with all its data; its frame is stored as writeImage does.
// Errors (ErrorKind::output): not enough memory.
Result<std::vector<std::byte>> encodePng(const Image& image);

} // namespace cotan
