#include "cotan/map_files/blend.hpp"

#include <atomic>

#include "cotan/image/file.hpp"
#include "stream.hpp"

namespace cotan::maps {

Result<BlendedFile> blendFiles(const std::filesystem::path& base, const std::filesystem::path& detail,
                               const std::filesystem::path& out, const BlendFileOptions& o, const FileOptions& files)
{
    const auto swizzle = swizzleOfFile(base, o.base, files.limits);
    if (!swizzle)
        return swizzle.error();
    const auto reader = openRows(base, files.limits);
    if (!reader)
        return reader.error();
    RowReader& in = **reader;
    const auto fine = readMap(detail, o.detail, files.limits);
    if (!fine)
        return fine.error();
    const auto mask = o.mask.empty() ? Result<Image>(Image{}) : readImage(o.mask, files.limits);
    if (!mask)
        return mask.error();
    const auto bits = bitsFor(o.bits, in.type, o.to, out);
    if (!bits)
        return bits.error();
    const BlendSettings settings{.base = o.base,
                                 .detail = o.detail,
                                 .to = o.to,
                                 .mode = o.mode,
                                 .strength = o.strength,
                                 .tilesX = o.tilesX,
                                 .tilesY = o.tilesY,
                                 .mask = o.mask.empty() ? nullptr : &*mask,
                                 .type = bits->type,
                                 .dither = o.dither,
                                 .pictureHeight = in.height};
    std::atomic<std::size_t> invalid = 0;
    const Status streamed = streamToFile(in, {}, out, {in.width, in.height, bits->type, false, bits->half, in.frame},
                                         files.threads, files.progress, [&](Image& strip, int firstRow) {
                                             unswizzle(strip, *swizzle);
                                             BlendSettings here = settings;
                                             here.firstRow = firstRow;
                                             std::size_t found = 0;
                                             Image rows = blend(strip, *fine, here, found);
                                             invalid += found;
                                             return rows;
                                         });
    if (!streamed)
        return streamed.error();
    return BlendedFile{in.width, in.height, *bits, invalid};
}

} // namespace cotan::maps
