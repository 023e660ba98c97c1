// Writes PNG files quickly: filters and compresses parts of rows side by side, without libpng.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "codecs.hpp"
#include "core/loops.hpp"
#include "core/try.hpp"
#include "image/checks.hpp"

namespace cotan {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kPartBytes = 1 << 18; // of filtered rows that are compressed on their own
constexpr std::size_t kPartsAtOnce = 32;
constexpr std::uint8_t kFilterUp = 2; // each byte minus that above it
constexpr int kLevel = 2;             // a quarter of the time of level 6, for files that are a quarter larger

// Appends rows as blocks of deflate that end on a whole byte; none is the last block of a stream.
void deflateRows(const Bytes& rows, Bytes& packed)
{
    z_stream stream{};
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL - 1, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc(); // its only error with these arguments
    const std::size_t begin = packed.size();
    packed.resize(begin + deflateBound(&stream, uLong(rows.size())) + 16); // the bound is for Z_FINISH
    stream.next_in = const_cast<Bytef*>(rows.data());
    stream.avail_in = uInt(rows.size());
    stream.next_out = &packed[begin];
    stream.avail_out = uInt(packed.size() - begin);
    deflate(&stream, Z_SYNC_FLUSH);
    packed.resize(packed.size() - stream.avail_out);
    deflateEnd(&stream);
}

void appendNumber(std::uint32_t number, Bytes& bytes)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(std::uint8_t(number >> shift));
}

// Begins a chunk, whose data are appended next; returns where it begins.
std::size_t beginChunk(std::string_view type, Bytes& bytes)
{
    const std::size_t begin = bytes.size();
    bytes.resize(begin + 4);
    bytes.insert(bytes.end(), type.begin(), type.end());
    return begin;
}

void endChunk(std::size_t begin, Bytes& bytes)
{
    const std::size_t data = bytes.size() - begin - 8;
    for (std::size_t k = 0; k < 4; ++k)
        bytes[begin + k] = std::uint8_t(data >> (24 - 8 * k));
    appendNumber(std::uint32_t(crc32(0, &bytes[begin + 4], uInt(data + 4))), bytes);
}

constexpr std::size_t kWrittenAhead = 2; // bytes that copyPixels may write beyond the last pixel

// Copies pixels without their alpha, unless Kept is all of them. Writes up to kWrittenAhead bytes beyond the last.
template<class Pixel, std::size_t Kept> void copyPixels(const std::uint8_t* from, std::size_t count, std::uint8_t* to)
{
    for (std::size_t i = 0; i < count; ++i, from += sizeof(Pixel), to += Kept) {
        Pixel pixel;
        std::memcpy(&pixel, from, sizeof pixel);
        if constexpr (sizeof(Pixel) == 8 && std::endian::native == std::endian::little) // the file's are big-endian
            pixel = (pixel & 0x00ff00ff00ff00ffu) << 8 | (pixel >> 8 & 0x00ff00ff00ff00ffu);
        std::memcpy(to, &pixel, sizeof pixel);
    }
}

class PngOut : public RowWriter {
public:
    PngOut(OpenFile file, const RowFormat& format, std::string name)
        : file_(std::move(file)), name_(std::move(name)), width_(std::size_t(format.width)),
          storedBytes_(format.type == PixelType::unorm16 ? 8 : 4),
          pixelBytes_(format.alpha ? storedBytes_ : storedBytes_ / 4 * 3), above_(width_ * storedBytes_)
    {
    }

