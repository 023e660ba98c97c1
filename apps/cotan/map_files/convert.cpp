#include "map_files/convert.hpp"

#include <atomic>

#include <fmt/format.h>

#include "by_mesh.hpp"
#include "core/try.hpp"
#include "files/output.hpp"
#include "image/format_table.hpp"
#include "maps/textures/make_texture.hpp"
#include "stream.hpp"

namespace cotan::app {

using namespace maps;

namespace {

Status checkOptions(const ConvertFileOptions& o)
{
    const bool changesSpace = o.from.convention.kind != o.to.kind;
    if (changesSpace != o.mesh.has_value())
        return about("options.mesh",
                     usageError(changesSpace ? "expected a mesh between tangent and object space; found none"
                                             : "expected no mesh within one space; found one"));
    if (changesSpace && o.strength != 1)
        return about(
            "options.strength",
            usageError("expected 1 between tangent and object space; other factors need both in tangent space"));
    if (o.strength == 0)
        return about("options.strength", usageError("expected a factor other than 0; found 0"));
    return Done{};
}

// Converts a whole image by a mesh.
Result<Image> convertByMesh(const std::filesystem::path& file, const MeshOfMap& mesh, const RecodeSettings& settings,
                            const FileOptions& files, ConvertedFile& done)
{
    COTAN_TRY(map, readMap(file, settings.from, "options.from", files.limits));
    addNote(map->note, done.notes);
    auto converted = recodeByMesh(map->image, settings, mesh, files.progress, done.counts, done.covered);
    if (converted && done.covered == 0)
        return inputError(
            fmt::format("{}: the mesh uses no texel of the map (uv outside 0 to 1?)", mesh.file.string()));
    return converted;
}

Result<Image> convertWhole(const std::filesystem::path& file, const RecodeSettings& settings, const FileOptions& files,
                           ConvertedFile& done)
{
    COTAN_TRY(map, readMap(file, settings.from, "options.from", files.limits));
    addNote(map->note, done.notes);
    CountedSteps steps(files.progress, 2);
    if (!steps.step())
        return stoppedError();
    Image converted = recode(map->image, settings, done.counts);
    if (!steps.step())
        return stoppedError();
    return converted;
}

Status write(const std::filesystem::path& out, const MadeTexture& made, ConvertedFile& done)
{
    done.cost = made.cost;
    return writeFileWhole(out, {reinterpret_cast<const char*>(made.bytes.data()), made.bytes.size()});
}

// Writes a texture of a whole map, in `stored`.
Status writeTexture(const std::filesystem::path& out, const Image& map, const Convention& stored, const TexelCode& code,
                    const ConvertFileOptions& o, ConvertedFile& done)
{
    COTAN_TRY(
        made,
        wholeTexture(map, code, code != TexelCode::rgba8, {.from = stored, .to = o.to, .file = out, .mips = o.mips}));
    return write(out, *made, done);
}

// Writes the texture that fits the budget. map: as chooseFormat takes it.
Status writeChosen(const std::filesystem::path& out, const Image& map, const Convention& stored,
                   const ConvertFileOptions& o, const FileOptions& files, ConvertedFile& done)
{
    COTAN_TRY(chosen, chooseFormat(map, o.to, o.swizzle, o.dither, out, *o.budget, files));
    done.compress = chosen->compress;
    done.tried = chosen->tried;
    done.to = storedConvention(chosen->code, o.to);
    if (chosen->code != TexelCode::rgba8)
        return writeTexture(out, map, stored, chosen->code, o, done);
    RecodeCounts counts;
    Image pixels = recode(map, {.from = stored, .to = o.to, .dither = o.dither}, counts);
    pixels.frame = map.frame;
    return writeTexture(out, pixels, o.to, chosen->code, o, done);
}

// Converts an image strip by strip to a texture.
Status convertToTexture(const OpenMap& map, const std::filesystem::path& out, const RecodeSettings& settings,
                        const TexelCode& code, const ConvertFileOptions& o, const FileOptions& files,
                        ConvertedFile& done)
{
    RowReader& in = *map.rows;
    TextureRows texture(in.width, in.height, code, settings.to,
                        {.from = settings.to, .to = o.to, .file = out, .mips = o.mips});
    const int atOnce = texture.rowsAtOnce();
    CountedSteps steps(files.progress, std::size_t((in.height - 1) / atOnce + 1));
    for (RecodeSettings here = settings; here.firstRow < in.height; here.firstRow += atOnce) {
        Image strip = makeImage(in.width, std::min(atOnce, in.height - here.firstRow), in.type, in.name);
        COTAN_CHECK(in.read(strip));
        map.put(strip, here.firstRow);
        RecodeCounts found;
        const Image rows = recode(strip, here, found);
        COTAN_CHECK(texture.add(rows, code == TexelCode::rgba8 ? nullptr : &rows));
        done.counts.invalid += found.invalid;
        done.counts.clamped += found.clamped;
        if (!steps.step())
            return stoppedError();
    }
    addNote(map.note(), done.notes);
    return write(out, texture.finish(done.frame), done);
}

// Image::frame of the result: in tangent space that of the mesh, else that of the map; in object space none.
std::string frameAfter(const std::string& stored, const ConvertFileOptions& o)
{
    if (o.to.kind != MapKind::tangentSpace)
        return {};
    return o.mesh ? std::string(name(o.mesh->frame)) : stored;
}

// Converts an image strip by strip.
Status convertByRows(const OpenMap& map, const std::filesystem::path& out, const RecodeSettings& settings,
                     Swizzle placed, const FileOptions& files, ConvertedFile& done)
{
    RowReader& in = *map.rows;
    const bool alpha = placed != Swizzle::rg
        || (in.alpha && settings.from.channels == Channels::xyz && settings.to.channels == Channels::xyz);
    std::atomic<std::size_t> invalid = 0, clamped = 0;
    const Status streamed =
        streamToFile(in, {}, out, {in.width, in.height, done.bits.type, alpha, done.bits.half, done.frame},
                     files.threads, files.progress, [&](Image& strip, int firstRow) {
                         map.put(strip, firstRow);
                         RecodeSettings here = settings;
                         here.firstRow = firstRow;
                         RecodeCounts found;
                         Image rows = recode(strip, here, found);
                         swizzle(rows, placed);
                         invalid += found.invalid;
                         clamped += found.clamped;
                         return rows;
                     });
    done.counts = {invalid, clamped};
    addNote(map.note(), done.notes);
    return streamed;
}

} // namespace

Result<ConvertedFile> convertFile(const std::filesystem::path& map, const std::filesystem::path& out,
                                  const ConvertFileOptions& o, const FileOptions& files)
{
    COTAN_CHECK(checkOptions(o));
    COTAN_TRY(opened, openMap(map, o.from, "options.from", files.limits));
    RowReader& in = *opened->rows;
    COTAN_TRY(code, codeFor(o.compress, o.bits, o.to, out, o.swizzle));
    if (o.budget && (o.compress != "none" || !isTextureFile(out)))
        return about("options.maxDegrees",
                     o.compress != "none" ? usageError(fmt::format("chooses the format; found {} as well", o.compress))
                                          : usageError(fmt::format("expected a {} file; found '{}'",
                                                                   imageEndings(&ImageFormat::texture, ", ", " or "),
                                                                   out.extension().string())));
    if (o.mips && !isTextureFile(out))
        return about(
            "options.mips",
            usageError(fmt::format("expected a {} file; found '{}' (map mips writes a file for "
                                   "each level)",
                                   imageEndings(&ImageFormat::texture, ", ", " or "), out.extension().string())));
    COTAN_TRY(bits, isTextureFile(out) ? Result<Bits>(Bits{}) : bitsFor(o.bits, in.type, o.to, out));
    Convention to = codeConvention(*code, o.to);
    if (o.budget)
        to.expansion = Expansion::biased; // as all blocks need it
    const RecodeSettings settings{.from = opened->convention,
                                  .to = to,
                                  .type = *code == TexelCode::rgba8 && !o.budget ? bits->type : PixelType::float32,
                                  .strength = o.strength,
                                  .normalise = o.normalise,
                                  .dither = o.dither};
    ConvertedFile done{
        in.width,  in.height, *bits, {}, 0, frameAfter(in.frame, o), opened->convention, storedConvention(*code, o.to),
        o.compress};
    if (!o.mesh && !o.budget) {
        const Status streamed = isTextureFile(out) ? convertToTexture(*opened, out, settings, *code, o, files, done)
                                                   : convertByRows(*opened, out, settings, code->swizzle, files, done);
        return streamed ? Result<ConvertedFile>(done) : streamed.error();
    }
    COTAN_TRY(converted,
              o.mesh ? convertByMesh(map, *o.mesh, settings, files, done) : convertWhole(map, settings, files, done));
    converted->frame = done.frame;
    if (o.budget) {
        const Status written = writeChosen(out, *converted, to, o, files, done);
        return written ? Result<ConvertedFile>(done) : written.error();
    }
    if (isTextureFile(out)) {
        const Status written = writeTexture(out, *converted, to, *code, o, done);
        return written ? Result<ConvertedFile>(done) : written.error();
    }
    swizzle(*converted, code->swizzle);
    const Status written = writeMap(out, *converted, done.bits);
    return written ? Result<ConvertedFile>(done) : written.error();
}

} // namespace cotan::app
