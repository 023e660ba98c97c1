// cotan.h: normal maps as pixel buffers.
#include <cmath>

#include "call.hpp"
#include "cotan/maps.hpp"
#include "image_views.hpp"

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
        green->confidence = v.confidence == maps::Confidence::certain ? 2
            : v.confidence == maps::Confidence::likely                ? 1
                                                                      : 0;
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
        const Image image = imageOf(map, "map");
        const cotan_image_view& out = output(to_map, "to_map", image);
        maps::RecodeSettings settings;
        settings.from = conventionOf(from, "from");
        settings.type = typeOf(out, "to_map");
        settings.to = storableAs(to, "to", settings.type);
        require((settings.from.kind == MapKind::objectSpace) == (settings.to.kind == MapKind::objectSpace),
                "to: expected a map of the same space; object space needs the mesh");
        maps::RecodeCounts counts;
        put(maps::recode(image, settings, counts), out);
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
        const Image image = imageOf(map, "map");
        require(heights, "heights: expected an array, found null");
        maps::ToHeightSettings settings;
        settings.from = conventionOf(from, "from");
        const maps::Heights made = maps::heightFromNormals(image, settings);
        std::copy(made.texels.begin(), made.texels.end(), heights);
    });
}

cotan_status cotan_map_blend(const cotan_image_view* base, const cotan_image_view* detail, const char* convention,
                             const char* mode, double strength, cotan_image_view* map, char* message,
                             size_t message_size)
{
    return call(message, message_size, [&] {
        const Image under = imageOf(base, "base"), over = imageOf(detail, "detail");
        const cotan_image_view& out = output(map, "map", under);
        require(std::isfinite(strength), "strength: expected a finite number");
        maps::BlendSettings settings;
        settings.type = typeOf(out, "map");
        settings.base = settings.detail = settings.to = storableAs(convention, "convention", settings.type);
        settings.mode = valueOf(kModes, word(mode, "mode"), "mode");
        settings.strength = float(strength);
        std::size_t invalid = 0;
        put(maps::blend(under, over, settings, invalid), out);
    });
}

cotan_status cotan_map_mips(const cotan_image_view* map, const char* convention, double roughness,
                            cotan_take_level take, void* user, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const Image image = imageOf(map, "map");
        require(take, "take: expected a function, found null");
        require(roughness >= 0 && roughness <= 1, "roughness: expected 0 to 1");
        maps::MipSettings settings;
        settings.type = image.type;
        settings.from = settings.to = storableAs(convention, "convention", settings.type);
        settings.roughness = roughness;
        auto levels = maps::mipChain(image, settings);
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const cotan_image_view normals = imageViewOf(levels[i].normals), rough = imageViewOf(levels[i].roughness);
            if (take(user, int(i), &normals, &rough) != 0)
                throw stoppedError();
        }
    });
}
