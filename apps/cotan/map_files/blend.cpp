#include "map_files/blend.hpp"

#include <atomic>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "stream.hpp"

namespace cotan::app {

using namespace maps;

Result<BlendedFile> blendFiles(const std::filesystem::path& base, const std::filesystem::path& detail,
                               const std::filesystem::path& out, const BlendFileOptions& o, const FileOptions& files)
{
    COTAN_TRY(opened, openMap(base, o.base, "options.from", files.limits));
    RowReader& in = *opened->rows;
    COTAN_TRY(fine, readMap(detail, o.detail, "options.detailFrom", files.limits));
    COTAN_TRY(mask, o.mask.empty() ? Result<Image>(Image{}) : readImage(o.mask, files.limits));
    const Convention to = o.to.value_or(opened->convention);
    COTAN_TRY(bits, bitsFor(o.bits, in.type, to, out));
    const BlendSettings settings{.base = opened->convention,
                                 .detail = fine->convention,
                                 .to = to,
                                 .mode = o.mode,
                                 .strength = o.strength,
                                 .tilesX = o.tilesX,
                                 .tilesY = o.tilesY,
                                 .mask = o.mask.empty() ? nullptr : &*mask,
                                 .type = bits->type,
                                 .dither = o.dither,
                                 .imageHeight = in.height};
    const bool alpha = in.alpha && settings.base.channels == Channels::xyz && to.channels == Channels::xyz;
    std::atomic<std::size_t> invalid = 0;
    const Status streamed = streamToFile(in, {}, out, {in.width, in.height, bits->type, alpha, bits->half, in.frame},
                                         files.threads, files.progress, [&](Image& strip, int firstRow) {
                                             opened->put(strip, firstRow);
                                             BlendSettings here = settings;
                                             here.firstRow = firstRow;
                                             std::size_t found = 0;
                                             Image rows = blend(strip, fine->image, here, found);
                                             invalid += found;
                                             return rows;
                                         });
    if (!streamed)
        return streamed.error();
    BlendedFile done{in.width, in.height, *bits, invalid, to};
    addNote(opened->note(), done.notes);
    addNote(fine->note, done.notes);
    return done;
}

} // namespace cotan::app
