// Views of textures, images and samplers.
#include <array>
#include <cmath>
#include <map>

#include "codes.hpp"
#include "gltf/json/views.hpp"

namespace cotan::gltf {

namespace {

glm::dvec2 pairOr(const Json& object, std::string_view name, const glm::dvec2& otherwise)
{
    const Json* const pair = member(object, name);
    return pair ? glm::dvec2((*pair)[0].get<double>(), (*pair)[1].get<double>()) : otherwise;
}

// KHR_texture_transform: scale, then turn, then shift. The turn is counter-clockwise as seen in
// the image, whose v runs down; so its sine stands in the first row, not in the second. (The
// extension's example, offset (0,1), a quarter turn, scale 1/2, has to select the lower left
// quadrant.) The extension may name another uv set than the texture itself.
void applyTransform(const Json& transform, TextureUse& use)
{
    const glm::dvec2 offset = pairOr(transform, "offset", {0, 0}), scale = pairOr(transform, "scale", {1, 1});
    const double turn = valueOr(transform, "rotation", 0.0), c = std::cos(turn), s = std::sin(turn);
    use.uRow = {c * scale.x, s * scale.y, offset.x};
    use.vRow = {-s * scale.x, c * scale.y, offset.y};
    use.texcoord = valueOr(transform, "texCoord", use.texcoord);
}

struct WrapCode {
    int code;
    Wrap wrap;
};
constexpr std::array kWrapCodes{WrapCode{kRepeat, Wrap::repeat}, WrapCode{kClampToEdge, Wrap::clamp},
                                WrapCode{kMirroredRepeat, Wrap::mirror}};

Wrap wrapOf(int code)
{
    for (const WrapCode& w : kWrapCodes)
        if (w.code == code)
            return w.wrap;
    return Wrap::repeat;
}

int codeOf(Wrap wrap)
{
    for (const WrapCode& w : kWrapCodes)
        if (w.wrap == wrap)
            return w.code;
    return kRepeat;
}

struct MinifyCode {
    int code;
    Filter minify;
    MipFilter mip;
};
constexpr std::array kMinifyCodes{MinifyCode{kNearest, Filter::nearest, MipFilter::none},
                                  MinifyCode{kLinear, Filter::linear, MipFilter::none},
                                  MinifyCode{kNearestMipmapNearest, Filter::nearest, MipFilter::nearest},
                                  MinifyCode{kLinearMipmapNearest, Filter::linear, MipFilter::nearest},
                                  MinifyCode{kNearestMipmapLinear, Filter::nearest, MipFilter::linear},
                                  MinifyCode{kLinearMipmapLinear, Filter::linear, MipFilter::linear}};

} // namespace

TextureUse readTextureUse(const Json* material, std::string_view slot)
{
    TextureUse use;
    const Json* const info = material ? member(*material, slot) : nullptr;
    if (!info)
        return use;
    use.texture = valueOr(*info, "index", -1);
    use.texcoord = valueOr(*info, "texCoord", 0);
    use.scale = valueOr(*info, "scale", 1.0);
    use.strength = valueOr(*info, "strength", 1.0);
    if (const Json* const transform = extension(*info, "KHR_texture_transform"))
        applyTransform(*transform, use);
    return use;
}

Texture readTexture(const Json& texture, std::size_t images)
{
    Texture read;
    read.sampler = valueOr(texture, "sampler", -1);
    read.image = valueOr(texture, "source", -1);
    const Json* const extensions = member(texture, "extensions");
    if (!extensions)
        return read;
    std::map<std::string_view, int> named;
    for (const auto& [name, content] : extensions->items())
        if (const Json* const source = member(content, "source");
            source && source->is_number_unsigned() && source->get<std::size_t>() < images)
            named.emplace(name, source->get<int>());
    if (read.image < 0)
        for (const std::string_view extension : kReadImageExtensions)
            if (const auto found = named.find(extension); found != named.end()) {
                read.image = found->second;
                return read;
            }
    if (!named.empty())
        read.foreign = named.begin()->second;
    return read;
}

Image readImage(const Json& image)
{
    Image read{valueOr(image, "name", std::string()), {}, valueOr(image, "bufferView", -1)};
    if (const Json* const uri = member(image, "uri"))
        read.uri = uri->get_ref<const std::string&>();
    return read;
}

// What the file leaves open becomes linear with mipmaps.
Sampler readSampler(const Json& sampler)
{
    Sampler read;
    read.wrapU = wrapOf(valueOr(sampler, "wrapS", kRepeat));
    read.wrapV = wrapOf(valueOr(sampler, "wrapT", kRepeat));
    if (valueOr(sampler, "magFilter", kLinear) == kNearest)
        read.magnify = Filter::nearest;
    const int code = valueOr(sampler, "minFilter", kLinearMipmapLinear);
    for (const MinifyCode& m : kMinifyCodes)
        if (m.code == code) {
            read.minify = m.minify;
            read.mip = m.mip;
        }
    return read;
}

Json writeSampler(const Sampler& s)
{
    Json sampler = {{"wrapS", codeOf(s.wrapU)}, {"wrapT", codeOf(s.wrapV)}};
    sampler["magFilter"] = s.magnify == Filter::nearest ? kNearest : kLinear;
    for (const MinifyCode& m : kMinifyCodes)
        if (m.minify == s.minify && m.mip == s.mip)
            sampler["minFilter"] = m.code;
    return sampler;
}

std::string frameText(const Json& material)
{
    const Json* const extras = member(material, "extras");
    const Json* const frame = extras && extras->is_object() ? member(*extras, kFrameExtra) : nullptr;
    return !frame ? "" : frame->is_string() ? frame->get<std::string>() : frame->dump();
}

std::string tangentReader(const Json& material)
{
    return extension(material, "KHR_materials_anisotropy") ? "KHR_materials_anisotropy" : "";
}

} // namespace cotan::gltf
