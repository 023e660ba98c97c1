// Images in parts: by rows, and as frames of animations.
#include "cotan/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "codecs.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"
#include "files/sandbox/reader_process.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "files/system/system.hpp"
#include "formats.hpp"
#include "image/checks.hpp"
#include "image/component_types.hpp"
#include "image/format_table.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

// Whether any alpha is not 1, also for floats, which isOpaque ignores.
bool usesAlpha(const Image& image)
{
    if (image.type != PixelType::float32)
        return !isOpaque(image);
    for (std::size_t i = 3; i < 4 * image.pixelCount(); i += 4)
        if (image.floats()[i] != 1.0f)
            return true;
    return false;
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
        frame = image_.frame;
        channels = image_.channels;
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

class SandboxedRows : public RowReader {
public:
    explicit SandboxedRows(std::unique_ptr<ReaderProcess> process) : process_(std::move(process)) {}

    Status read(Image& strip) override
    {
        process_->restartClock();
        process_->question().number(std::int32_t(strip.height));
        COTAN_CHECK(process_->await());
        const std::size_t expected = strip.data.size();
        process_->answer().array(strip.data);
        if (strip.data.size() != expected)
            process_->answer().refuse();
        strip.data.resize(expected);
        return process_->answer().good() ? Status(Done{}) : process_->failure();
    }

private:
    std::unique_ptr<ReaderProcess> process_;
};

// Opens rows in a child process: limits.sandbox.program.
Result<std::unique_ptr<RowReader>> openRowsSandboxed(const std::filesystem::path& file, const LoadLimits& limits)
{
    COTAN_TRY(process, ReaderProcess::start({.kind = ReaderKind::rows, .name = file.string(), .limits = limits}));
    ReaderProcess& reader = **process;
    auto rows = std::make_unique<SandboxedRows>(*std::move(process));
    rows->name = file.string();
    exchangeRowFacts(reader.answer(), *rows);
    rows->frame = std::string(frameText(rows->frame));
    if (rows->channels < 1 || rows->channels > 4 || rows->width <= 0 || rows->height <= 0
        || rows->width > limits.imageSide || rows->height > limits.imageSide)
        reader.answer().refuse();
    if (!reader.answer().good())
        return reader.failure();
    return std::unique_ptr<RowReader>(std::move(rows));
}

// Forwards to a writer of the temporary file of `output`, and commits the file when it is complete.
template<class Writer> class OutputWriter : public Writer {
public:
    OutputWriter(OutputFile output, std::unique_ptr<Writer> writer)
        : output_(std::move(output)), writer_(std::move(writer))
    {
    }

    Status finish() override
    {
        Status done = checked(writer_->finish());
        return done ? output_.commit() : done;
    }

protected:
    Status checked(Status status) const { return status ? status : Status(output_.failed(status.error())); }

    OutputFile output_; // destroyed last
    std::unique_ptr<Writer> writer_;
};

class OutputRows : public OutputWriter<RowWriter> {
public:
    using OutputWriter::OutputWriter;

    Status write(const Image& strip) override { return checked(writer_->write(strip)); }
};

// Checks the decoded size against a limit that grows with the file size: every row takes time to decode.
Status checkRows(const RowReader& rows, std::size_t fileBytes, const LoadLimits& limits)
{
    const double maximum = double(limits.imageBytes) + 128 * double(fileBytes);
    const double bytes = 4.0 * double(bytesPerComponent(rows.type)) * rows.width * rows.height;
    if (bytes > maximum)
        return memoryError(
            fmt::format("{}: {} x {} pixels take {:.0f} bytes, the limit is {:.0f} for a file of {} bytes", rows.name,
                        rows.width, rows.height, bytes, maximum, fileBytes));
    return Done{};
}

Result<std::unique_ptr<RowReader>> openAnyRows(const fs::path& file, const LoadLimits& limits)
{
    OpenFile stream(openStream(file, "rb"));
    if (!stream)
        return inputError(fmt::format("{}: cannot be opened for reading", file.string()));
    std::array<std::byte, 16> bytes{};
    const std::span head(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), stream.get()));
    if (isPng(head)) {
        if (auto rows = openPngRows(file, std::move(stream), limits))
            return *std::move(rows);
    } else if (const ImageFormat* const known = imageFormatOf(head); known && known->readsRows) {
        if (!limits.sandbox.program.empty())
            return openRowsSandboxed(file, limits);
        const auto formats = imageFormats(file.string());
        return formats ? (*formats)->openRows(file, head, limits) : formats.error();
    }
    COTAN_TRY(image, readImage(file, limits));
    return std::unique_ptr<RowReader>(std::make_unique<WholeRows>(*std::move(image)));
}

} // namespace

