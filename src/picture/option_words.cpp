#include "picture/option_words.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/parse_number.hpp"
#include "core/real_number.hpp"
#include "core/value_checks.hpp"

namespace cotan {

std::string sizeWord(const PictureSize& size) { return fmt::format("{}x{}", size.width, size.height); }

Result<PictureSize> parseSize(const std::string& text)
{
    const std::string_view all = text, first = all.substr(0, all.find('x'));
    const std::string_view second = first.size() < all.size() ? all.substr(first.size() + 1) : first;
    PictureSize size;
    if (parseNumber(first, size.width) && parseNumber(second, size.height) && size.fits())
        return size;
    return usageError(
        fmt::format("--size: expected WxH, or one number for both, each from 1 to 16384; found '{}'", text));
}

namespace {

constexpr Named<PictureSize> kSizePresets[] = {{"thumbnail", {320, 180}}, {"720p", {1280, 720}},
                                               {"1080p", {1920, 1080}},   {"1440p", {2560, 1440}},
                                               {"2160p", {3840, 2160}},   {"square", {1024, 1024}}};

// An option. `take` sets it from a word; a flag takes none.
struct Option {
    std::string_view name;
    std::function<Status(const std::string& word)> take;
    bool* flag = nullptr;
    bool given = false;
};

Error wrong(std::string message)
{
    std::ranges::replace(message, '\n', ' '); // errors are one line
    return usageError(std::move(message));
}

Option checked(std::string_view name, ValueCheck check, std::function<void(const std::string& word)> take)
{
    return {name, [name, check = std::move(check), take = std::move(take)](const std::string& word) -> Status {
                if (const std::string why = check ? check(word) : ""; !why.empty())
                    return wrong(std::string(name) + ": " + why);
                take(word);
                return Done{};
            }};
}

Option text(std::string_view name, std::string& value)
{
    return checked(name, {}, [&value](const std::string& word) { value = word; });
}

template<class Value, std::size_t count>
Option choice(std::string_view name, auto& value, const Named<Value> (&words)[count])
{
    return checked(name, wordOf(wordsOf(words)),
                   [&value, &words](const std::string& word) { value = *valueOf(words, word); });
}

template<class Real> Option real(std::string_view name, auto& value, ValueCheck check)
{
    return checked(name, std::move(check), [&value](const std::string& word) { value = Real(*parseReal(word)); });
}

Option whole(std::string_view name, int& value, int least, int most)
{
    return checked(name, wholeNumberWithin(least, most),
                   [&value](const std::string& word) { value = int(std::strtoll(word.c_str(), nullptr, 0)); });
}

Option flag(std::string_view name, bool& value) { return {name, {}, &value}; }

ValueCheck within(const Bounded& bounds) { return numberWithin(bounds.minimum, bounds.maximum); }

std::vector<Option> optionsOf(PictureOptions& o, std::string& frame)
{
    const auto exposure = [&o](const std::string& word) {
        o.exposure.reset();
        if (word != kAutoExposure)
            o.exposure = float(*parseReal(word));
    };
    const auto size = [&o](const std::string& word) -> Status {
        const auto read = parsePictureSize(word);
        if (!read)
            return read.error();
        o.size = *read;
        return Done{};
    };
    return {
        choice("--shape", o.shape, kShapes),
        choice("--up", o.up, kUps),
        whole("--memory", o.memory, 1, kMaxMemory),
        text("--normal-map", o.maps.normal),
        text("--convention", o.maps.convention),
        whole("--material", o.maps.material, -1, kMaxMaterial),
        text("--base-color", o.maps.baseColor),
        text("--metallic-roughness", o.maps.metallicRoughness),
        text("--occlusion", o.maps.occlusion),
        text("--variant", o.variant),
        text("--animation", o.animation),
        real<double>("--time", o.time, within(kMoments)),
        {"--size", size},
        text("--camera", o.camera),
        text("--device", o.device),
        text("--frame", frame),
        real<double>("--max-degrees", o.maxDegrees, within(kChoiceDegrees)),
        checked("--view", wordOf(showNames()), [&o](const std::string& word) { o.show = word; }),
        choice("--edges", o.edges, kEdges),
        choice("--shading", o.shading, kShadings),
        choice("--lighting", o.lighting, kLightings),
        choice("--normal-mapping", o.normalMapping, kNormalMappings),
        choice("--tangents", o.tangents, kTangentOrigins),
        choice("--samples", o.samples, kSampleCounts),
        checked("--exposure", numberAbove0Or(kAutoExposure), exposure),
        choice("--tone-mapping", o.toneMapping, kToneMappings),
        text("--environment", o.environment),
        real<double>("--environment-rotation", o.environmentRotation, within(kRotations)),
        real<float>("--environment-intensity", o.environmentIntensity, numberAbove0()),
        choice("--background", o.background, kBackgrounds),
        choice("--ground", o.ground, kGrounds),
        real<double>("--shadow-softness", o.shadowSoftness, within(kSoftnesses)),
        flag("--no-shadows", o.noShadows),
        choice("--rows", o.rowsUpward, kRows),
        choice("--derivatives", o.derivatives, kDerivatives),
        flag("--no-normal-maps", o.noNormalMaps),
        flag("--specular-antialiasing", o.specularAntialiasing),
        flag("--point-sampled", o.pointSampled),
    };
}

} // namespace

std::vector<std::string> sizePresetWords() { return wordsOf(kSizePresets); }

Result<PictureSize> parsePictureSize(const std::string& text)
{
    if (const auto preset = valueOf(kSizePresets, text))
        return *preset;
    if (auto size = parseSize(text))
        return size;
    return usageError(fmt::format("--size: expected WxH, or one number for both, each from 1 to 16384, or {}; found "
                                  "'{}'",
                                  fmt::join(sizePresetWords(), ", "), text));
}

std::vector<std::string> frameWords()
{
    std::vector<std::string> names;
    for (const FrameInfo& f : frames())
        names.emplace_back(f.name);
    return names;
}

std::string frameNames() { return fmt::format("{}", fmt::join(frameWords(), ", ")); }

Result<FrameChoice> parseFrameChoice(const std::string& text, std::string_view field)
{
    if (text == kAutoFrame)
        return FrameChoice();
    if (const auto frame = frameFromName(text))
        return FrameChoice(*frame);
    return usageError(fmt::format("{}: expected {} or one of {}; found '{}'", field, kAutoFrame, frameNames(), text));
}

// ---- the words of a command line ----------------------------------------------------------

Status readPictureWords(std::span<const std::string> words, PictureOptions& options, std::string& frame)
{
    std::vector<Option> all = optionsOf(options, frame);
    bool onlyModel = false, hasModel = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--" && !onlyModel) {
            onlyModel = true;
            continue;
        }
        if (onlyModel || word.size() < 2 || word[0] != '-') {
            if (std::exchange(hasModel, true))
                return wrong("unexpected word '" + word + "'");
            options.model = word;
            continue;
        }
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const auto option = std::ranges::find(all, name, &Option::name);
        if (option == all.end())
            return wrong("unknown option " + name);
        if (option->flag) {
            if (equals != std::string::npos)
                return wrong(name + " takes no value; found '" + word.substr(equals + 1) + "'");
            *option->flag = true;
            continue;
        }
        if (std::exchange(option->given, true))
            return wrong(name + " is given twice; expected once");
        if (equals == std::string::npos && ++i == words.size())
            return wrong(name + " needs a value");
        if (Status taken = option->take(equals == std::string::npos ? words[i] : word.substr(equals + 1)); !taken)
            return taken;
    }
    return Done{};
}

} // namespace cotan
