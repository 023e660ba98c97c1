// cotan.h: normal maps as pixel buffers.
#include <cmath>

#include "readable_map.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

constexpr Named<maps::BlendMode> kModes[] = {{"reoriented", maps::BlendMode::reoriented},
                                             {"whiteout", maps::BlendMode::whiteout},
                                             {"udn", maps::BlendMode::udn},
                                             {"slopes", maps::BlendMode::slopes},
                                             {"linear", maps::BlendMode::linear}};

} // namespace

cotan_status cotan_map_green(const cotan_image_view* map, cotan_green* green, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        checked(green, "green");
        const maps::GreenVerdict v = maps::greenOf(imageOf(map, "map"));
        green->direction = v.green == maps::Green::up ? 1 : v.green == maps::Green::down ? -1 : 0;
        green->swapped = v.swapped == maps::Swapped::yes ? 1 : v.swapped == maps::Swapped::no ? 0 : -1;
        green->confidence = int(v.confidence); // in the order of cotan.h
        green->agreement = v.agreement;
        copyText(v.reason, green->reason, sizeof green->reason);
    });
}

cotan_status cotan_map_describe(const cotan_image_view* map, cotan_map_info* info, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        checked(info, "info");
        const maps::NormalStatistics s = maps::statisticsOfMap(imageOf(map, "map"));
        copyText(maps::describe(s.content), info->content, sizeof info->content);
        info->zero = s.centre == maps::Centre::exact ? 128 : s.centre == maps::Centre::biased ? 127 : 0;
        info->srgb = s.transfer == maps::Transfer::srgb ? 1 : s.transfer == maps::Transfer::linearised ? -1 : 0;
        info->background = s.background;
        info->invalid = s.invalid;
        info->below_horizon = s.belowHorizon;
        info->mean_length = s.meanLength;
        info->mean_tilt = s.meanTilt;
        std::copy(s.mean.begin(), s.mean.end(), info->mean);
    });
}

cotan_status cotan_map_convert(const cotan_image_view* map, const char* from, const char* to, cotan_image_view* to_map,
                               char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const ReadableMap read = readableMap(map, "map", from, "from", word(to, "to").data(), "to");
        const cotan_image_view& out = output(to_map, "to_map", read.image);
        const PixelType type = typeOf(out, "to_map");
        requireStorable(read.to, "to", type);
        require((read.from.kind == MapKind::objectSpace) == (read.to.kind == MapKind::objectSpace),
                "to: expected a map of the same space; object space needs the mesh");
        maps::RecodeCounts counts;
        put(maps::recode(read.image, {.from = read.from, .to = read.to, .type = type, .normalise = read.normalise},
                         counts),
            out);
    });
}

cotan_status cotan_map_from_height(const cotan_image_view* height, double scale_x, double scale_y, const char* to,
                                   cotan_image_view* map, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const Image image = imageOf(height, "height");
        const cotan_image_view& out = output(map, "map", image);
        require(std::isfinite(scale_x) && std::isfinite(scale_y), "scale_x and scale_y: expected finite numbers");
        maps::FromHeightSettings settings;
        settings.scaleX = scale_x;
        settings.scaleY = scale_y;
        settings.type = typeOf(out, "map");
        settings.to = storableAs(to, "to", settings.type);
        std::size_t invalid = 0;
        put(maps::normalsFromHeight(image, settings, invalid), out);
    });
}

cotan_status cotan_map_to_height(const cotan_image_view* map, const char* from, float* heights, char* message,
                                 size_t message_size)
{
    return call(message, message_size, [&] {
        const ReadableMap read = readableMap(map, "map", from, "from", nullptr, "");
        require(heights, "heights: expected an array, found null");
        maps::ToHeightSettings settings;
        settings.from = read.from;
        const maps::Heights made = maps::heightFromNormals(read.image, settings);
        std::copy(made.texels.begin(), made.texels.end(), heights);
    });
}

cotan_status cotan_map_blend(const cotan_image_view* base, const cotan_image_view* detail, const char* convention,
                             const char* mode, double strength, cotan_image_view* map, char* message,
                             size_t message_size)
{
    return call(message, message_size, [&] {
        const auto read = [&](const cotan_image_view* view, const char* name) {
            return readableMap(view, name, convention, "convention", nullptr, "");
        };
        const ReadableMap under = read(base, "base"), over = read(detail, "detail");
        const cotan_image_view& out = output(map, "map", under.image);
        require(std::isfinite(strength), "strength: expected a finite number");
        maps::BlendSettings settings;
        settings.type = typeOf(out, "map");
        settings.base = settings.to = under.from;
        settings.detail = over.from;
        requireStorable(settings.to, "convention", settings.type);
        settings.mode = valueOf(kModes, word(mode, "mode"), "mode");
        settings.strength = float(strength);
        std::size_t invalid = 0;
        put(maps::blend(under.image, over.image, settings, invalid), out);
    });
}

cotan_status cotan_map_mips(const cotan_image_view* map, const char* convention, double roughness,
                            cotan_take_level take, void* user, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const ReadableMap read = readableMap(map, "map", convention, "convention", nullptr, "");
        require(take, "take: expected a function, found null");
        require(roughness >= 0 && roughness <= 1, "roughness: expected 0 to 1");
        maps::MipSettings settings;
        settings.type = read.image.type;
        settings.from = settings.to = read.from;
        requireStorable(settings.to, "convention", settings.type);
        settings.roughness = roughness;
        auto levels = maps::mipChain(read.image, settings);
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const cotan_image_view normals = imageViewOf(levels[i].normals), rough = imageViewOf(levels[i].roughness);
            if (take(user, int(i), &normals, &rough) != 0)
                throw stoppedError();
        }
    });
}
