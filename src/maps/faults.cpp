#include "cotan/maps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "maps/patches.hpp"

namespace cotan::maps {

namespace {

// Limits on the mean length. Filtering and 8 bits leave over 0.95 on all maps examined (docs/reference/maps.md).
constexpr double kShort = 0.9, kLong = 1.05;
constexpr double kUsableZ = 0.625; // stored: the vector's z is a quarter

bool has(const std::vector<Fault>& faults, Fault::Kind kind)
{
    return std::ranges::any_of(faults, [&](const Fault& f) { return f.kind == kind; });
}

// Formats a length as "0.85 long on average, not 1", without {fmt}, which src/maps does not depend on.
std::string longOnAverage(double length)
{
    const long hundredths = std::lround(100 * length);
    const std::string digits = std::to_string(hundredths % 100);
    return std::to_string(hundredths / 100) + (digits.size() < 2 ? ".0" : ".") + digits + " long on average, not 1";
}

} // namespace

const char* name(Fault::Kind kind)
{
    constexpr const char* kNames[] = {"srgb",         "linearised", "bgr",        "grb",          "washed_out",
                                      "too_strong",   "8_in_16",    "green_down", "two_channels", "slopes",
                                      "object_space", "height",     "no_normals"};
    return textAt(kNames, kind);
}

std::vector<Fault> faultsOf(const NormalStatistics& s, const GreenVerdict* green)
{
    using Kind = Fault::Kind;
    std::vector<Fault> faults;
    const auto add = [&](bool found, Kind kind, std::string text) {
        if (found)
            faults.push_back({kind, std::move(text)});
    };
    const bool normals = s.content != Content::other && s.content != Content::grey;
    add(normals && s.transfer == Transfer::srgb, Kind::srgb,
        "it was saved as a colour, through the sRGB curve: flat is near 188 instead of 128");
    add(normals && s.transfer == Transfer::linearised, Kind::linearised,
        "the sRGB curve was removed from values that never had it: flat is near 55 instead of 128");
    add(normals && s.redIsZ, Kind::redAndBlue,
        "red and blue are exchanged: red points outwards everywhere, blue does not");
    const bool tangentSpace = s.content == Content::tangentSpace && s.transfer == Transfer::linear && !s.redIsZ;
    add(tangentSpace && s.meanLength < kShort, Kind::tooShort,
        "washed out: vectors are " + longOnAverage(s.meanLength));
    add(tangentSpace && s.meanLength > kLong, Kind::tooLong, "too strong: vectors are " + longOnAverage(s.meanLength));
    add(s.eightBits, Kind::eightBitsIn16, "its 16-bit values are all multiples of an 8-bit step");
    add(green && green->swapped == Swapped::yes, Kind::redAndGreen, "red and green are exchanged");
    add(green && green->green == Green::down, Kind::greenDown,
        "green points down (DirectX), which glTF and OpenGL read as dents");
    return faults;
}

std::string contradictionOf(const GreenVerdict& verdict, const Convention& stated)
{
    const NormalStatistics& s = verdict.statistics;
    const bool tangentSpace = stated.kind == MapKind::tangentSpace, certain = verdict.confidence == Confidence::certain;
    if (stated.channels == Channels::xyz) { // otherwise blue may hold anything
        if (s.content == Content::grey || s.content == Content::other)
            return describe(s.content);
        if (tangentSpace && s.content == Content::objectSpace && !s.redIsZ)
            return describe(s.content) + ", not tangent space";
    }
    std::string text;
    using Kind = Fault::Kind;
    for (const Fault& fault : faultsOf(s, certain ? &verdict : nullptr))
        if (fault.kind == Kind::srgb || fault.kind == Kind::linearised
            || (tangentSpace && (fault.kind == Kind::redAndBlue || fault.kind == Kind::redAndGreen)))
            text += (text.empty() ? "" : "; ") + fault.text;
    if (tangentSpace && certain && (verdict.green == Green::up) != stated.greenUp)
        text += (text.empty() ? "" : "; ") + std::string("green points ")
            + (stated.greenUp ? "down, not up" : "up, not down");
    return text;
}

std::string contradictionOf(const Image& map, const Convention& stated)
{
    PatchSampler sample(map.width, map.height, map.type, PatchSampler::kQuickSide);
    sample.add(map, 0);
    return contradictionOf(greenOf(sample), stated);
}

std::vector<Fault> faultsInModel(const NormalStatistics& s, const GreenVerdict* green)
{
    using Kind = Fault::Kind;
    std::vector<Fault> faults = faultsOf(s, green);
    const char* const twoText = s.swizzle == Swizzle::alphaGreen ? "x is in alpha and y in green"
        : s.swizzle == Swizzle::greyAlpha                        ? "x is in red and y in alpha"
                                                                 : "blue is the same everywhere";
    const std::string two = std::string(twoText) + ": only two channels are stored, and glTF reads z from blue";
    // A bright constant blue is a usable z: x and y are then slopes times it.
    const bool lacksZ = s.swizzle != Swizzle::rg || s.highest[2] < kUsableZ;
    switch (s.content) {
    case Content::twoChannel:
    case Content::slopes:
        if (lacksZ)
            faults.push_back({s.content == Content::slopes ? Kind::slopes : Kind::twoChannels, two});
        break;
    case Content::objectSpace:
        if (!s.redIsZ)
            faults.push_back({Kind::objectSpace, "its directions are in object space, and glTF reads tangent space"});
        break;
    case Content::grey: faults.push_back({Kind::height, "it is grey: a height map, not a normal map"}); break;
    case Content::other:
        faults.push_back({Kind::noNormals, "it is no normal map: its vectors have lengths far from 1"});
        break;
    case Content::flat:
        if (s.background == 1)
            faults.push_back({Kind::noNormals, "it is no normal map: it is black or white everywhere"});
        else if (s.mean[2] < 0)
            faults.push_back({Kind::twoChannels, two});
        break;
    default: break;
    }
    return faults;
}

bool changesLight(Fault::Kind kind) { return kind != Fault::Kind::eightBitsIn16; }

std::string noteOf(const NormalStatistics& s)
{
    return s.transparent ? "alpha is 0 everywhere; it is ignored, as glTF ignores alpha of a normal map" : "";
}

std::vector<std::string> mapFaults(const Scene& scene, bool judgeGreen)
{
    std::vector<std::string> sentences;
    std::set<int> seen;
    const auto judge = [&](const Material& m, const Texture& texture, const Convention& format) {
        if (!texture.present() || std::size_t(texture.image) >= scene.images.size()
            || format.kind != MapKind::tangentSpace || format.channels != Channels::xyz
            || !hasPixels(scene.images[std::size_t(texture.image)]) || !seen.insert(texture.image).second)
            return;
        const Image& map = scene.images[std::size_t(texture.image)];
        const std::string name =
            "normal map " + (map.name.empty() ? "image " + std::to_string(texture.image) : map.name);
        const NormalStatistics s = statisticsOfSample(map);
        const bool readUp = format.greenUp && !m.greenReversed; // else read according to its tangents
        const std::optional<GreenVerdict> green =
            judgeGreen && readUp ? std::optional(greenOf(map, AlphaUse::ignored)) : std::nullopt;
        const std::string faults = sentenceOf(name, faultsInModel(s, green ? &*green : nullptr), s);
        if (!faults.empty())
            sentences.push_back(faults);
        if (const std::string note = noteOf(s); !note.empty())
            sentences.push_back(name + ": " + note);
    };
    for (const Material& m : scene.materials) {
        judge(m, m.normalMap, m.normalFormat);
        judge(m, m.coat.normalMap, m.coat.normalFormat);
    }
    return sentences;
}

std::string fixOptions(const std::vector<Fault>& faults, const NormalStatistics& statistics, ReadAs reading)
{
    if (faults.empty())
        return {};
    using Kind = Fault::Kind;
    if (has(faults, Kind::height) || has(faults, Kind::noNormals) || has(faults, Kind::objectSpace))
        return {}; // not converted by `map convert` alone
    const bool down = has(faults, Kind::greenDown);
    const char* const expansion = down && statistics.centre == Centre::biased ? ",biased" : "";
    std::string options = std::string(down ? "--from directx" : "--from gltf") + expansion;
    const bool asStored = reading == ReadAs::file
        && std::ranges::any_of(faults, [](const Fault& fault) { return changesLight(fault.kind); });
    if (has(faults, Kind::slopes) || (asStored && statistics.content == Content::slopes))
        options += ",slope";
    else if (has(faults, Kind::twoChannels) || (asStored && statistics.content == Content::twoChannel))
        options += ",xy";
    for (const Kind kind : {Kind::srgb, Kind::linearised, Kind::redAndBlue, Kind::redAndGreen})
        if (has(faults, kind))
            options += std::string(",") + name(kind);
    options += std::string(down ? " --to opengl" : " --to gltf") + expansion; // with `directx` all codes of red stay
    if (has(faults, Kind::tooShort) || has(faults, Kind::tooLong))
        options += " --normalise";
    if (has(faults, Kind::eightBitsIn16))
        options += " --bits 8";
    return options;
}

Result<FoundMap> findMap(const std::string& subject, const StatedConvention& to,
                         const std::function<Result<GreenVerdict>(const Damage&)>& look)
{
    using Kind = Fault::Kind;
    COTAN_TRY(verdict, look({}));
    const std::vector<Fault> hidden = faultsOf(verdict->statistics); // they hide the direction of green until undone
    Damage damage;
    if (has(hidden, Kind::srgb) || has(hidden, Kind::linearised))
        damage.curve = has(hidden, Kind::srgb) ? Damage::Curve::srgb : Damage::Curve::linearised;
    if (has(hidden, Kind::redAndBlue))
        damage.order = Damage::Order::bgr;
    if (damage.any())
        verdict = look(damage);
    if (!verdict)
        return verdict.error();
    const NormalStatistics& s = verdict->statistics;
    if (verdict->green == Green::undecidable)
        return inputError(subject + ": auto: expected a normal map whose green can be told; found: " + verdict->reason
                          + ". Say how it is stored: opengl or directx");
    if (verdict->swapped == Swapped::yes && damage.order == Damage::Order::rgb)
        damage.order = Damage::Order::grb;
    FoundMap found{Convention{MapKind::tangentSpace, to.convention.expansion, Channels::xyz,
                              verdict->green == Green::up, to.convention.v},
                   to.convention};
    Convention& from = found.from.convention;
    if (s.centre != Centre::unknown)
        from.expansion = s.centre == Centre::biased ? Expansion::biased : Expansion::exact;
    if (s.content == Content::signedValues)
        from.expansion = Expansion::signedValues;
    if (s.content == Content::twoChannel || s.content == Content::slopes)
        from.channels = s.content == Content::slopes ? Channels::slope : Channels::orthographic;
    found.from.damage = damage;
    if (from.expansion == Expansion::biased && !to.expansion)
        found.to.expansion = from.expansion;
    const std::vector<Fault> faults = faultsOf(s); // what green adds is in `from`
    found.normalise = has(faults, Kind::tooShort) || has(faults, Kind::tooLong);
    found.eightBits = has(faults, Kind::eightBitsIn16);
    return found;
}

std::string sentenceOf(const std::string& name, const std::vector<Fault>& faults, const NormalStatistics& statistics)
{
    if (faults.empty())
        return {};
    std::string text = name + ": ";
    for (const Fault& fault : faults)
        text += fault.text + "; ";
    if (has(faults, Fault::Kind::height))
        return text + "cotan map from-height makes a normal map of it.";
    const std::string fix = fixOptions(faults, statistics, ReadAs::glTF);
    if (!fix.empty())
        return text + "cotan map convert " + fix + " fixes it.";
    text.resize(text.size() - 2);
    return text + ".";
}

} // namespace cotan::maps
