#include "cotan/picture.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "picture/option_words.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

constexpr double kRadians = std::numbers::pi / 180;

bool hasEnvironment(const PictureOptions& o) { return o.environment != "none"; }

Background backgroundOf(const PictureOptions& o)
{
    return o.background             ? *o.background
        : !hasEnvironment(o)        ? Background::gradient
        : o.environment == "studio" ? Background::paper
                                    : Background::blurred;
}

// Lights of the built-in environments, rotated with them: in the studio a light in front of the large box on the left,
// in the evening the sun. An overcast sky casts no shadow, and the lights in an environment file are unknown.
std::vector<Light> lampsOf(const PictureOptions& o)
{
    struct Lamp {
        float intensity;
        glm::vec3 color, direction;
    };
    constexpr Named<Lamp> kLamps[] = {{"studio", {3.2f, {1, 0.985f, 0.96f}, {0.62f, -0.9f, -0.7f}}},
                                      {"evening", {4.5f, {1, 0.58f, 0.24f}, {-0.8f, -0.28f, -0.6f}}}};
    const auto lamp = valueOf(kLamps, o.environment);
    if (!lamp)
        return {};
    const glm::vec3 d = glm::normalize(lamp->direction);
    const float c = float(std::cos(o.environmentRotation * kRadians)),
                s = float(std::sin(o.environmentRotation * kRadians));
    return {Light{.color = lamp->color,
                  .intensity = lamp->intensity * o.environmentIntensity,
                  .direction = {c * d.x + s * d.z, d.y, c * d.z - s * d.x}}};
}

} // namespace

std::vector<Light> lightsOf(const PictureOptions& o, const Scene& scene)
{
    if (!scene.lights.empty())
        return scene.lights;
    return hasEnvironment(o) ? lampsOf(o) : defaultLights();
}

std::shared_ptr<const GroundMap> groundOf(const PictureOptions& options, const Scene& scene, const View& view)
{
    if (options.use == PictureUse::data || !options.ground)
        return nullptr;
    GroundOptions groundOptions;
    if (view.ground) // the model moves, not the ground
        groundOptions.height = view.ground->height;
    else if (!scene.reach.empty())
        groundOptions.height = framedBounds(scene).low.y;
    auto map = makeGround(scene, view, groundOptions);
    return map ? std::make_shared<const GroundMap>(std::move(*map)) : nullptr;
}

Result<std::shared_ptr<const EnvironmentMap>> openEnvironmentMap(const PictureOptions& o)
{
    if (!hasEnvironment(o) || o.use == PictureUse::data)
        return std::shared_ptr<const EnvironmentMap>();
    const EnvironmentOptions environmentOptions{.rotation = float(o.environmentRotation * kRadians),
                                                .intensity = o.environmentIntensity};
    if (auto map = builtinEnvironment(o.environment, environmentOptions))
        return std::make_shared<const EnvironmentMap>(std::move(*map));
    if (std::filesystem::path(o.environment).extension().empty())
        return usageError(fmt::format("--environment: expected {}, none, or a .hdr or .exr file; found '{}'",
                                      fmt::join(environmentNames(), ", "), o.environment));
    COTAN_TRY(image, readImage(o.environment, limitsFor(o.memory)));
    COTAN_TRY(map, environmentOfImage(*image, environmentOptions));
    return std::make_shared<const EnvironmentMap>(std::move(*map));
}

double shadowSoftnessOf(const PictureOptions& options)
{
    return options.shadowSoftness.value_or(options.environment == "evening" ? 3 : 10);
}

Status lightPicture(const PictureOptions& options, View& view)
{
    view.exposure = options.exposure.value_or(1.0f);
    const Background background = backgroundOf(options);
    const bool showsMap = background == Background::sharp || background == Background::blurred;
    if (!hasEnvironment(options) && (showsMap || options.environmentRotation != 0 || options.environmentIntensity != 1))
        return usageError(fmt::format("--{}: expected an --environment other than none with it; found none",
                                      showsMap ? "background " + wordOf(kBackgrounds, background)
                                          : options.environmentRotation != 0 ? "environment-rotation"
                                                                             : "environment-intensity"));
    view.toneMapping = options.toneMapping;
    view.shadows = !options.noShadows;
    view.shadowSoftness = float(std::tan(shadowSoftnessOf(options) * kRadians / 2));
    view.background = background != Background::none;
    if (view.background)
        view.backdrop = background == Background::blurred ? Backdrop::blurred
            : background == Background::sharp             ? Backdrop::sharp
            : background == Background::paper             ? Backdrop::paper
                                                          : Backdrop::gradient;
    return Done{};
}

} // namespace cotan
