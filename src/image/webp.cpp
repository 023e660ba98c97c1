#include "webp.hpp"

#include <fmt/format.h>
#include <webp/decode.h>

#include "image/size.hpp"

namespace cotan {

namespace {

const char* reason(VP8StatusCode status)
{
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY: return "not enough memory";
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA: return "the data end too soon";
    default: return "the data are damaged";
    }
}

} // namespace

bool readsWebp() { return true; }

Result<Image> readWebp(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const auto broken = [&](std::string_view why) {
        return inputError(fmt::format("{}: broken webp image: {}", name, why));
    };
    const auto size = checkWebp(bytes);
    if (!size)
        return broken(size.error().message);
    if (auto error = checkImageSize(size->width, size->height, PixelType::unorm8, name, limits))
        return *error;
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config))
        return unavailableError(fmt::format("{}: libwebp is of another version than it was built with", name));
    Image image = makeImage(int(size->width), int(size->height), PixelType::unorm8, name);
    config.output.colorspace = MODE_RGBA; // not multiplied by alpha
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = image.bytes8();
    config.output.u.RGBA.stride = image.width * 4;
    config.output.u.RGBA.size = image.data.size();
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (const VP8StatusCode status = WebPDecode(data, bytes.size(), &config); status != VP8_STATUS_OK)
        return broken(reason(status));
    return image;
}

} // namespace cotan
