#include "cotan/map_files/map_file.hpp"

#include <fmt/format.h>

#include "cotan/files/extension.hpp"
#include "cotan/image/file.hpp"
#include "stream.hpp"

namespace cotan::maps {

Result<Bits> bitsFor(const std::string& wanted, PixelType input, const std::filesystem::path& file)
{
    const std::string extension = lowerExtension(file);
    const bool floats = extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff";
    const bool only8 = extension == ".jpg" || extension == ".jpeg" || extension == ".tga";
    const bool onlyFloat = extension == ".exr" || extension == ".hdr";
    PixelType type = input;
    if (wanted == "8")
        type = PixelType::unorm8;
    else if (wanted == "16")
        type = PixelType::unorm16;
    else if (wanted == "float" || wanted == "half")
        type = PixelType::float32;
    else if (wanted != "auto")
        return usageError(fmt::format("options.bits: expected auto, 8, 16, half or float; found '{}'", wanted));
    else if (onlyFloat)
        type = PixelType::float32;
    else if (only8)
        type = PixelType::unorm8;
    else if (type == PixelType::float32 && !floats)
        type = PixelType::unorm16;
    const bool half = wanted == "half";
    if ((type == PixelType::float32 && !floats) || (type != PixelType::float32 && onlyFloat)
        || (type != PixelType::unorm8 && only8) || (half && extension != ".exr"))
        return usageError(
            fmt::format("options.bits: {} files cannot hold {}", extension, half ? "half" : bitsName(type)));
    return Bits{type, half};
}

std::string bitsName(PixelType type)
{
    return type == PixelType::unorm8 ? "8 bit" : type == PixelType::unorm16 ? "16 bit" : "float";
}

std::string bitsName(const Bits& bits) { return bits.half ? "half" : bitsName(bits.type); }

Status checkSigned(const Convention& to, const Bits& bits, const std::filesystem::path& file)
{
    const std::string extension = lowerExtension(file);
    if (to.expansion == Expansion::signedValues && (bits.type != PixelType::float32 || extension == ".hdr"))
        return usageError(fmt::format("options.to: signed values need a .exr or .tif of floats; found {}, {}",
                                      extension, bitsName(bits)));
    return Done{};
}

Result<Bits> bitsFor(const std::string& wanted, PixelType input, const Convention& to,
                     const std::filesystem::path& file)
{
    const auto bits = bitsFor(wanted, input, file);
    if (!bits)
        return bits;
    const Status fits = checkSigned(to, *bits, file);
    return fits ? bits : fits.error();
}

Result<Image> readMap(const std::filesystem::path& file, const Convention& convention, const LoadLimits& limits)
{
    auto image = readImage(file, limits);
    if (image && convention.channels != Channels::xyz)
        unswizzle(*image, swizzleOf(*image));
    return image;
}

Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits)
{
    if (!bits.half)
        return writeImage(file, image);
    auto writer = createRows(file, {image.width, image.height, image.type, true, true, image.frame});
    if (!writer)
        return writer.error();
    if (Status written = (*writer)->write(image); !written)
        return written;
    return (*writer)->finish();
}

Result<Swizzle> swizzleOfFile(const std::filesystem::path& file, const Convention& convention, const LoadLimits& limits)
{
    if (convention.channels == Channels::xyz)
        return Swizzle::rg;
    const auto reader = openRows(file, limits);
    if (!reader)
        return reader.error();
    if (!(*reader)->alpha)
        return Swizzle::rg;
    ChannelRange range;
    if (Status read = inOrder(**reader, {}, [&](const Image& strip, int) { range.add(strip); }); !read)
        return read.error();
    return range.swizzle();
}

} // namespace cotan::maps
