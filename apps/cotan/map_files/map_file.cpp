#include "map_files/map_file.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "image/format_table.hpp"
#include "stream.hpp"

namespace cotan::app {

using namespace maps;

namespace {

bool holds(const ImageFormat& format, PixelType type)
{
    return type == PixelType::unorm8 ? format.bits8 : type == PixelType::unorm16 ? format.bits16 : format.floats;
}

std::string noteOn(const std::string& option, const std::string& file, const std::string& contradiction)
{
    return contradiction.empty() ? contradiction : fmt::format("{}: {}: {}", option, file, contradiction);
}

} // namespace

std::string OpenMap::note() const { return noteOn(option, name, contradictionOf(greenOf(*sample), convention)); }

void addNote(std::string note, std::vector<std::string>& notes)
{
    if (!note.empty())
        notes.push_back(std::move(note));
}

std::size_t workBudget(const std::filesystem::path& file, const LoadLimits& limits)
{
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);
    return std::min(limits.imageBytes, imageBudget(limits, unknown ? 0 : size));
}

Result<Bits> bitsFor(const std::string& wanted, PixelType input, const std::filesystem::path& file)
{
    COTAN_CHECK(checkImageName(file));
    const ImageFormat& format = *imageFormatOf(file);
    PixelType type = input;
    if (wanted == "8")
        type = PixelType::unorm8;
    else if (wanted == "16")
        type = PixelType::unorm16;
    else if (wanted == "float" || wanted == "half")
        type = PixelType::float32;
    else if (wanted != "auto")
        return about("options.bits",
                     usageError(fmt::format("expected auto, 8, 16, half or float; found '{}'", wanted)));
    else if (!holds(format, type))
        type = format.bits16 ? PixelType::unorm16 : format.bits8 ? PixelType::unorm8 : PixelType::float32;
    const bool half = wanted == "half";
    if (half ? !format.halfs : !holds(format, type))
        return about(
            "options.bits",
            usageError(fmt::format("{} files cannot hold {}", format.endings[0], half ? "half" : bitsName(type))));
    return Bits{type, half};
}

std::string bitsName(PixelType type)
{
    return type == PixelType::unorm8 ? "8 bit" : type == PixelType::unorm16 ? "16 bit" : "float";
}

std::string bitsName(const Bits& bits) { return bits.half ? "half" : bitsName(bits.type); }

Status checkSigned(const Convention& to, const Bits& bits, const std::filesystem::path& file)
{
    if (to.expansion == Expansion::signedValues
        && (bits.type != PixelType::float32 || !imageFormatHas(file, &ImageFormat::negative)))
        return about("options.to",
                     usageError(fmt::format("signed values need a {} of floats; found {}, {}",
                                            imageEndings(&ImageFormat::negative, ", ", " or "),
                                            file.extension().string(), bitsName(bits))));
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

Result<LoadedMap> readMap(const std::filesystem::path& file, const StatedConvention& stated, const std::string& option,
                          const LoadLimits& limits)
{
    COTAN_TRY(image, readImage(file, limits));
    COTAN_TRY(convention, makeReadable(*image, stated, image->name, option));
    std::string note = noteOn(option, file.string(), contradictionOf(*image, *convention));
    return LoadedMap{*std::move(image), *convention, std::move(note)};
}

Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits)
{
    if (!bits.half)
        return writeImage(file, image);
    COTAN_TRY(writer, createRows(file, {image.width, image.height, image.type, true, true, image.frame}));
    COTAN_CHECK((*writer)->write(image));
    return (*writer)->finish();
}

Result<OpenMap> openMap(const std::filesystem::path& file, const StatedConvention& stated, const std::string& option,
                        const LoadLimits& limits)
{
    COTAN_TRY(reader, openRows(file, limits));
    COTAN_TRY(convention, conventionOf(stated, (*reader)->name, (*reader)->channels, option));
    OpenMap map{*std::move(reader), *convention, Swizzle::rg, stated.damage, option, file.string()};
    map.sample =
        std::make_unique<PatchSampler>(map.rows->width, map.rows->height, map.rows->type, PatchSampler::kQuickSide);
    if (convention->channels == Channels::xyz || !map.rows->alpha)
        return map;
    ChannelRange range;
    if (Status read = inOrder(*map.rows, {}, [&](const Image& strip, int) { range.add(strip); }); !read)
        return read.error();
    map.swizzle = range.swizzle();
    map.rows.reset(); // frees its memory first
    COTAN_TRY(again, openRows(file, limits));
    map.rows = *std::move(again);
    return map;
}

} // namespace cotan::app
