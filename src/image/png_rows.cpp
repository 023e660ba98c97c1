#include "png_rows.hpp"

#include <utility>

#include <fmt/format.h>

#include "png_session.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

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
            return inputError(fmt::format("{}: broken PNG: expected data that libpng can read, it found: {}", name,
                                          reader_.session.message));
        return Done{};
    }

private:
    File file_;
    PngReader reader_;
    bool started_ = false;
    int next_ = 0;
};

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
        return check(startPng(writer_, {format.width, format.height, format.type, format.alpha, format.frame.c_str()},
                              kQuickPng));
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
            return output_.failed(outputError(
                fmt::format("{}: expected to write the picture, libpng found: {}", name_, writer_.session.message)));
        return Done{};
    }

    OutputFile output_; // removed last
    File file_;
    PngWriter writer_;
    std::string name_;
};

} // namespace

std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const fs::path& file, File stream,
                                                              const LoadLimits& limits)
{
    std::rewind(stream.get());
    auto rows = std::make_unique<PngRows>(std::move(stream));
    PngHeader header;
    if (!rows->reader().info)
        return inputError(fmt::format("{}: out of memory", file.string()));
    if (!readPngHeader(rows->reader(), header))
        return inputError(fmt::format("{}: broken PNG: expected data that libpng can read, it found: {}", file.string(),
                                      rows->reader().session.message));
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
    rows->channels = header.channels;
    rows->frame = rows->reader().session.frame;
    return std::unique_ptr<RowReader>(std::move(rows));
}

Result<std::unique_ptr<RowWriter>> createPngRows(OutputFile output, const RowFormat& format, const std::string& name)
{
    File stream(std::fopen(output.path().c_str(), "wb"));
    if (!stream)
        return output.failed(outputError(fmt::format("{}: cannot be opened for writing", name)));
    auto rows = std::make_unique<PngOut>(std::move(output), std::move(stream), name);
    if (Status started = rows->start(format); !started)
        return started.error();
    return std::unique_ptr<RowWriter>(std::move(rows));
}

} // namespace cotan
