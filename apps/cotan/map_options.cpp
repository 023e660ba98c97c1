#include "map_options.hpp"

#include <fmt/format.h>

#include "cotan/files/extension.hpp"
#include "cotan/image/file.hpp"
#include "cotan/maps/texels.hpp"
#include "map_stream.hpp"

namespace cotan::app {

void addMapOptions(CLI::App& command, MapOptions& options, const std::string& outputHelp)
{
    addCommonOptions(command, options.common, outputHelp);
    addMemoryOption(command, options.memory);
}

Result<Convention> parseConvention(const std::string& text, const std::string& option)
{
    auto convention = conventionFromWords(text);
    return convention ? convention : usageError(option + ": " + convention.error().message);
}

Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options)
{
    return readImageWithin(options.memory, file);
}

Result<std::unique_ptr<RowReader>> openMapRows(const std::filesystem::path& file, const MapOptions& options)
{
    auto reader = openRows(file, limitsFor(options.memory));
    return reader ? std::move(reader) : Result<std::unique_ptr<RowReader>>(withMemoryHint(reader.error()));
}

Result<maps::Swizzle> swizzleOfFile(const std::filesystem::path& file, const MapOptions& options,
                                    const Convention& convention)
{
    if (convention.channels == Channels::xyz)
        return maps::Swizzle::rg;
    const auto reader = openMapRows(file, options);
    if (!reader)
        return reader.error();
    if (!(*reader)->alpha)
        return maps::Swizzle::rg;
    maps::ChannelRange range;
    CommonOptions silent = options.common;
    silent.quiet = true;
    if (Status read = inOrder(silent, **reader, Border::none, [&](const Image& strip, int) { range.add(strip); }); !read)
        return read.error();
    return range.swizzle();
}

Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options,
                      const Convention& convention)
{
    auto image = openMap(file, options);
    if (image && convention.channels != Channels::xyz)
        maps::unswizzle(*image, maps::swizzleOf(*image));
    return image;
}

std::string bitsName(PixelType type)
{
    return type == PixelType::unorm8 ? "8 bit" : type == PixelType::unorm16 ? "16 bit" : "float";
}

std::string bitsName(const Bits& bits) { return bits.half ? "half" : bitsName(bits.type); }

Result<Bits> parseBits(const std::string& bits, PixelType input, const std::filesystem::path& file)
{
    const std::string extension = lowerExtension(file);
    const bool floats = extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff";
    const bool only8 = extension == ".jpg" || extension == ".jpeg" || extension == ".tga";
    const bool onlyFloat = extension == ".exr" || extension == ".hdr";
    PixelType type = input;
    if (bits == "8")
        type = PixelType::unorm8;
    else if (bits == "16")
        type = PixelType::unorm16;
    else if (bits == "float" || bits == "half")
        type = PixelType::float32;
    else if (bits != "auto")
        return usageError(fmt::format("--bits: expected auto, 8, 16, half or float; found '{}'", bits));
    else if (onlyFloat)
        type = PixelType::float32;
    else if (only8)
        type = PixelType::unorm8;
    else if (type == PixelType::float32 && !floats)
        type = PixelType::unorm16;
    const bool half = bits == "half";
    if ((type == PixelType::float32 && !floats) || (type != PixelType::float32 && onlyFloat)
        || (type != PixelType::unorm8 && only8) || (half && extension != ".exr"))
        return usageError(fmt::format("--bits: {} files cannot hold {}", extension, half ? "half" : bitsName(type)));
    return Bits{type, half};
}

Status checkSigned(const Convention& to, const Bits& bits, const std::filesystem::path& file)
{
    const std::string extension = lowerExtension(file);
    if (to.expansion == Expansion::signedValues && (bits.type != PixelType::float32 || extension == ".hdr"))
        return usageError(fmt::format("--to: signed values need a .exr or .tif of floats; found {}, {}", extension,
                                      bitsName(bits)));
    return Done{};
}

Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits)
{
    if (!bits.half)
        return writeImage(file, image);
    auto writer = createRows(file, {image.width, image.height, image.type, true, true});
    if (!writer)
        return writer.error();
    if (Status written = (*writer)->write(image); !written)
        return written;
    return (*writer)->finish();
}

Status needOutput(const MapOptions& options, const std::string& command, const std::filesystem::path& file)
{
    if (options.common.output.empty())
        return usageError(fmt::format("map {}: expected -o FILE; found none", command));
    return planOutputs(options.common, {{"-o", file.empty() ? options.common.output : file}});
}

} // namespace cotan::app