Result<std::unique_ptr<RowReader>> openRows(const fs::path& file, const LoadLimits& limits)
{
    const auto size = usableFileSize(file, SIZE_MAX); // any size: only a strip is held in memory
    if (!size)
        return size.error();
    auto rows = openAnyRows(file, limits);
    if (rows)
        COTAN_CHECK(checkRows(**rows, *size, limits));
    return rows;
}

Result<std::unique_ptr<RowWriter>> createRows(const fs::path& file, const RowFormat& format, int threads)
{
    const std::string name = file.string();
    COTAN_CHECK(checkImageName(file));
    COTAN_TRY(output, OutputFile::begin(file));
    const auto create = [&]() -> Result<std::unique_ptr<RowWriter>> {
        if (writesItself(file) && format.type == PixelType::float32)
            return usageError(fmt::format("{}: PNG files cannot hold floats", name));
        const bool png = writesItself(file);
        const Result<const ImageFormats*> formats = png ? nullptr : imageFormats(name);
        if (!formats)
            return formats.error();
        COTAN_TRY(stream, output->open(/*reads*/ !png));
        return png ? createPngRows(*std::move(stream), format, name)
                   : (*formats)->createRows(*std::move(stream), format, threads, name);
    };
    auto writer = create();
    if (!writer)
        return output->failed(writer.error());
    return std::unique_ptr<RowWriter>(std::make_unique<OutputRows>(*std::move(output), *std::move(writer)));
}

// ---- animations ----------------------------------------------------------------------------

namespace {

bool isGif(const fs::path& file)
{
    const ImageFormat* const format = imageFormatOf(file);
    return format && format->name == "GIF";
}

// Converts images to 8 bits.
class EightBits : public OutputWriter<AnimationWriter> {
public:
    EightBits(OutputFile output, std::unique_ptr<AnimationWriter> writer, AnimationFormat format, std::string name)
        : OutputWriter(std::move(output), std::move(writer)), format_(format), name_(std::move(name))
    {
    }

    Status add(const Image& image) override
    {
        if (image.width != format_.width || image.height != format_.height)
            return outputError(fmt::format("{}: expected images of {} x {}; found {} x {}", name_, format_.width,
                                           format_.height, image.width, image.height));
        return checked(image.type == PixelType::unorm8 ? writer_->add(image) : writer_->add(toUnorm8(image)));
    }

private:
    AnimationFormat format_;
    std::string name_;
};

Status checkFormat(const fs::path& file, const AnimationFormat& format)
{
    const int maximum = isGif(file) ? 65535 : 16383;
    if (format.width < 1 || format.height < 1 || format.width > maximum || format.height > maximum)
        return usageError(fmt::format("{}: expected an image of 1 to {} pixels per side; found {} x {}", file.string(),
                                      maximum, format.width, format.height));
    const double fastest = isGif(file) ? 50 : 1000;
    if (!(format.rate > 0) || format.rate > fastest)
        return usageError(fmt::format("{}: expected at most {:.0f} images per second in such a file; found {:g}",
                                      file.string(), fastest, format.rate));
    return Done{};
}

} // namespace

bool isAnimation(const fs::path& file) { return imageFormatHas(file, &ImageFormat::animation); }

double animationRate(const fs::path& file, double rate)
{
    return isGif(file) ? 100 / std::max(std::round(100 / rate), 1.0) : rate;
}

Result<std::unique_ptr<AnimationWriter>> createAnimation(const fs::path& file, const AnimationFormat& format)
{
    COTAN_CHECK(checkFormat(file, format));
    const std::string name = file.string();
    COTAN_TRY(formats, isGif(file) ? imageFormats(name) : nullptr);
    COTAN_TRY(output, OutputFile::begin(file));
    AnimationFormat rounded = format;
    rounded.rate = animationRate(file, format.rate);
    COTAN_TRY(stream, output->open(/*reads*/ isGif(file)));
    auto writer = isGif(file) ? (*formats)->createGif(*std::move(stream), rounded, name)
                              : createWebpAnimation(*std::move(stream), rounded, name);
    if (!writer)
        return output->failed(writer.error());
    return std::unique_ptr<AnimationWriter>(new EightBits(std::move(*output), std::move(*writer), format, name));
}

} // namespace cotan
