#include "cotan/image/rows.hpp"

#include <array>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/files/extension.hpp"
#include "cotan/files/output.hpp"
#include "cotan/files/bytes.hpp"
#include "formats.hpp"
#include "png.hpp"
#include "png_session.hpp"
#include "sandboxed.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, Close>;

class PngRows : public RowReader {
public:
    explicit PngRows(File file) : file_(std::move(file)), reader_(file_.get()) {}

    PngReader& reader() { return reader_; }

    Status read(Image& strip) override
    {
        const std::size_t rowBytes = std::size_t(width) * strip.bytesPerPixel();
        int passes = 1;
        bool fine = started_ || startPngPixels(reader_, rowBytes, false, passes);
        started_ = true;
        fine = fine && readPngRows(reader_, strip.bytes8(), std::size_t(strip.height), rowBytes);
        next_ += strip.height;
        if (fine && next_ == height)
            fine = endPngPixels(reader_);
        if (!fine)
            return inputError(fmt::format("{}: broken PNG: {}", name, reader_.session.message));
        return Done{};
    }

private:
    File file_;
    PngReader reader_;
    bool started_ = false;
    int next_ = 0;
};

template<class T> bool anyBelow(const T* alpha, std::size_t pixels, T one)
{
    for (std::size_t i = 0; i < pixels; ++i)
        if (alpha[4 * i] != one)
            return true;
    return false;
}

bool usesAlpha(const Image& image)
{
    const std::size_t pixels = image.pixelCount();
    if (image.type == PixelType::unorm8)
        return anyBelow<std::uint8_t>(image.bytes8() + 3, pixels, 0xff);
    if (image.type == PixelType::unorm16)
        return anyBelow<std::uint16_t>(image.words() + 3, pixels, 0xffff);
    return anyBelow(image.floats() + 3, pixels, 1.0f);
}

class WholeRows : public RowReader {
public:
    explicit WholeRows(Image image) : image_(std::move(image))
    {
        name = image_.name;
        width = image_.width;
        height = image_.height;
        type = image_.type;
        alpha = usesAlpha(image_);
        whole = true;
    }

    Status read(Image& strip) override
    {
        std::memcpy(strip.data.data(), image_.data.data() + next_, strip.data.size());
        next_ += strip.data.size();
        return Done{};
    }

private:
    Image image_;
    std::size_t next_ = 0;
};

Result<std::unique_ptr<RowReader>> openWhole(const fs::path& file, const LoadLimits& limits)
{
    auto image = readImage(file, limits);
    if (!image)
        return image.error();
    return std::unique_ptr<RowReader>(std::make_unique<WholeRows>(*std::move(image)));
}

// Nothing: it cannot be read by rows.
std::optional<Result<std::unique_ptr<RowReader>>> openPng(const fs::path& file, File stream, const LoadLimits& limits)
{
    std::rewind(stream.get());
    auto rows = std::make_unique<PngRows>(std::move(stream));
    PngHeader header;
    if (!rows->reader().info)
        return inputError(fmt::format("{}: out of memory", file.string()));
    if (!readPngHeader(rows->reader(), header))
        return inputError(fmt::format("{}: broken PNG: {}", file.string(), rows->reader().session.message));
    if (header.interlaced)
        return std::nullopt;
    if (header.width > png_uint_32(limits.imageSide) || header.height > png_uint_32(limits.imageSide))
        return inputError(fmt::format("{}: the image size is {} x {}, the limit is {} a side", file.string(),
                                      header.width, header.height, limits.imageSide));
    rows->name = file.string();
    rows->width = int(header.width);
    rows->height = int(header.height);
    rows->type = header.type;
    rows->alpha = header.alpha;
    return std::unique_ptr<RowReader>(std::move(rows));
}

class PngOut : public RowWriter {
public:
    PngOut(OutputFile output, File file, std::string name)
        : output_(std::move(output)), file_(std::move(file)), writer_(file_.get()), name_(std::move(name))
    {
    }

