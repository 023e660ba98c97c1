#include "codecs.hpp"

#include <fmt/format.h>

#include "files/sandbox/process.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "image/checks.hpp"

namespace cotan {

namespace {

Status checkPicture(const Image& image, const std::string& file, const LoadLimits& limits)
{
    if (auto error = checkImageSize(image.width, image.height, image.type, file, limits))
        return *error;
    if (image.channels < 1 || image.channels > 4)
        return inputError(fmt::format("{}: expected 1 to 4 channels, found {}", file, image.channels));
    if (image.data.size() != image.pixelCount() * image.bytesPerPixel())
        return inputError(fmt::format("{}: expected the bytes of {} x {} pixels, found {}", file, image.width,
                                      image.height, image.data.size()));
    return Done{};
}

class SandboxedRows : public RowReader {
public:
    explicit SandboxedRows(std::unique_ptr<ReaderProcess> process) : process_(std::move(process)) {}

    Status readFacts(const std::string& file, const LoadLimits& limits)
    {
        name = file;
        exchangeRowFacts(process_->answer(), *this);
        frame = std::string(frameText(frame));
        if (channels < 1 || channels > 4 || width <= 0 || height <= 0 || width > limits.imageSide
            || height > limits.imageSide)
            process_->answer().refuse();
        return process_->answer().good() ? Status(Done{}) : process_->failure();
    }

    Status read(Image& strip) override
    {
        process_->restartClock();
        process_->question().number(std::int32_t(strip.height));
        if (Status found = process_->await(); !found)
            return found;
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

} // namespace

Result<Image> decodeSandboxed(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    auto process = ReaderProcess::start({.kind = ReaderKind::picture,
                                         .name = name,
                                         .bytes = {bytes.begin(), bytes.end()},
                                         .fileBytes = bytes.size(),
                                         .limits = limits});
    if (!process)
        return process.error();
    Image image;
    exchangeImage((*process)->answer(), image);
    image.frame = std::string(frameText(image.frame));
    if (!(*process)->answer().good())
        return (*process)->failure();
    if (Status sound = checkPicture(image, name, limits); !sound)
        return sound.error();
    return image;
}

Result<std::unique_ptr<RowReader>> openRowsSandboxed(const std::filesystem::path& file, const LoadLimits& limits)
{
    auto process = ReaderProcess::start({.kind = ReaderKind::rows, .name = file.string(), .limits = limits});
    if (!process)
        return process.error();
    auto rows = std::make_unique<SandboxedRows>(*std::move(process));
    if (Status sound = rows->readFacts(file.string(), limits); !sound)
        return sound.error();
    return std::unique_ptr<RowReader>(std::move(rows));
}

} // namespace cotan
