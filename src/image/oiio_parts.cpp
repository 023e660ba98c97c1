// The module's pictures a part at a time: rows, and the pictures of animations.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "image/checks.hpp"
#include "oiio.hpp"

namespace cotan::oiio {

namespace {

using Input = std::unique_ptr<OIIO::ImageInput>;

class Reader : public RowReader {
public:
    Reader(Input input, const OIIO::ImageSpec& spec, std::string format, const std::string& file)
        : input_(std::move(input)), spec_(spec), format_(std::move(format))
    {
        name = file;
        width = spec.width;
        height = spec.height;
        type = pixelType(spec.format);
        alpha = spec.nchannels == 2 || spec.nchannels >= 4;
        frame = frameOf(spec, format_);
        channels = std::min(spec.nchannels, 4);
    }

    Status read(Image& strip) override
    {
        try {
            const bool done = spec_.tile_height > 0 ? fromTiles(strip) : readScanlines(*input_, next_, channels, strip);
            if (!done)
                return brokenToOiio(name, format_, input_->geterror());
        } catch (const std::exception& e) {
            return brokenToOiio(name, format_, e.what());
        }
        next_ += strip.height;
        completeChannels(strip, channels);
        return Done{};
    }

private:
    // Files of tiles: a row of tiles is kept, and rows are taken from it.
    bool fromTiles(Image& strip)
    {
        const std::size_t rowBytes = std::size_t(width) * strip.bytesPerPixel();
        for (int y = 0; y < strip.height; ++y) {
            const int row = next_ + y, first = row / spec_.tile_height * spec_.tile_height;
            if (first != tileRow_) {
                const int rows = std::min(spec_.tile_height, height - first);
                if (tiles_.height != rows)
                    tiles_ = makeImage(width, rows, type);
                if (!input_->read_tiles(0, 0, spec_.x, spec_.x + width, spec_.y + first, spec_.y + first + rows, 0, 1,
                                        0, channels, typeDesc(type), tiles_.data.data(),
                                        OIIO::stride_t(strip.bytesPerPixel())))
                    return false;
                tileRow_ = first;
            }
            std::memcpy(strip.data.data() + std::size_t(y) * rowBytes,
                        tiles_.data.data() + std::size_t(row - first) * rowBytes, rowBytes);
        }
        return true;
    }

    Input input_;
    OIIO::ImageSpec spec_;
    std::string format_;
    int next_ = 0;
    Image tiles_;
    int tileRow_ = -1;
};

class Writer : public RowWriter {
public:
    Writer(std::unique_ptr<CheckedFile> file, std::unique_ptr<OIIO::ImageOutput> output, RowFormat format,
           std::string name)
        : file_(std::move(file)), output_(std::move(output)), format_(format), name_(std::move(name))
    {
    }

    Status write(const Image& strip) override
    {
        return guarded([&] {
            const int first = next_;
            next_ += strip.height;
            return output_->write_scanlines(first, next_, 0, typeDesc(format_.type), strip.data.data(),
                                            OIIO::stride_t(strip.bytesPerPixel()));
        });
    }

    Status finish() override
    {
        Status closed = guarded([&] { return output_->close(); });
        Status whole = file_->finish(name_);
        return whole ? closed : whole;
    }

private:
    template<class Work> Status guarded(Work work)
    {
        try {
            if (work())
                return Done{};
            return notWritten(name_, output_->geterror());
        } catch (const std::exception& e) {
            return notWritten(name_, e.what());
        }
    }

    std::unique_ptr<CheckedFile> file_; // the output writes to it until it ends
    std::unique_ptr<OIIO::ImageOutput> output_;
    RowFormat format_;
    std::string name_;
    int next_ = 0;
};

// What one row, or one row of tiles, may take.
std::optional<Error> checkRows(const OIIO::ImageSpec& spec, const std::string& name, const LoadLimits& limits)
{
    if (spec.width <= 0 || spec.height <= 0)
        return inputError(fmt::format("{}: the image size is {} x {}", name, spec.width, spec.height));
    if (auto error = checkLayers(spec, name))
        return error;
    const double rows = std::max(spec.tile_height, 1);
    const double stored = std::max(double(spec.width), double(spec.tile_width)) * rows
        * std::max(double(spec.pixel_bytes(/*native=*/true)), 16.0);
    if (spec.width > limits.imageSide || spec.height > limits.imageSide || stored > double(limits.imageBytes))
        return memoryError(
            fmt::format("{}: {} x {} pixels in rows of {:.0f} bytes, the limit is {} a side and {} bytes", name,
                        spec.width, spec.height, stored, limits.imageSide, limits.imageBytes));
    if (limits.expect)
        limits.expect(std::size_t(stored));
    return std::nullopt;
}

} // namespace

Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, std::span<const std::byte> head,
                                            const LoadLimits& limits)
{
    const std::string name = file.string(), format = formatOf(head);
    try {
        OIIO::Filesystem::IOFile layout(name, OIIO::Filesystem::IOProxy::Read);
        if (auto error = checkFileLayout(layout, name, format, limits))
            return *error;
        Input input = OIIO::ImageInput::create(format);
        if (!input)
            return brokenToOiio(name, format, OIIO::geterror());
        OIIO::ImageSpec spec;
        if (!input->open(name, spec, readConfig()))
            return brokenToOiio(name, format, input->geterror());
        if (auto error = checkRows(spec, name, limits))
            return *error;
        return std::unique_ptr<RowReader>(std::make_unique<Reader>(std::move(input), spec, format, name));
    } catch (const std::exception& e) {
        return brokenToOiio(name, format, e.what());
    }
}

