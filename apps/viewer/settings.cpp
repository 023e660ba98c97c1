#include "settings.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/parse_number.hpp"
#include "picture/option_words.hpp"

namespace cotan::viewer {

namespace {

using Options = PictureOptions;
using After = Setting::After;

// A setting with named values. Optional and text fields also accept the empty word.
template<class Value, std::size_t count>
Setting choice(const char* name, auto Options::*field, const Named<Value> (&all)[count], After after = After::nothing)
{
    using Field = std::decay_t<decltype(Options().*field)>;
    std::vector<std::string> words = wordsOf(all);
    if (!std::is_scalar_v<Field>)
        words.insert(words.begin(), "");
    const auto get = [field, &all](const Options& o) { return wordOf(all, o.*field); };
    const auto set = [field, &all, words](Options& o, const std::string& word) {
        if (std::ranges::find(words, word) == words.end())
            return false;
        const auto value = cotan::valueOf(all, word);
        o.*field = value ? Field(*value) : Field();
        return true;
    };
    return {name, get, set, after, false, fmt::format("one of {}", fmt::join(words, ", ")), words};
}

Setting text(const char* name, std::string Options::*field, After after)
{
    const auto get = [field](const Options& o) { return o.*field; };
    const auto set = [field](Options& o, const std::string& word) {
        o.*field = word;
        return true;
    };
    return {name, get, set, after};
}

Setting flag(const char* name, bool Options::*field)
{
    const auto get = [field](const Options& o) { return std::string(o.*field ? "on" : "off"); };
    const auto set = [field](Options& o, const std::string& word) {
        if (word != "on" && word != "off" && word != "toggle")
            return false;
        o.*field = word == "toggle" ? !(o.*field) : word == "on";
        return true;
    };
    return {name, get, set, After::nothing, true, "on, off or toggle"};
}

// none: the word for an empty optional; negative numbers empty it too.
template<class Field>
Setting number(const char* name, Field Options::*field, const Bounded& bounds, After after = After::nothing,
               const std::string& none = "")
{
    constexpr bool mayBeNone = requires(Field f) { f.reset(); };
    const auto get = [field, none](const Options& o) {
        if constexpr (mayBeNone)
            return o.*field ? fmt::format("{}", *(o.*field)) : none;
        else
            return fmt::format("{}", o.*field);
    };
    const auto set = [field, bounds, none](Options& o, const std::string& word) {
        double value = -1;
        const bool known = mayBeNone && word == none;
        if (!known
            && !(parseNumber(std::string_view(word), value) && value >= bounds.minimum && value <= bounds.maximum))
            return false;
        if constexpr (mayBeNone)
            o.*field = value < 0 ? Field() : Field(typename Field::value_type(value));
        else
            o.*field = Field(value);
        return true;
    };
    return {name, get, set, after, false, fmt::format("a number from {} to {}", bounds.minimum, bounds.maximum)};
}

} // namespace

std::span<const Setting> settings()
{
    constexpr Bounded kFactors = {1e-6, 1e6}, kSoftnessOrNone = {-1, kSoftnesses.maximum};
    static const std::vector<Setting> all = {
        number("exposure", &Options::exposure, kFactors, After::metering, kAutoExposure),
        choice("tone-mapping", &Options::toneMapping, kToneMappings, After::metering),
        text("environment", &Options::environment, After::metering),
        number("environment-rotation", &Options::environmentRotation, kRotations),
        number("environment-intensity", &Options::environmentIntensity, kFactors),
        choice("background", &Options::background, kBackgrounds),
        choice("ground", &Options::ground, kGrounds),
        number("shadow-softness", &Options::shadowSoftness, kSoftnessOrNone, After::nothing, "-1"),
        flag("no-shadows", &Options::noShadows),
        flag("no-normal-maps", &Options::noNormalMaps),
        flag("point-sampled", &Options::pointSampled),
        flag("specular-antialiasing", &Options::specularAntialiasing),
        choice("samples", &Options::samples, kSampleCounts),
        choice("edges", &Options::edges, kEdges),
        choice("shading", &Options::shading, kShadings),
        choice("derivatives", &Options::derivatives, kDerivatives),
        text("variant", &Options::variant, After::loading),
        text("animation", &Options::animation, After::posing),
        number("time", &Options::time, kMoments, After::posing),
        choice("shape", &Options::shape, kShapes, After::loading),
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

std::string valueOf(const Setting& setting, const PictureOptions& options) { return setting.get(options); }

Status setValue(const Setting& setting, const std::string& value, PictureOptions& options)
{
    if (setting.set(options, value))
        return Done{};
    return usageError(fmt::format("{}: expected {}; found '{}'", setting.name, setting.expected, value));
}

} // namespace cotan::viewer