    Status start(const RowFormat& format)
    {
        if (!writer_.info)
            return outputError(fmt::format("{}: out of memory", name_));
        return check(startPng(writer_, {format.width, format.height, format.type, format.alpha}, kQuickPng));
    }
    Status write(const Image& strip) override
    {
        return check(writePngRows(writer_, strip.bytes8(), std::size_t(strip.height),
                                  std::size_t(strip.width) * strip.bytesPerPixel()));
    }
    Status finish() override
    {
        if (Status ended = check(endPng(writer_)); !ended)
            return ended;
        if (std::fclose(file_.release()) != 0)
            return output_.failed(outputError(fmt::format("{}: writing failed", name_)));
        return output_.commit();
    }

private:
    Status check(bool fine) const
    {
        if (!fine)
            return output_.failed(outputError(fmt::format("{}: {}", name_, writer_.session.message)));
        return Done{};
    }

    OutputFile output_; // removed last
    File file_;
    PngWriter writer_;
    std::string name_;
};

class OtherOut : public RowWriter {
public:
    OtherOut(OutputFile output, std::unique_ptr<RowWriter> writer) : output_(std::move(output)), writer_(std::move(writer)) {}

    Status write(const Image& strip) override { return told(writer_->write(strip)); }
    Status finish() override
    {
        if (Status finished = told(writer_->finish()); !finished)
            return finished;
        return output_.commit();
    }

private:
    Status told(Status written) const { return written ? written : Status(output_.failed(written.error())); }

    OutputFile output_; // removed last
    std::unique_ptr<RowWriter> writer_;
};

bool rowFormat(std::span<const std::byte> bytes)
{
    using namespace std::string_view_literals;
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const auto start : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv, "\x76\x2f\x31\x01"sv, "#?"sv})
        if (head.starts_with(start))
            return true;
    return false;
}

} // namespace

Result<std::unique_ptr<RowReader>> openRows(const fs::path& file, const LoadLimits& limits)
{
    const auto size = usableFileSize(file, SIZE_MAX); // no more than a strip is held
    if (!size)
        return size.error();
    File stream(std::fopen(file.c_str(), "rb"));
    if (!stream)
        return inputError(fmt::format("{}: cannot be opened for reading", file.string()));
    std::array<std::byte, 16> bytes{};
    const std::span head(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), stream.get()));
    if (isPng(head)) {
        if (auto rows = openPng(file, std::move(stream), limits))
            return *std::move(rows);
    } else if (rowFormat(head)) {
        if (!limits.sandbox.program.empty())
            return openRowsSandboxed(file, limits);
        const auto formats = imageFormats();
        if (!formats)
            return Error{formats.error().kind, fmt::format("{}: {}", file.string(), formats.error().message)};
        return (*formats)->openRows(file, head, limits);
    }
    return openWhole(file, limits);
}

Result<std::unique_ptr<RowWriter>> createRows(const fs::path& file, const RowFormat& format, int threads)
{
    const std::string name = file.string();
    if (!writableImage(file))
        return usageError(fmt::format("{}: expected the extension .png .exr .tif .tga .jpg or .hdr, found \"{}\"", name,
                                      file.extension().string()));
    auto output = OutputFile::begin(file);
    if (!output)
        return output.error();
    if (lowerExtension(file) != ".png") {
        const auto formats = imageFormats();
        if (!formats)
            return Error{formats.error().kind, fmt::format("{}: {}", name, formats.error().message)};
        auto writer = (*formats)->createRows(output->path(), format, threads, name);
        if (!writer)
            return output->failed(writer.error());
        return std::unique_ptr<RowWriter>(std::make_unique<OtherOut>(*std::move(output), *std::move(writer)));
    }
    if (format.type == PixelType::float32)
        return usageError(fmt::format("{}: PNG files cannot hold floats", name));
    File stream(std::fopen(output->path().c_str(), "wb"));
    if (!stream)
        return output->failed(outputError(fmt::format("{}: cannot be opened for writing", name)));
    auto rows = std::make_unique<PngOut>(*std::move(output), std::move(stream), name);
    if (Status started = rows->start(format); !started)
        return started.error();
    return std::unique_ptr<RowWriter>(std::move(rows));
}

} // namespace cotan
