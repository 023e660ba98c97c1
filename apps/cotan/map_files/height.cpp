#include "map_files/height.hpp"

#include <atomic>
#include <utility>

#include <fmt/format.h>

#include "core/try.hpp"
#include "stream.hpp"

namespace cotan::app {

using namespace maps;

namespace {

double heightOf(const Metres& metres, int width, int height)
{
    return metres.height > 0 ? metres.height : metres.width * height / width;
}

// Slope per unit of stored height and texel, in x and y.
std::pair<double, double> slopesOf(const FromHeightFileOptions& o, int width, int height)
{
    if (!o.metres) {
        const double texels = o.strength / 100 * width;
        return {texels, texels};
    }
    return {o.range * width / o.metres->width, o.range * height / heightOf(*o.metres, width, height)};
}

// Heights as an image: floats in units of `unit`, integers scaled from lowest to highest.
Image heightImage(const Heights& heights, const Image& map, PixelType type, double unit)
{
    Image image = makeImage(map.width, map.height, type, map.name);
    const double range = heights.highest - heights.lowest;
    for (std::size_t i = 0; i < heights.texels.size(); ++i) {
        const double h = double(heights.texels[i]);
        const double fraction = range > 0 ? (h - heights.lowest) / range : 0.5;
        for (std::size_t c = 0; c < 4; ++c) {
            const double value = c == 3 ? 1 : type == PixelType::float32 ? h * unit : fraction;
            if (type == PixelType::unorm8)
                image.bytes8()[4 * i + c] = std::uint8_t(value * 255 + 0.5);
            else if (type == PixelType::unorm16)
                image.words()[4 * i + c] = std::uint16_t(value * 65535 + 0.5);
            else
                image.floats()[4 * i + c] = float(value);
        }
    }
    return image;
}

// auto: 16 bits, or the nearest type that the file can hold.
Result<Bits> bitsOfHeights(const std::string& wanted, PixelType input, const std::filesystem::path& out)
{
    if (wanted != "auto")
        return bitsFor(wanted, input, out);
    auto bits = bitsFor("16", input, out);
    return bits ? bits : bitsFor("auto", PixelType::unorm16, out);
}

} // namespace

Result<FromHeightFile> normalsFromHeightFile(const std::filesystem::path& heights, const std::filesystem::path& out,
                                             const FromHeightFileOptions& o, const FileOptions& files)
{
    COTAN_TRY(reader, openRows(heights, files.limits));
    RowReader& in = **reader;
    COTAN_TRY(bits, bitsFor(o.bits, in.type, o.to, out));
    // A repeating image needs its last row first.
    COTAN_TRY(lastRow, o.wrap == maps::Wrap::repeat ? lastRowOf(heights, files.limits) : Result<Image>(Image{}));
    const auto [slopeX, slopeY] = slopesOf(o, in.width, in.height);
    const FromHeightSettings settings{.kernel = o.kernel,
                                      .wrap = o.wrap,
                                      .scaleX = slopeX,
                                      .scaleY = slopeY,
                                      .to = o.to,
                                      .type = bits->type,
                                      .dither = o.dither,
                                      .bordered = true};
    std::atomic<std::size_t> invalid = 0;
    const Status streamed =
        streamToFile(in, {true, o.wrap, &*lastRow}, out, {in.width, in.height, bits->type, false, bits->half},
                     files.threads, files.progress, [&](Image& strip, int firstRow) {
                         FromHeightSettings here = settings;
                         here.firstRow = firstRow;
                         std::size_t found = 0;
                         Image rows = normalsFromHeight(strip, here, found);
                         invalid += found;
                         return rows;
                     });
    if (!streamed)
        return streamed.error();
    return FromHeightFile{in.width, in.height, in.type, slopeX, slopeY, *bits, invalid};
}

Result<ToHeightFile> heightFromNormalsFile(const std::filesystem::path& file, const std::filesystem::path& out,
                                           const ToHeightFileOptions& o, const FileOptions& files)
{
    COTAN_TRY(read, readMap(file, o.from, "options.from", files.limits));
    const Image* const map = &read->image;
    COTAN_TRY(bits, bitsOfHeights(o.bits, map->type, out));
    const std::size_t work = heightWorkBytes(map->width, map->height), most = workBudget(file, files.limits);
    if (work > most)
        return memoryError(
            fmt::format("{}: the solver takes {} MiB for {} x {}, the limit is {} MiB for a file of this size",
                        file.string(), (work >> 20) + 1, map->width, map->height, most >> 20));
    double unit = 1, aspect = 1;
    if (o.metres) {
        unit = o.metres->width / map->width;
        aspect = heightOf(*o.metres, map->width, map->height) / map->height / unit;
    }
    CountedSteps steps(files.progress, 3); // read, solve, write
    if (!steps.step())
        return stoppedError();
    Heights h = heightFromNormals(
        *map, {.from = read->convention, .boundary = o.boundary, .kernel = o.kernel, .aspect = aspect});
    if (!steps.step())
        return stoppedError();
    COTAN_CHECK(writeMap(out, heightImage(h, *map, bits->type, unit), *bits));
    steps.step();
    ToHeightFile done{map->width, map->height, *bits, std::move(h), unit, read->convention};
    addNote(read->note, done.notes);
    return done;
}

} // namespace cotan::app
