#include "cotan/image.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "codecs.hpp"
#include "files/output.hpp"
#include "formats.hpp"
#include "image/component_types.hpp"
#include "image/format_table.hpp"

namespace cotan {

namespace {

bool isGif(const std::filesystem::path& file)
{
    const ImageFormat* const format = imageFormatOf(file);
    return format && format->name == "GIF";
}

// Of 8 bits, whatever comes; writer: writes to the output's path.
class EightBits : public AnimationWriter {
public:
    EightBits(OutputFile output, std::unique_ptr<AnimationWriter> writer, AnimationFormat format, std::string name)
        : output_(std::move(output)), writer_(std::move(writer)), format_(format), name_(std::move(name))
    {
    }

    Status add(const Image& picture) override
    {
        if (picture.width != format_.width || picture.height != format_.height)
            return outputError(fmt::format("{}: expected pictures of {} x {}; found {} x {}", name_, format_.width,
                                           format_.height, picture.width, picture.height));
        return told(picture.type == PixelType::unorm8 ? writer_->add(picture) : writer_->add(toUnorm8(picture)));
    }

    Status finish() override
    {
        Status done = told(writer_->finish());
        return done ? output_.commit() : done;
    }

private:
    Status told(Status status) const { return status ? status : Status(output_.failed(status.error())); }

    OutputFile output_; // removed last
    std::unique_ptr<AnimationWriter> writer_;
    AnimationFormat format_;
    std::string name_;
};

Status checkFormat(const std::filesystem::path& file, const AnimationFormat& format)
{
    const int most = isGif(file) ? 65535 : 16383;
    if (format.width < 1 || format.height < 1 || format.width > most || format.height > most)
        return usageError(fmt::format("{}: expected a picture of 1 to {} pixels a side; found {} x {}", file.string(),
                                      most, format.width, format.height));
    const double fastest = isGif(file) ? 50 : 1000;
    if (!(format.rate > 0) || format.rate > fastest)
        return usageError(fmt::format("{}: expected at most {:.0f} pictures a second in such a file; found {:g}",
                                      file.string(), fastest, format.rate));
    return Done{};
}

} // namespace

bool isAnimation(const std::filesystem::path& file) { return imageFormatHas(file, &ImageFormat::animation); }

double animationRate(const std::filesystem::path& file, double rate)
{
    return isGif(file) ? 100 / std::max(std::round(100 / rate), 1.0) : rate;
}

Result<std::unique_ptr<AnimationWriter>> createAnimation(const std::filesystem::path& file,
                                                         const AnimationFormat& format)
{
    if (Status fits = checkFormat(file, format); !fits)
        return fits.error();
    const std::string name = file.string();
    const auto formats = isGif(file) ? imageFormats(name) : nullptr;
    if (!formats)
        return formats.error();
    auto output = OutputFile::begin(file);
    if (!output)
        return output.error();
    AnimationFormat rounded = format;
    rounded.rate = animationRate(file, format.rate);
    auto writer = isGif(file) ? (*formats)->createGif(output->path(), rounded, name)
                              : createWebpAnimation(output->path(), rounded, name);
    if (!writer)
        return output->failed(writer.error());
    return std::unique_ptr<AnimationWriter>(new EightBits(std::move(*output), std::move(*writer), format, name));
}

} // namespace cotan
