#include "map_files/convert.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

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

// The rows of a map, from the top: as converted, and as a texture has them.
using NextRows = std::function<Result<Image>(int first, int count)>;

// Makes a texture of rows that are stored in `from`, blocks or pixels of them. Measures it, but for pixels only with a
// budget.
Result<MadeTexture> textureOf(int width, int height, const NextRows& next, const Convention& from,
                              const TexelCode& code, const std::filesystem::path& out, const ConvertFileOptions& o,
                              const std::string& frame)
{
    const bool pixels = code == TexelCode::rgba8;
    TextureRows texture(width, height, code, pixels ? o.to : from,
                        {.from = from, .to = o.to, .file = out, .mips = o.mips});
    const int atOnce = rowsAtOnce(width);
    for (int y = 0; y < height; y += atOnce) {
        COTAN_TRY(rows, next(y, std::min(atOnce, height - y)));
        if (!o.budget || !pixels) {
            COTAN_CHECK(texture.add(*rows, pixels ? nullptr : &*rows));
            continue;
        }
        RecodeCounts counts;
        const RecodeSettings settings{.from = from, .to = o.to, .dither = o.dither, .firstRow = y};
        COTAN_CHECK(texture.add(recode(*rows, settings, counts), &*rows));
    }
    return texture.finish(frame);
}

// Converts a map strip by strip to a texture.
Result<MadeTexture> convertToTexture(const OpenMap& map, const std::filesystem::path& out,
                                     const RecodeSettings& settings, const TexelCode& code, const ConvertFileOptions& o,
                                     const Progress& progress, ConvertedFile& done)
{
    RowReader& in = *map.rows;
    done.counts = {};
    CountedSteps steps(progress, std::size_t((in.height - 1) / rowsAtOnce(in.width) + 1));
    const auto next = [&](int first, int rows) -> Result<Image> {
        if (first > 0 && !steps.step())
            return stoppedError();
        Image strip = makeImage(in.width, rows, in.type, in.name);
        COTAN_CHECK(in.read(strip));
        map.put(strip, first);
        RecodeSettings here = settings;
        here.firstRow = first;
        RecodeCounts found;
        Image converted = recode(strip, here, found);
        done.counts.invalid += found.invalid;
        done.counts.clamped += found.clamped;
        return converted;
    };
    COTAN_TRY(made, textureOf(in.width, in.height, next, settings.to, code, out, o, done.frame));
    if (!steps.step())
        return stoppedError();
    done.notes.clear();
    addNote(map.note(), done.notes);
    return made;
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
    if (!o.mesh && !isTextureFile(out)) {
        const Status streamed = convertByRows(*opened, out, settings, code->swizzle, files, done);
        return streamed ? Result<ConvertedFile>(done) : streamed.error();
    }
    Image whole; // with a mesh
    if (o.mesh) {
        COTAN_TRY(converted, convertByMesh(map, *o.mesh, settings, files, done));
        whole = *std::move(converted);
        whole.frame = done.frame;
    }
    if (!isTextureFile(out)) {
        swizzle(whole, code->swizzle);
        const Status written = writeMap(out, whole, done.bits);
        return written ? Result<ConvertedFile>(done) : written.error();
    }
    const MakeTexture make = [&](const TexelCode& as, std::size_t number, std::size_t count) -> Result<MadeTexture> {
        if (o.mesh)
            return textureOf(
                in.width, in.height, [&](int first, int rows) { return rowsOf(whole, first, rows); }, to, as, out, o,
                done.frame);
        const Progress progress = partOf(files.progress, number, count);
        if (number == 0)
            return convertToTexture(*opened, out, settings, as, o, progress, done);
        COTAN_TRY(again, openMap(map, o.from, "options.from", files.limits));
        return convertToTexture(*again, out, settings, as, o, progress, done);
    };
    ChosenFormat chosen{o.compress, *code, {}, {}};
    if (o.budget) {
        COTAN_TRY(within, chooseFormat(o.to, o.swizzle, out, *o.budget, make));
        chosen = *std::move(within);
    } else {
        COTAN_TRY(made, make(*code, 0, 1));
        chosen.made = *std::move(made);
    }
    done.compress = chosen.compress;
    done.tried = chosen.tried;
    done.to = storedConvention(chosen.code, o.to);
    if (chosen.code != TexelCode::rgba8)
        done.cost = chosen.made.cost;
    const std::vector<std::byte>& bytes = chosen.made.bytes;
    const Status written = writeFileWhole(out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return written ? Result<ConvertedFile>(done) : written.error();
}

} // namespace cotan::app
