#include "map_files/mips.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/try.hpp"
#include "maps/textures/texel_code.hpp"
#include "placed_images.hpp"

namespace cotan::app {

using namespace maps;

namespace {

// The normals of a level with its roughness in alpha.
Result<TextureLevel> levelWithRoughness(const MipLevel& level, const TexelCode& code, const MipFileOptions& o)
{
    Image both = level.normals;
    for (std::size_t i = 0; i < both.pixelCount(); ++i)
        if (both.type == PixelType::float32)
            both.floats()[4 * i + 3] = level.roughness.floats()[4 * i];
        else
            both.bytes8()[4 * i + 3] = level.roughness.bytes8()[4 * i];
    return levelOf(both, code, *o.to, o.keepLengths);
}

std::filesystem::path marked(const std::filesystem::path& file, const std::string& mark)
{
    return file.parent_path() / (file.stem().string() + mark + file.extension().string());
}

// Writes one file, or two with blocks that have no channel for the roughness.
Status writeTextures(const std::filesystem::path& out, const std::vector<MipLevel>& chain, const TexelCode& code,
                     const MipFileOptions& o)
{
    std::vector<TextureLevel> normals, roughness;
    if (code.holdsRoughness()) {
        for (const MipLevel& level : chain) {
            COTAN_TRY(both, levelWithRoughness(level, code, o));
            normals.push_back(*std::move(both));
        }
        return writeFileWhole(out, textureBytes(out, code, normals, chain[0].normals.frame));
    }
    const std::filesystem::path second = marked(out, "_roughness");
    if (o.mayWrite)
        COTAN_CHECK(o.mayWrite(second));
    const TexelCode grey = o.compress.starts_with("bc")        ? TexelCode::bc4
        : code == TexelCode::rgba8 || code == TexelCode::uastc ? code.kind
                                                               : TexelCode::eacR11;
    for (const MipLevel& level : chain) {
        COTAN_TRY(made, levelOf(level.normals, code, *o.to));
        normals.push_back(*std::move(made));
        roughness.push_back(greyLevel(level.roughness, grey));
    }
    COTAN_CHECK(writeFileWhole(out, textureBytes(out, code, normals, chain[0].normals.frame)));
    return writeFileWhole(second, textureBytes(second, grey, roughness));
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
    COTAN_TRY(read, readMap(file, o.from, "options.from", files.limits));
    const Image* const map = &read->image;
    const Convention from = read->convention, to = o.to.value_or(from);
    o.to = to;
    COTAN_TRY(code, codeFor(o.compress, o.bits, to, out, o.swizzle));
    COTAN_CHECK(checkLengths(code, o));
    COTAN_TRY(bits, bitsOfMips(*code, map->type, out, o));
    // 32 bytes of moments for a quarter of the texels, and normals and roughness of all levels.
    const std::size_t work = map->pixelCount() * (8 + 11 * bytesPerComponent(bits->type));
    const std::size_t limit = 3 * workBudget(file, files.limits);
    if (work > limit)
        return memoryError(
            fmt::format("{}: the chain takes {} MiB for {} x {}, the limit is {} MiB for a file of this size",
                        file.string(), work >> 20, map->width, map->height, limit >> 20));
    CountedSteps steps(files.progress, 3); // read, filter, write
    if (!steps.step())
        return stoppedError();
    auto chain = mipChain(*map,
                          {.from = from,
                           .to = codeConvention(*code, to),
                           .keepLengths = o.keepLengths,
                           .model = o.model,
                           .roughness = o.roughness,
                           .type = bits->type});
    for (MipLevel& level : chain) {
        level.normals.frame = map->frame;
        if (!isTextureFile(out))
            swizzle(level.normals, code->swizzle);
    }
    if (!steps.step())
        return stoppedError();
    if (Status written = isTextureFile(out) ? writeTextures(out, chain, *code, o) : writeChain(out, chain, *bits, o);
        !written)
        return written.error();
    steps.step();
    MippedFile done{from, to, {}};
    addNote(read->note, done.notes);
    for (const MipLevel& level : chain)
        done.levels.push_back({level.normals.width, level.normals.height, level.meanLength, level.meanRoughness});
    return done;
}

} // namespace cotan::app
