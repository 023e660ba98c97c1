#include "map_files/mips.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/try.hpp"
#include "maps/blocks/block.hpp"
#include "maps/textures/make_texture.hpp"
#include "placed_images.hpp"

namespace cotan::app {

using namespace maps;

namespace {

// Puts the roughness of texels into their alpha.
void putRoughness(Image& normals, const Image& roughness)
{
    for (std::size_t i = 0; i < normals.pixelCount(); ++i)
        if (normals.type == PixelType::float32)
            normals.floats()[4 * i + 3] = roughness.floats()[4 * i];
        else
            normals.bytes8()[4 * i + 3] = roughness.bytes8()[4 * i];
}

std::filesystem::path marked(const std::filesystem::path& file, const std::string& mark)
{
    return file.parent_path() / (file.stem().string() + mark + file.extension().string());
}

std::vector<TextureLevel> levelsOf(std::vector<LevelRows>& rows)
{
    std::vector<TextureLevel> levels;
    for (LevelRows& level : rows)
        levels.push_back(std::move(level.made));
    return levels;
}

// Writes one file, or two with blocks that have no channel for the roughness, of a map that is read strip by strip.
Status writeTextures(const OpenMap& map, const std::filesystem::path& out, const TexelCode& code,
                     const MipSettings& settings, const MipFileOptions& o, const Progress& progress, MippedFile& done)
{
    const bool inAlpha = code.holdsRoughness();
    const std::filesystem::path second = marked(out, "_roughness");
    if (!inAlpha && o.mayWrite)
        COTAN_CHECK(o.mayWrite(second));
    const TexelCode grey = o.compress.starts_with("bc")        ? TexelCode::bc4
        : code == TexelCode::rgba8 || code == TexelCode::uastc ? code.kind
                                                               : TexelCode::eacR11;
    RowReader& in = *map.rows;
    MipRows mips(in.width, in.height, settings, MipRows::roughness);
    std::vector<LevelRows> normals, roughness;
    for (std::size_t i = 0; i < mips.levels(); ++i)
        normals.emplace_back(mips.size(i)), roughness.emplace_back(mips.size(i));
    Status state = Done{};
    const auto take = [&](std::size_t i, Image rows, const Image& rough) {
        if (!state)
            return;
        if (inAlpha)
            putRoughness(rows, rough);
        state = normals[i].add(rows,
                               [&](const Image& next) { return levelOf(next, code, *o.to, inAlpha && o.keepLengths); });
        if (state && !inAlpha)
            state =
                roughness[i].add(rough, [&](const Image& next) { return Result<TextureLevel>(greyLevel(next, grey)); });
    };
    const int atOnce = rowsAtOnce(in.width);
    CountedSteps steps(progress, std::size_t((in.height - 1) / atOnce + 1));
    for (int y = 0; y < in.height; y += atOnce) {
        Image strip = makeImage(in.width, std::min(atOnce, in.height - y), in.type, in.name);
        COTAN_CHECK(in.read(strip));
        map.put(strip, y);
        mips.add(strip, take);
        COTAN_CHECK(state);
        if (!steps.step())
            return stoppedError();
    }
    addNote(map.note(), done.notes);
    for (std::size_t i = 0; i < mips.levels(); ++i) {
        const auto [width, height] = mips.size(i);
        const auto [length, rough] = mips.means(i);
        done.levels.push_back({width, height, length, rough});
    }
    COTAN_CHECK(writeFileWhole(out, textureBytes(out, code, levelsOf(normals), in.frame)));
    return inAlpha ? Status(Done{}) : writeFileWhole(second, textureBytes(second, grey, levelsOf(roughness)));
}

std::filesystem::path numbered(const std::filesystem::path& file, const char* mark, std::size_t level)
{
    return marked(file, fmt::format("{}_{}", mark, level));
}

Status writeChain(const std::filesystem::path& out, const std::vector<MipLevel>& chain, const Bits& bits,
                  const MipFileOptions& o)
{
    for (std::size_t i = 0; i < chain.size() && o.mayWrite; ++i)
        for (const char* mark : {"", "_roughness"})
            COTAN_CHECK(o.mayWrite(numbered(out, mark, i)));
    std::optional<InterruptsHeld> held;
    if (bits.half) // written by rows, one file after another
        held.emplace();
    std::vector<PlacedImage> images;
    for (std::size_t i = 0; i < chain.size(); ++i)
        for (const auto& [mark, image] :
             {std::pair("", &chain[i].normals), std::pair("_roughness", &chain[i].roughness)}) {
            const std::filesystem::path file = numbered(out, mark, i);
            if (bits.half) {
                COTAN_CHECK(writeMap(file, *image, bits));
                continue;
            }
            images.push_back({file, image});
        }
    return writeTogether(images);
}

// Blocks are made from floats.
Result<Bits> bitsOfMips(const TexelCode& code, PixelType input, const std::filesystem::path& out,
                        const MipFileOptions& o)
{
    if (code != TexelCode::rgba8)
        return Bits{PixelType::float32, false};
    return isTextureFile(out) ? Result<Bits>(Bits{}) : bitsFor(o.bits, input, *o.to, out);
}

Status checkLengths(const Result<TexelCode>& code, const MipFileOptions& o)
{
    if (!code)
        return code.error();
    if (code->twoChannels() && o.keepLengths)
        return about("options.keepLengths", usageError(fmt::format("{} has no channel for lengths", o.compress)));
    return Done{};
}

} // namespace

TextureLevel greyLevel(const Image& image, const TexelCode& code)
{
    return {image.width, image.height,
            code == TexelCode::rgba8       ? image.data
                : code == TexelCode::uastc ? encodeUastc(image, {127.5f, 127.5f}, true)
                : code == TexelCode::bc4   ? encodeBc4(image)
                                           : encodeEacR11(image)};
}

std::filesystem::path firstMipFile(const std::filesystem::path& out)
{
    return isTextureFile(out) ? out : numbered(out, "", 0);
}

Result<MippedFile> writeMips(const std::filesystem::path& file, const std::filesystem::path& out,
                             const MipFileOptions& requested, const FileOptions& files)
{
    MipFileOptions o = requested;
    if (o.to) // fails before the work
        COTAN_CHECK(checkLengths(codeFor(o.compress, o.bits, *o.to, out, o.swizzle), o));
    COTAN_TRY(opened, openMap(file, o.from, "options.from", files.limits));
    const Convention from = opened->convention, to = o.to.value_or(from);
    o.to = to;
    COTAN_TRY(code, codeFor(o.compress, o.bits, to, out, o.swizzle));
    COTAN_CHECK(checkLengths(code, o));
    COTAN_TRY(bits, bitsOfMips(*code, opened->rows->type, out, o));
    const MipSettings settings{.from = from,
                               .to = codeConvention(*code, to),
                               .keepLengths = o.keepLengths,
                               .model = o.model,
                               .roughness = o.roughness,
                               .type = bits->type};
    MippedFile done{from, to, {}};
    if (isTextureFile(out)) {
        const Status written = writeTextures(*opened, out, *code, settings, o, files.progress, done);
        return written ? Result<MippedFile>(done) : written.error();
    }
    COTAN_TRY(read, readMap(file, o.from, "options.from", files.limits));
    const Image* const map = &read->image;
    // Normals and roughness of all levels.
    const std::size_t work = map->pixelCount() * (8 + 11 * bytesPerComponent(bits->type));
    const std::size_t limit = 3 * workBudget(file, files.limits);
    if (work > limit)
        return memoryError(
            fmt::format("{}: the chain takes {} MiB for {} x {}, the limit is {} MiB for a file of this size",
                        file.string(), work >> 20, map->width, map->height, limit >> 20));
    CountedSteps steps(files.progress, 3); // read, filter, write
    if (!steps.step())
        return stoppedError();
    auto chain = mipChain(*map, settings);
    for (MipLevel& level : chain) {
        level.normals.frame = map->frame;
        swizzle(level.normals, code->swizzle);
    }
    if (!steps.step())
        return stoppedError();
    COTAN_CHECK(writeChain(out, chain, *bits, o));
    steps.step();
    addNote(read->note, done.notes);
    for (const MipLevel& level : chain)
        done.levels.push_back({level.normals.width, level.normals.height, level.meanLength, level.meanRoughness});
    return done;
}

} // namespace cotan::app
