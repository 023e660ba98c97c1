#include "settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/parse_number.hpp"

namespace cotan::viewer {

namespace {

using Options = PictureOptions;

template<class T> std::string numberText(T value) { return fmt::format("{}", value); }

Error wrong(const Setting& s, const std::string& expected, const std::string& found)
{
    return usageError(fmt::format("{}: expected {}; found '{}'", s.name, expected, found));
}

// exposure is a number or a word.
bool numeric(const Setting& s) { return s.high > s.low; }

} // namespace

std::span<const Setting> settings()
{
    static const std::vector<Setting> all = {
        {"exposure", &Options::exposure, {"auto"}, 1e-6, 1e6, true},
        {"tone-mapping", &Options::toneMapping, {"neutral", "aces", "agx", "none"}, 0, 0, true},
        {"environment", &Options::environment, {}, 0, 0, true},
        {"environment-rotation", &Options::environmentRotation, {}, -360, 360},
        {"environment-intensity", &Options::environmentIntensity, {}, 1e-6, 1e6},
        {"background", &Options::background, {"", "paper", "blur", "environment", "gradient", "none"}},
        {"ground", &Options::ground, {"on", "off"}},
        {"shadow-softness", &Options::shadowSoftness, {}, -1, 60}, // below 0: that of the lamp
        {"no-shadows", &Options::noShadows},
        {"no-normal-maps", &Options::noNormalMaps},
        {"point-sampled", &Options::pointSampled},
        {"specular-antialiasing", &Options::specularAntialiasing},
        {"samples", &Options::samples, {"1", "4", "16"}, 1, 16},
        {"edges", &Options::edges, {"none", "triangles", "seams", "all"}},
        {"shading", &Options::shading, {"pbr", "blinn-phong"}},
        {"derivatives", &Options::derivatives, {"fine", "coarse"}},
        {"variant", &Options::variant, {}, 0, 0, false, true},
        {"animation", &Options::animation, {}, 0, 0, false, false, true},
        {"time", &Options::time, {}, 0, 1e6, false, false, true},
        {"shape", &Options::shape, {"", "plane", "sphere", "torus", "teapot"}, 0, 0, false, true},
    };
    return all;
}

const Setting* findSetting(const std::string& name)
{
    for (const Setting& setting : settings())
        if (name == setting.name)
            return &setting;
    return nullptr;
}

std::string valueOf(const Setting& setting, const PictureOptions& options)
{
    return std::visit(
        [&](auto field) -> std::string {
            const auto& value = options.*field;
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
                return value;
            else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, bool>)
                return value ? "on" : "off";
            else
                return numberText(value);
        },
        setting.field);
}

Status setValue(const Setting& s, const std::string& value, PictureOptions& options)
{
    const bool known = std::ranges::find(s.words, value) != s.words.end();
    if (!s.words.empty() && !known && !(numeric(s) && s.words.size() == 1))
        return wrong(s, fmt::format("one of {}", fmt::join(s.words, ", ")), value);
    double number = 0;
    const bool isNumber = parseNumber(std::string_view(value), number) && number >= s.low && number <= s.high;
    if (numeric(s) && !isNumber && !known)
        return wrong(s, fmt::format("a number from {} to {}", s.low, s.high), value);
    return std::visit(
        [&](auto field) -> Status {
            auto& to = options.*field;
            using Value = std::decay_t<decltype(to)>;
            if constexpr (std::is_same_v<Value, std::string>) {
                to = value;
            } else if constexpr (std::is_same_v<Value, bool>) {
                if (value != "on" && value != "off" && value != "toggle")
                    return wrong(s, "on, off or toggle", value);
                to = value == "toggle" ? !to : value == "on";
            } else {
                if (s.words.empty() || known)
                    to = Value(number);
            }
            return Done{};
        },
        s.field);
}

} // namespace cotan::viewer
