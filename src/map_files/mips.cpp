#include "cotan/map_files/mips.hpp"

#include <array>
#include <cstring>

#include <fmt/format.h>

#include "cotan/files/output.hpp"

namespace cotan::maps {

namespace {

// An uncompressed DDS of RGBA, 8 bits, little-endian: header of 124 bytes (Microsoft's DDS_HEADER),
// then the levels. Roughness goes to alpha.
std::string ddsBytes(const std::vector<MipLevel>& chain)
{
    const Image& first = chain[0].normals;
    std::array<std::uint32_t, 32> header{};
    header[0] = 0x20534444; // "DDS "
    header[1] = 124;
    header[2] = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000 | 0x20000; // caps, height, width, pitch, format, mip count
    header[3] = std::uint32_t(first.height);
    header[4] = std::uint32_t(first.width);
    header[5] = std::uint32_t(first.width) * 4;
    header[7] = std::uint32_t(chain.size());
    header[19] = 32;         // the pixel format's own size
    header[20] = 0x1 | 0x40; // alpha and RGB
    header[22] = 32;
    header[23] = 0x000000ff, header[24] = 0x0000ff00, header[25] = 0x00ff0000, header[26] = 0xff000000;
    header[27] = 0x8 | 0x1000 | 0x400000; // complex, texture, mip map
    std::string bytes(reinterpret_cast<const char*>(header.data()), sizeof header);
    for (const MipLevel& level : chain) {
        std::string texels(reinterpret_cast<const char*>(level.normals.bytes8()), level.normals.data.size());
        for (std::size_t i = 0; i < level.normals.pixelCount(); ++i)
            texels[4 * i + 3] = char(level.roughness.bytes8()[4 * i]);
        bytes += texels;
    }
    return bytes;
}

bool isDds(const std::filesystem::path& out) { return out.extension() == ".dds"; }

std::filesystem::path numbered(const std::filesystem::path& file, const char* mark, std::size_t level)
{
    return file.parent_path() / fmt::format("{}{}_{}{}", file.stem().string(), mark, level, file.extension().string());
}

Status writeChain(const std::filesystem::path& out, const std::vector<MipLevel>& chain, const Bits& bits,
                  const MipFileOptions& o)
{
    if (isDds(out))
        return writeFileWhole(out, ddsBytes(chain));
    for (std::size_t i = 0; i < chain.size() && o.mayWrite; ++i)
        for (const char* mark : {"", "_roughness"})
            if (Status may = o.mayWrite(numbered(out, mark, i)); !may)
                return may;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        if (Status w = writeMap(numbered(out, "", i), chain[i].normals, bits); !w)
            return w;
        if (Status w = writeMap(numbered(out, "_roughness", i), chain[i].roughness, bits); !w)
            return w;
    }
    return Done{};
}

Result<Bits> bitsOfMips(const std::string& wanted, PixelType input, const std::filesystem::path& out)
{
    if (!isDds(out))
        return bitsFor(wanted, input, out);
    if (wanted != "auto" && wanted != "8")
        return usageError(fmt::format("options.bits: .dds files are written with 8 bits; found '{}'", wanted));
    return Bits{};
}

} // namespace

std::filesystem::path firstMipFile(const std::filesystem::path& out) { return isDds(out) ? out : numbered(out, "", 0); }

Result<std::vector<MipLevelFigures>> writeMips(const std::filesystem::path& file, const std::filesystem::path& out,
                                               const MipFileOptions& o, const FileOptions& files)
{
    const auto map = readMap(file, o.from, files.limits);
    if (!map)
        return map.error();
    const auto bits = bitsOfMips(o.bits, map->type, out);
    if (!bits)
        return bits.error();
    if (Status fits = checkSigned(o.to, *bits, out); !fits)
        return fits.error();
    // 32 bytes of moments for a quarter of the texels, and both pictures of all levels.
    const std::size_t work = map->pixelCount() * (8 + 11 * bytesPerComponent(bits->type));
    if (work > 4 * files.limits.imageBytes)
        return inputError(fmt::format("{}: the chain takes {} MiB, the limit is four times {}", file.string(),
                                      work >> 20, files.limits.imageBytes >> 20));
    CountedSteps steps(files.progress, 3); // read, filtered, written
    if (!steps.step())
        return stoppedError();
    const auto chain = mipChain(*map,
                                {.from = o.from,
                                 .to = o.to,
                                 .keepLengths = o.keepLengths,
                                 .model = o.model,
                                 .roughness = o.roughness,
                                 .type = bits->type});
    if (!steps.step())
        return stoppedError();
    if (Status written = writeChain(out, chain, *bits, o); !written)
        return written.error();
    steps.step();
    std::vector<MipLevelFigures> figures;
    for (const MipLevel& level : chain)
        figures.push_back({level.normals.width, level.normals.height, level.meanLength, level.meanRoughness});
    return figures;
}

} // namespace cotan::maps