Result<std::unique_ptr<RowWriter>> createRows(const std::filesystem::path& file, const RowFormat& format, int threads,
                                              const std::string& name)
{
    const ImageFormat& stored = *imageFormatOf(name); // which checkImageName accepted
    try {
        auto output = OIIO::ImageOutput::create(std::string(stored.openImageIo));
        if (!output)
            return notWritten(name, OIIO::geterror());
        output->threads(threads);
        const int channels = format.alpha && stored.alpha ? 4 : 3;
        const auto type = format.half ? OIIO::TypeDesc(OIIO::TypeDesc::HALF) : typeToWrite(stored, format.type);
        auto checked = std::make_unique<CheckedFile>(file);
        output->set_ioproxy(checked.get());
        if (!output->open(file.string(), outputSpec(format.width, format.height, channels, type, stored, format.frame)))
            return notWritten(name, output->geterror());
        return std::unique_ptr<RowWriter>(
            std::make_unique<Writer>(std::move(checked), std::move(output), format, name));
    } catch (const std::exception& e) {
        return notWritten(name, e.what());
    }
}

// ---- animated GIF: one subimage a picture ---------------------------------------------------

namespace {

// Where in a whole GIF the delays of its pictures are: two bytes each, in hundredths of a second, the low one first.
std::vector<std::streamoff> delaysOf(std::istream& gif)
{
    constexpr int kHead = 13, kImage = 9; // bytes: of the file, and of a picture behind its mark
    const auto skipTable = [&](int flags) { gif.ignore((flags & 0x80) != 0 ? 3 << ((flags & 7) + 1) : 0); };
    const auto skipBlocks = [&] {
        for (int size = gif.get(); size > 0; size = gif.get())
            gif.ignore(size);
    };
    std::vector<std::streamoff> delays;
    std::array<char, kHead> head{};
    gif.read(head.data(), kHead);
    skipTable(head[10]);
    for (int mark = gif.get(); mark == '!' || mark == ','; mark = gif.get()) {
        if (mark == '!') {
            if (gif.get() == 0xf9) // its block: size, flags, delay, transparent colour
                delays.push_back(std::streamoff(gif.tellg()) + 2);
        } else {
            gif.read(head.data(), kImage);
            skipTable(head[8]);
            gif.ignore(1); // bits of a code
        }
        skipBlocks();
    }
    return delays;
}

// OpenImageIO 2.5 gives every picture a second, whatever FramesPerSecond says.
bool setDelays(const std::filesystem::path& file, double rate)
{
    std::fstream gif(file, std::ios::in | std::ios::out | std::ios::binary);
    const std::vector<std::streamoff> delays = delaysOf(gif);
    gif.clear(); // that the end was reached
    const auto delay = unsigned(std::lround(100 / rate));
    for (const std::streamoff at : delays) {
        gif.seekp(at);
        gif.put(char(delay & 255)).put(char(delay >> 8));
    }
    gif.close();
    return bool(gif);
}

class Gif : public AnimationWriter {
public:
    Gif(std::filesystem::path file, const AnimationFormat& format, std::string name)
        : file_(std::move(file)), name_(std::move(name)), spec_(format.width, format.height, 4, OIIO::TypeDesc::UINT8),
          rate_(format.rate), left_(format.pictures), checked_(file_)
    {
        spec_.attribute("FramesPerSecond", float(format.rate));
    }

    Status add(const Image& picture) override
    {
        try {
            if (left_ == 0)
                return outputError(name_ + ": there are more pictures than were announced");
            if (!output_) {
                output_ = OIIO::ImageOutput::create("gif");
                const std::vector<OIIO::ImageSpec> all(left_, spec_);
                if (!output_ || !output_->set_ioproxy(&checked_)
                    || !output_->open(file_.string(), int(left_), all.data()))
                    return failed();
            } else if (!output_->open(file_.string(), spec_, OIIO::ImageOutput::AppendSubimage)) {
                return failed();
            }
            --left_;
            return output_->write_image(OIIO::TypeDesc::UINT8, picture.data.data()) ? Status(Done{}) : failed();
        } catch (const std::exception& e) {
            return outputError(fmt::format("{}: {}", name_, oneLine(e.what())));
        }
    }

    Status finish() override
    {
        const bool closed = output_ && output_->close();
        if (Status whole = checked_.finish(name_); !whole)
            return whole;
        if (!closed)
            return failed();
        return setDelays(file_, rate_) ? Status(Done{}) : outputError(name_ + ": cannot write the file");
    }

private:
    Status failed() const
    {
        return outputError(fmt::format("{}: {}", name_, oneLine(output_ ? output_->geterror() : OIIO::geterror())));
    }

    std::filesystem::path file_;
    std::string name_;
    OIIO::ImageSpec spec_;
    double rate_; // pictures a second
    std::size_t left_;
    CheckedFile checked_;
    std::unique_ptr<OIIO::ImageOutput> output_; // writes to it until it ends
};

} // namespace

Result<std::unique_ptr<AnimationWriter>> createGif(const std::filesystem::path& file, const AnimationFormat& format,
                                                   const std::string& name)
{
    return std::unique_ptr<AnimationWriter>(new Gif(file, format, name));
}

} // namespace cotan::oiio
