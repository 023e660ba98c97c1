#include "codecs.hpp"

#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "image/checks.hpp"
#include "png_session.hpp"

namespace cotan {

namespace {

// Decodes all rows into `pixels`, `rowBytes` apart, and reads to the end of the file.
bool readPixels(PngReader& reader, const PngHeader& header, png_bytep pixels, std::size_t rowBytes)
{
    int passes = 1;
    if (!startPngPixels(reader, rowBytes, header.interlaced, passes))
        return false;
    for (int pass = 0; pass < passes; ++pass)
        if (!readPngRows(reader, pixels, header.height, rowBytes))
            return false;
    return endPngPixels(reader);
}

Error pngError(const std::string& name, const PngSession& session)
{
    return inputError(
        fmt::format("{}: broken PNG: expected data that libpng can read, it found: {}", name, session.message));
}

} // namespace

Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    PngReader reader({.next = reinterpret_cast<const png_byte*>(bytes.data()), .left = bytes.size()});
    if (!reader.info)
        return inputError(fmt::format("{}: out of memory", name));
    PngHeader header;
    if (!readPngHeader(reader, header))
        return pngError(name, reader.session);
    if (auto error = checkImageSize(header.width, header.height, header.type, name, limits))
        return *error;

    Image image = makeImage(int(header.width), int(header.height), header.type, name);
    image.frame = reader.session.frame;
    image.channels = header.channels;
    const std::size_t rowBytes = std::size_t(header.width) * image.bytesPerPixel();
    if (!readPixels(reader, header, image.bytes8(), rowBytes))
        return pngError(name, reader.session);
    return image;
}

namespace {

bool writePixels(PngWriter& writer, const Image& image, PngEffort effort)
{
    const std::size_t rowBytes = std::size_t(image.width) * image.bytesPerPixel();
    return startPng(writer, {image.width, image.height, image.type, !isOpaque(image), false, image.frame}, effort)
        && writePngRows(writer, image.bytes8(), std::size_t(image.height), rowBytes) && endPng(writer);
}

// Closes the stream whatever happens.
Status writeTo(std::FILE* out, const Image& image, const std::string& name, PngEffort effort)
{
    bool written = false;
    std::string why = "out of memory";
    {
        PngWriter writer(out);
        if (writer.info) {
            written = writePixels(writer, image, effort);
            why = writer.session.message;
        }
    }
    if (std::fclose(out) != 0 && written) {
        written = false;
        why = "writing failed";
    }
    if (!written)
        return outputError(fmt::format("{}: {}", name, why));
    return Done{};
}

} // namespace

Status writePng(const std::filesystem::path& file, const Image& image, const std::string& name)
{
    std::FILE* out = std::fopen(file.c_str(), "wb");
    if (!out)
        return outputError(fmt::format("{}: cannot be opened for writing", name));
    return writeTo(out, image, name, kQuickPng);
}

Result<std::vector<std::byte>> encodePng(const Image& image)
{
    char* bytes = nullptr;
    std::size_t size = 0;
    std::FILE* out = ::open_memstream(&bytes, &size);
    if (!out)
        return outputError(fmt::format("{}: out of memory", image.name));
    const Status written = writeTo(out, image, image.name, kSmallPng);
    const auto* first = reinterpret_cast<const std::byte*>(bytes);
    std::vector<std::byte> result(first, first + (written ? size : 0));
    std::free(bytes);
    if (!written)
        return written.error();
    return result;
}

namespace {

class PngRows : public RowReader {
public:
    explicit PngRows(File file) : file_(std::move(file)), reader_({.in = file_.get()}) {}

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
        return fine ? Status(Done{}) : pngError(name, reader_.session);
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
        return check(startPng(writer_, format, kQuickPng));
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

std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, File stream,
                                                              const LoadLimits& limits)
{
    std::rewind(stream.get());
    auto rows = std::make_unique<PngRows>(std::move(stream));
    PngHeader header;
    if (!rows->reader().info)
        return inputError(fmt::format("{}: out of memory", file.string()));
    if (!readPngHeader(rows->reader(), header))
        return pngError(file.string(), rows->reader().session);
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