    Status start(const RowFormat& format)
    {
        if (rowBytes() >= std::size_t(1) << 31)
            return outputError(
                fmt::format("{}: expected rows of fewer than 2 GiB for PNG; found {} pixels in one", name_, width_));
        Bytes bytes{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
        std::size_t chunk = beginChunk("IHDR", bytes);
        appendNumber(std::uint32_t(format.width), bytes);
        appendNumber(std::uint32_t(format.height), bytes);
        bytes.push_back(std::uint8_t(2 * storedBytes_)); // bits of a component
        bytes.insert(bytes.end(),
                     {std::uint8_t(format.alpha ? 6 : 2), 0, 0, 0}); // components; deflate, filters, no interlacing
        endChunk(chunk, bytes);
        const std::string_view frame = format.frame.c_str(); // up to the first zero
        if (!frame.empty()) {
            chunk = beginChunk("tEXt", bytes);
            bytes.insert(bytes.end(), kFrameKey.begin(), kFrameKey.end());
            bytes.push_back(0);
            bytes.insert(bytes.end(), frame.begin(), frame.end());
            endChunk(chunk, bytes);
        }
        chunk = beginChunk("IDAT", bytes);
        bytes.insert(bytes.end(), {0x78, 0x01}); // zlib's header: a window of 32 KiB, compressed fast
        endChunk(chunk, bytes);
        return take(bytes);
    }

    Status write(const Image& strip) override
    {
        const std::size_t height = std::size_t(strip.height), rows = std::max<std::size_t>(kPartBytes / rowBytes(), 1);
        std::array<Part, kPartsAtOnce> parts;
        for (std::size_t first = 0; first < height; first += rows * kPartsAtOnce) {
            const std::size_t count = std::min((height - first + rows - 1) / rows, kPartsAtOnce);
            parallelFor(std::size_t(0), count, [&](std::size_t i) {
                const std::size_t begin = first + i * rows;
                parts[i] = packed(strip, begin, std::min(begin + rows, height));
            });
            for (std::size_t i = 0; i < count; ++i) {
                sum_ = adler32_combine(sum_, parts[i].sum, z_off_t(parts[i].size));
                COTAN_CHECK(take(parts[i].chunk));
            }
        }
        if (height > 0)
            std::memcpy(above_.data(), rowOf(strip, height - 1), above_.size());
        return Done{};
    }

    Status finish() override
    {
        Bytes bytes;
        std::size_t chunk = beginChunk("IDAT", bytes);
        bytes.insert(bytes.end(), {1, 0, 0, 0xff, 0xff}); // the last block, which is empty
        appendNumber(std::uint32_t(sum_), bytes);
        endChunk(chunk, bytes);
        chunk = beginChunk("IEND", bytes);
        endChunk(chunk, bytes);
        COTAN_CHECK(take(bytes));
        if (std::fclose(file_.release()) != 0)
            return outputError(fmt::format("{}: writing failed", name_));
        return Done{};
    }

private:
    struct Part {
        Bytes chunk;
        std::size_t size = 0; // before compression
        uLong sum = 0;        // Adler-32 of that
    };

    std::size_t rowBytes() const { return 1 + width_ * pixelBytes_; }
    const std::uint8_t* rowOf(const Image& strip, std::size_t y) const
    {
        return strip.bytes8() + y * width_ * storedBytes_;
    }

    Part packed(const Image& strip, std::size_t begin, std::size_t end) const
    {
        Bytes rows(rowBytes() * (end - begin) + kWrittenAhead), off(width_ * storedBytes_);
        for (std::size_t y = begin; y < end; ++y) {
            const std::uint8_t *const row = rowOf(strip, y), *const above = y > 0 ? rowOf(strip, y - 1) : above_.data();
            for (std::size_t i = 0; i < off.size(); ++i)
                off[i] = std::uint8_t(row[i] - above[i]);
            std::uint8_t* const to = &rows[(y - begin) * rowBytes()];
            to[0] = kFilterUp;
            switch (pixelBytes_) {
            case 3: copyPixels<std::uint32_t, 3>(off.data(), width_, to + 1); break;
            case 4: copyPixels<std::uint32_t, 4>(off.data(), width_, to + 1); break;
            case 6: copyPixels<std::uint64_t, 6>(off.data(), width_, to + 1); break;
            default: copyPixels<std::uint64_t, 8>(off.data(), width_, to + 1);
            }
        }
        Part part;
        rows.resize(rows.size() - kWrittenAhead);
        part.size = rows.size();
        part.sum = adler32(adler32(0, nullptr, 0), rows.data(), uInt(part.size));
        const std::size_t chunk = beginChunk("IDAT", part.chunk);
        deflateRows(rows, part.chunk);
        endChunk(chunk, part.chunk);
        return part;
    }

    Status take(const Bytes& bytes) const
    {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
            return outputError(fmt::format("{}: writing failed", name_));
        return Done{};
    }

    OpenFile file_;
    std::string name_;
    std::size_t width_, storedBytes_, pixelBytes_; // of a pixel, in the image and in the file
    Bytes above_;                                  // the last row so far; zero above the image
    uLong sum_ = adler32(0, nullptr, 0);
};

} // namespace

Result<std::unique_ptr<RowWriter>> createPngRows(OpenFile file, const RowFormat& format, const std::string& name)
{
    auto rows = std::make_unique<PngOut>(std::move(file), format, name);
    COTAN_CHECK(rows->start(format));
    return std::unique_ptr<RowWriter>(std::move(rows));
}

Status writePng(OpenFile file, const Image& image, const std::string& name)
{
    COTAN_TRY(rows,
              createPngRows(std::move(file),
                            {image.width, image.height, image.type, !isOpaque(image), false, image.frame}, name));
    COTAN_CHECK((*rows)->write(image));
    return (*rows)->finish();
}

} // namespace cotan
