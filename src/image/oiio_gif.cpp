// Animated GIF by OpenImageIO: one subimage a picture.
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "oiio.hpp"

namespace cotan::oiio {

namespace {

class Gif : public AnimationWriter {
public:
    Gif(std::filesystem::path file, const AnimationFormat& format, std::string name)
        : file_(std::move(file)), name_(std::move(name)), spec_(format.width, format.height, 4, OIIO::TypeDesc::UINT8),
          left_(format.pictures)
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
                if (!output_ || !output_->open(file_.string(), int(left_), all.data()))
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

    Status finish() override { return output_ && output_->close() ? Status(Done{}) : failed(); }

private:
    Status failed() const
    {
        return outputError(fmt::format("{}: {}", name_, oneLine(output_ ? output_->geterror() : OIIO::geterror())));
    }

    std::filesystem::path file_;
    std::string name_;
    OIIO::ImageSpec spec_;
    std::size_t left_;
    std::unique_ptr<OIIO::ImageOutput> output_;
};

} // namespace

Result<std::unique_ptr<AnimationWriter>> createGif(const std::filesystem::path& file, const AnimationFormat& format,
                                                   const std::string& name)
{
    return std::unique_ptr<AnimationWriter>(new Gif(file, format, name));
}

} // namespace cotan::oiio
