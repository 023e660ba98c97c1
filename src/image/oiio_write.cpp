// The module of image formats: writing.
#include "oiio.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/one_line.hpp"
#include "core/try.hpp"
#include "image/checks.hpp"
#include "image/component_types.hpp"
#include "image/format_table.hpp"

namespace cotan::oiio {

namespace {

// Wraps an OpenImageIO message in a sentence.
Error notWritten(const std::string& name, const std::string& words)
{
    return outputError(name + ": expected to write the image, OpenImageIO found: " + oneLine(words));
}

// A file for OpenImageIO's writers that records write errors. The writers do not: on a full disk Targa's reports
// success, and JPEG's ends the process. flush() does nothing, since finish() closes the file: it is const in some
// versions of OpenImageIO only.
class CheckedFile final : public OIIO::Filesystem::IOProxy {
public:
    // file: open for reading and writing. name: where OpenImageIO finds the extension.
    CheckedFile(OpenFile file, const std::string& name) : IOProxy(name, Write), file_(std::move(file)) {}

    // Closes the file. Errors: ErrorKind::output with the system's reason if any byte was not written. name: for the
    // message.
    Status finish(const std::string& name)
    {
        if (file_ && std::fclose(file_.release()) != 0)
            note();
        return error_ == 0 ? Status(Done{}) : notWritten(name, std::generic_category().message(error_));
    }

    const char* proxytype() const override { return "checked"; } // any name but "file" makes JPEG encode in memory

    std::size_t read(void* to, std::size_t count) override
    {
        const std::size_t done = pread(to, count, m_pos);
        m_pos += std::int64_t(done);
        return done;
    }

    std::size_t write(const void* from, std::size_t count) override
    {
        const std::size_t done = pwrite(from, count, m_pos);
        m_pos += std::int64_t(done);
        return done;
    }

    std::size_t pread(void* to, std::size_t count, std::int64_t offset) override
    {
        return moveTo(offset, Use::reading) ? std::fread(to, 1, count, file_.get()) : 0;
    }

    std::size_t pwrite(const void* from, std::size_t count, std::int64_t offset) override
    {
        if (count == 0 || !moveTo(offset, Use::writing)) // Targa writes 0 bytes from a null pointer
            return 0;
        const std::size_t done = std::fwrite(from, 1, count, file_.get());
        at_ += std::int64_t(done);
        if (done != count)
            note();
        return done;
    }

    std::size_t size() const override
    {
        if (!file_ || ::fseeko(file_.get(), 0, SEEK_END) != 0)
            return 0;
        at_ = -1; // so that the next use seeks
        return std::size_t(::ftello(file_.get()));
    }

private:
    enum class Use { nothing, reading, writing };

    void note()
    {
        if (error_ == 0)
            error_ = errno != 0 ? errno : EIO;
    }

    // A FILE needs a seek between reading and writing. Unnecessary seeks are avoided: they would flush its buffer, and
    // fail for pipes.
    bool moveTo(std::int64_t offset, Use use)
    {
        if (!file_)
            return false;
        if ((use != use_ && use_ != Use::nothing) || offset != at_ || use == Use::reading)
            if (::fseeko(file_.get(), offset, SEEK_SET) != 0) {
                note();
                return false;
            }
        use_ = use;
        at_ = use == Use::writing ? offset : -1;
        return true;
    }

    OpenFile file_;
    int error_ = 0; // errno of the first failure
    Use use_ = Use::nothing;
    mutable std::int64_t at_ = 0; // offset of the next write; -1: unknown
};

// The type in which components of `type` are stored.
OIIO::TypeDesc typeToWrite(const ImageFormat& format, PixelType type)
{
    if (!format.bits16 && !format.floats)
        return OIIO::TypeDesc::UINT8;
    return format.bits8 ? typeDesc(type) : OIIO::TypeDesc::FLOAT;
}

// channels: at most those of the format. frame: Image::frame, for the formats that store it.
OIIO::ImageSpec outputSpec(int width, int height, int channels, OIIO::TypeDesc type, const ImageFormat& format,
                           const std::string& frame)
{
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1); // values are written unchanged
    // A constant date: the same image gives the same bytes.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (format.openImageIo == "openexr" || format.openImageIo == "tiff")
        spec.attribute("compression", "zip");
    if (format.openImageIo == "jpeg")
        spec.attribute("CompressionQuality", 95);
    if (format.frame && !frame.empty())
        spec.attribute(std::string(kFrameKey), frame);
    return spec;
}

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
    try {
        if (work())
            return Done{};
        return notWritten(name_, output_->geterror());
    } catch (const std::exception& e) {
        return notWritten(name_, e.what());
    }

    std::unique_ptr<CheckedFile> file_; // outlives output_, which writes to it
    std::unique_ptr<OIIO::ImageOutput> output_;
    RowFormat format_;
    std::string name_;
    int next_ = 0;
};

} // namespace

