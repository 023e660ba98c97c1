// Animations by libwebp's encoder, which keeps what is packed of them in memory.
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include "files/output.hpp"
#include "webp.hpp"

namespace cotan {

namespace {

constexpr float kQuality = 90;

struct Deleter {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

class WebpAnimation : public AnimationWriter {
public:
    WebpAnimation(OutputFile output, const AnimationFormat& format, std::string name)
        : output_(std::move(output)), format_(format), name_(std::move(name))
    {
        WebPAnimEncoderOptions options;
        WebPAnimEncoderOptionsInit(&options);
        options.allow_mixed = 1; // flat pictures are smaller and better without loss
        encoder_.reset(WebPAnimEncoderNew(format.width, format.height, &options));
    }

    Status add(const Image& picture) override
    {
        WebPConfig config;
        WebPPicture pixels;
        if (!encoder_ || !WebPConfigPreset(&config, WEBP_PRESET_PICTURE, kQuality) || !WebPPictureInit(&pixels))
            return failed("not enough memory");
        pixels.use_argb = 1;
        pixels.width = picture.width;
        pixels.height = picture.height;
        const bool added = WebPPictureImportRGBA(&pixels, picture.bytes8(), picture.width * 4)
            && WebPAnimEncoderAdd(encoder_.get(), &pixels, timeOf(count_), &config);
        WebPPictureFree(&pixels);
        if (!added)
            return failed(WebPAnimEncoderGetError(encoder_.get()));
        ++count_;
        return Done{};
    }

    Status finish() override
    {
        WebPData data;
        WebPDataInit(&data);
        const bool made = encoder_ && WebPAnimEncoderAdd(encoder_.get(), nullptr, timeOf(count_), nullptr)
            && WebPAnimEncoderAssemble(encoder_.get(), &data);
        Status written = made ? writeBytes(output_.path(), std::as_bytes(std::span(data.bytes, data.size)))
                              : failed(encoder_ ? WebPAnimEncoderGetError(encoder_.get()) : "not enough memory");
        WebPDataClear(&data);
        if (!written)
            return output_.failed(written.error());
        return output_.commit();
    }

private:
    // Milliseconds at which a picture comes; what is rounded does not add up.
    int timeOf(std::size_t picture) const { return int(std::lround(1000 * double(picture) / format_.rate)); }

    Status failed(const char* why) const
    {
        return outputError(fmt::format("{}: libwebp: {}", name_, std::string(why).empty() ? "failed" : why));
    }

    OutputFile output_;
    AnimationFormat format_;
    std::string name_;
    std::unique_ptr<WebPAnimEncoder, Deleter> encoder_;
    std::size_t count_ = 0;
};

} // namespace

Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(const std::filesystem::path& file,
                                                             const AnimationFormat& format)
{
    auto output = OutputFile::begin(file);
    if (!output)
        return output.error();
    return std::unique_ptr<AnimationWriter>(new WebpAnimation(std::move(*output), format, file.string()));
}

} // namespace cotan