Status write(OpenFile file, const Image& image, const std::string& name)
{
    const ImageFormat& format = *imageFormatOf(name); // checkImageName has accepted `name`
    const OIIO::TypeDesc type = typeToWrite(format, image.type);
    if (type == OIIO::TypeDesc::UINT8 && image.type != PixelType::unorm8)
        return write(std::move(file), toUnorm8(image), name);
    try {
        CheckedFile checked(std::move(file), name); // outlives `output`, which writes to it
        const auto output = OIIO::ImageOutput::create(std::string(format.openImageIo));
        if (!output)
            return notWritten(name, OIIO::geterror());
        output->threads(1);
        output->set_ioproxy(&checked);
        const OIIO::ImageSpec spec =
            outputSpec(image.width, image.height, format.alpha ? 4 : 3, type, format, image.frame);
        const bool done = output->open(name, spec)
            && output->write_image(typeDesc(image.type), image.data.data(), OIIO::stride_t(image.bytesPerPixel()))
            && output->close();
        COTAN_CHECK(checked.finish(name));
        if (!done)
            return notWritten(name, output->geterror());
    } catch (const std::exception& e) {
        return notWritten(name, e.what());
    }
    return Done{};
}

Result<std::unique_ptr<RowWriter>> createRows(OpenFile file, const RowFormat& format, int threads,
                                              const std::string& name)
try {
    const ImageFormat& stored = *imageFormatOf(name);                    // checkImageName has accepted `name`
    auto checked = std::make_unique<CheckedFile>(std::move(file), name); // outlives `output`, which writes to it
    auto output = OIIO::ImageOutput::create(std::string(stored.openImageIo));
    if (!output)
        return notWritten(name, OIIO::geterror());
    output->threads(threads);
    const int channels = format.alpha && stored.alpha ? 4 : 3;
    const auto type = format.half ? OIIO::TypeDesc(OIIO::TypeDesc::HALF) : typeToWrite(stored, format.type);
    output->set_ioproxy(checked.get());
    if (!output->open(name, outputSpec(format.width, format.height, channels, type, stored, format.frame)))
        return notWritten(name, output->geterror());
    return std::unique_ptr<RowWriter>(std::make_unique<Writer>(std::move(checked), std::move(output), format, name));
} catch (const std::exception& e) {
    return notWritten(name, e.what());
}

// ---- animated GIF: one subimage per image ---------------------------------------------------

namespace {

// Offsets of the delays of a GIF's images: 2 bytes each, little-endian, in hundredths of a second.
std::vector<std::uint64_t> delaysOf(Numbers gif)
{
    constexpr std::uint64_t kHead = 13, kImage = 9; // bytes: of the file header, and of an image descriptor
    const auto tableSize = [](std::uint64_t flags) { return (flags & 0x80) != 0 ? 3u << ((flags & 7) + 1) : 0; };
    std::vector<std::uint64_t> delays;
    std::uint64_t at = kHead + tableSize(gif.at(10, 1));
    for (std::uint64_t mark = gif.at(at++, 1); mark == '!' || mark == ','; mark = gif.at(at++, 1)) {
        if (mark == '!') {
            if (gif.at(at++, 1) == 0xf9) // the block: size, flags, delay, transparent colour
                delays.push_back(at + 2);
        } else {
            at += kImage + tableSize(gif.at(at + kImage - 1, 1)) + 1; // and the LZW minimum code size
        }
        for (std::uint64_t size = gif.at(at++, 1); size > 0; size = gif.at(at++, 1))
            at += size;
    }
    return delays;
}

// Sets the delays. OpenImageIO 2.5 writes one second for every image, whatever FramesPerSecond is.
void setDelays(CheckedFile& file, double rate)
{
    const auto delay = unsigned(std::lround(100 / rate));
    const std::array<char, 2> bytes{char(delay & 255), char(delay >> 8)};
    for (const std::uint64_t at : delaysOf(numbersOf(file)))
        file.pwrite(bytes.data(), bytes.size(), std::int64_t(at));
}

class Gif : public AnimationWriter {
public:
    Gif(OpenFile file, const AnimationFormat& format, std::string name)
        : name_(std::move(name)), spec_(format.width, format.height, 4, OIIO::TypeDesc::UINT8), rate_(format.rate),
          left_(format.images), checked_(std::move(file), name_)
    {
        spec_.attribute("FramesPerSecond", float(format.rate));
    }

    Status add(const Image& image) override
    try {
        if (left_ == 0)
            return outputError(name_ + ": expected no more images than announced");
        if (!output_) {
            output_ = OIIO::ImageOutput::create("gif");
            const std::vector<OIIO::ImageSpec> all(left_, spec_);
            if (!output_ || !output_->set_ioproxy(&checked_) || !output_->open(name_, int(left_), all.data()))
                return failed();
        } else if (!output_->open(name_, spec_, OIIO::ImageOutput::AppendSubimage)) {
            return failed();
        }
        --left_;
        return output_->write_image(OIIO::TypeDesc::UINT8, image.data.data()) ? Status(Done{}) : failed();
    } catch (const std::exception& e) {
        return outputError(fmt::format("{}: {}", name_, oneLine(e.what())));
    }

    Status finish() override
    {
        const bool closed = output_ && output_->close();
        if (closed)
            setDelays(checked_, rate_);
        Status whole = checked_.finish(name_);
        return whole && !closed ? failed() : whole;
    }

private:
    Status failed() const
    {
        return outputError(fmt::format("{}: {}", name_, oneLine(output_ ? output_->geterror() : OIIO::geterror())));
    }

    std::string name_;
    OIIO::ImageSpec spec_;
    double rate_; // images per second
    std::size_t left_;
    CheckedFile checked_;
    std::unique_ptr<OIIO::ImageOutput> output_; // writes to checked_
};

} // namespace

Result<std::unique_ptr<AnimationWriter>> createGif(OpenFile file, const AnimationFormat& format,
                                                   const std::string& name)
{
    return std::unique_ptr<AnimationWriter>(new Gif(std::move(file), format, name));
}

} // namespace cotan::oiio
