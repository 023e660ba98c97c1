#include "picture/option_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <type_traits>

#include <fmt/format.h>

#include "core/real_number.hpp"
#include "cotan/convention.hpp"

namespace cotan {

std::string upHelp(const std::string& what)
{
    return "axis of " + what
        + " that points up: y; or z, as in PLY and STL of Blender and CAD, which rotates it by 90 degrees about x";
}

std::string memoryHelp(const std::string& also)
{
    return "largest image to hold in memory" + also
        + ", in MiB; all images together may take 192 MiB (above 640: the given MiB) and 128 times the size of their "
          "files";
}

std::string deviceHelp(const std::string& use) { return use + "auto, reference, or part of a Vulkan device's name"; }

namespace {

using Options = PictureOptions;

// "thumbnail (320x180), 720p (1280x720), ... or square (1024x1024)"
std::string sizePresetNames()
{
    std::vector<std::string> names = sizePresetWords();
    for (std::string& name : names)
        if (const auto size = parsePictureSize(name))
            name += fmt::format(" ({})", sizeWord(*size));
    return eitherOf(names);
}

// ---- kinds of options. `field` gives the value that an option sets: a member, or a function ------

template<class Field> auto access(Field field)
{
    return [field](auto& o) -> auto&
    {
        if constexpr (std::is_member_pointer_v<Field>)
            return o.*field;
        else
            return field(o);
    };
}

template<class Field>
PictureOption text(std::string name, HelpGroup group, std::string unit, Field field, std::string help)
{
    const auto value = access(field);
    return {std::move(name),
            group,
            std::move(unit),
            std::move(help),
            [value](const Options& o) { return value(o); },
            [value](Options& o, const std::string& word) { value(o) = word; }};
}

template<class Field> PictureOption file(std::string name, Field field, std::string help)
{
    PictureOption option = text(std::move(name), HelpGroup::input, "FILE", field, std::move(help));
    option.reads = true;
    return option;
}

template<class Field, class Value, std::size_t count>
PictureOption choice(std::string name, HelpGroup group, Field field, const Named<Value> (&all)[count], std::string help,
                     std::string unit = "NAME")
{
    const auto get = [field, &all](const Options& o) { return wordOf(all, o.*field); };
    const auto set = [field, &all](Options& o, const std::string& word) {
        const auto value = valueOf(all, word);
        using Type = std::decay_t<decltype(o.*field)>;
        o.*field = value ? Type(*value) : Type();
    };
    return {std::move(name),
            group,
            std::move(unit),
            std::move(help),
            get,
            set,
            wordOf(wordsOf(all)),
            wordsOf(all),
            {},
            true};
}

// A number, in `bounds` if it has any, else above 0. Field: also an optional one; `none` is the word for no value.
template<class Field>
PictureOption number(std::string name, HelpGroup group, std::string unit, Field field, std::optional<Bounded> bounds,
                     std::string help, const std::string& none = "")
{
    const auto value = access(field);
    using Value = std::decay_t<decltype(value(std::declval<Options&>()))>;
    constexpr bool mayBeNone = requires(Value v) { v.reset(); };
    const auto get = [value, none](const Options& o) {
        if constexpr (mayBeNone)
            return value(o) ? fmt::format("{}", *value(o)) : none;
        else
            return fmt::format("{}", value(o));
    };
    const auto set = [value, none](Options& o, const std::string& word) {
        if constexpr (mayBeNone)
            value(o) = word == none ? Value() : Value(typename Value::value_type(*parseReal(word)));
        else if constexpr (std::is_integral_v<Value>)
            value(o) = Value(std::strtoll(word.c_str(), nullptr, 0));
        else
            value(o) = Value(*parseReal(word));
    };
    ValueCheck check = std::is_integral_v<Value>
        ? wholeNumberWithin((long long)(bounds->minimum), (long long)(bounds->maximum))
        : bounds       ? numberWithin(bounds->minimum, bounds->maximum)
        : none.empty() ? numberAbove0()
                       : numberAbove0Or(none);
    PictureOption option{std::move(name), group, std::move(unit), std::move(help), get, set, std::move(check)};
    option.range = bounds;
    return option;
}

PictureOption flag(std::string name, HelpGroup group, bool Options::*field, std::string help)
{
    PictureOption option{std::move(name),
                         group,
                         "",
                         std::move(help),
                         [field](const Options& o) { return std::string(o.*field ? "on" : "off"); },
                         [field](Options& o, const std::string& word) { o.*field = word == "on"; }};
    option.flag = field;
    return option;
}

PictureOption offering(PictureOption option, std::vector<std::string> words)
{
    option.words = std::move(words);
    return option;
}

PictureOption size()
{
    const auto check = [](const std::string& word) {
        return parsePictureSize(word) ? "" : expectedSize(sizePresetWords(), word);
    };
    PictureOption option{"size",
                         HelpGroup::main,
                         "WxH",
                         "width and height in pixels; 512 is 512x512; or " + sizePresetNames(),
                         [](const Options& o) { return sizeWord(o.size); },
                         [](Options& o, const std::string& word) { o.size = *parsePictureSize(word); },
                         check};
    return offering(std::move(option), sizePresetWords());
}

PictureOption view()
{
    PictureOption option =
        text("view", HelpGroup::main, "NAME", &Options::show,
             "what to draw: shaded; normal, tangent, bitangent, uv, depth; error (degrees from the frame that the maps "
             "are for); clay, gloss (the relief alone); checker, density, stretch, shear, mirrored (uv and texels), w "
             "(of stored tangents), facing; or one map by itself: base-color, alpha, normal-map, normal-map-red, "
             "normal-map-green, normal-map-blue, roughness, metallic, occlusion, emissive, mask (--mask)");
    option.check = wordOf(showNames());
    option.closed = true;
    return offering(std::move(option), showNames());
}

// The member of PictureOptions::maps.
auto map(auto OwnMaps::*member)
{
    return [member](auto& o) -> auto& { return o.maps.*member; };
}

std::vector<PictureOption> makeTable()
{
    using enum HelpGroup;
    return {
        choice("shape", input, &Options::shape, kShapes,
               "without MODEL: shape to show maps on: plane, sphere, torus or teapot"),
        choice("up", input, &Options::up, kUps, upHelp("the model's file")),
        number("memory", general, "MIB", &Options::memory, Bounded{1, kMaxMemory}, memoryHelp("")),
        file("normal-map", map(&OwnMaps::normal), "image that replaces the model's normal maps, such as a new bake"),
        offering(
            text("convention", input, "WORDS", map(&OwnMaps::convention),
                 "how that image is stored (default: gltf,exact) or, without one, how to decode the model's own normal "
                 "maps (default: as the model says): "
                     + conventionWords()),
            conventionWordList()),
        number("material", input, "N", map(&OwnMaps::material), Bounded{-1, kMaxMaterial},
               "number of the material that gets this image; -1: all"),
        file("base-color", map(&OwnMaps::baseColor), "image that replaces the model's colours, sRGB"),
        file("metallic-roughness", map(&OwnMaps::metallicRoughness),
             "image that replaces the model's roughness (green) and metallic (blue), as glTF has them"),
        file("occlusion", map(&OwnMaps::occlusion), "image that replaces the model's ambient occlusion (red)"),
        file("height-map", map(&OwnMaps::height),
             "image of heights (red): white is the surface, black lies --height-depth below it. Maps are drawn where "
             "the line of sight meets the heights, which shadow each other"),
        file("mask", map(&OwnMaps::mask), "image that bake --mask wrote, for --view mask"),
        number("height-depth", input, "D", map(&OwnMaps::heightDepth), kHeightDepths,
               "how far black lies below white, or the lowest of a file of floats below its highest, in the model's "
               "units (default: floats, as bake --kind height writes them, have this unit; else 2 % of the model's "
               "diagonal)"),
        text("variant", input, "NAME|N", &Options::variant,
             "variant of a glTF model's materials, by name or number; those of the file if left out"),
        text("animation", input, "NAME|N", &Options::animation,
             "animation of a glTF model, by name or number; the pose of the file if left out"),
        number("time", input, "S", &Options::time, kMoments, "moment of --animation, in seconds from its start"),
        size(),
        offering(text("camera", main, "CAMERA", &Options::camera,
                      "where to look from: front (a little from the right and above), left, right, top, bottom, back, "
                      "or orbit:AZ,EL (degrees around and above), each so near that the model fills the image; fit "
                      "(farther: the whole bounding box); the number of a camera in the file; or eye and target "
                      "\"ex,ey,ez,tx,ty,tz\" in world units, then \",DEGREES\" for a field of view other than 45 or "
                      "\",hX\" for an orthographic view X units high, then \",ux,uy,uz\" for the up direction "
                      "(default: front; the built-in scene's own)"),
                 {"front", "left", "right", "top", "bottom", "back", "fit"}),
        offering(text("device", general, "DEVICE", &Options::device, deviceHelp("device that draws: ")),
                 {"auto", "reference"}),
        choice("edges", diagnostics, &Options::edges, kEdges,
               "lines over the image: none, triangles, seams (of uv: yellow; mirrored: magenta; borders: cyan) or all"),
        choice("shading", look, &Options::shading, kShadings, "shading model: pbr or blinn-phong"),
        choice("tangents", frame, &Options::tangents, kTangentOrigins,
               "for frames of tangents (mikktspace, area-weighted, vertex): stored (as in the file, generated where "
               "missing) or generated"),
        number("max-degrees", frame, "D", &Options::maxDegrees, kChoiceDegrees,
               "error of normals, on average over a part of a model, that its frame may cause; ten times as much on "
               "1 % of its area"),
        choice("samples", look, &Options::samples, kSampleCounts,
               "samples per pixel of the shaded image: 1; 4 for smooth edges; or 16, each shaded separately, for "
               "smooth highlights too, at the cost of 16 images",
               "N"),
        offering(number("exposure", light, "X|auto", &Options::exposure, {},
                        "factor on all light, or auto: from the brightness of the model (1 in files that keep floats)",
                        kAutoExposure),
                 {kAutoExposure}),
        choice("tone-mapping", look, &Options::toneMapping, kToneMappings,
               "curve from light to displayed colour: none (clamped to 1), neutral (Khronos PBR Neutral), aces "
               "(Narkowicz's) or agx; files that keep floats stay linear"),
        [] {
            PictureOption option =
                text("environment", light, "NAME|FILE", &Options::environment,
                     "environment that lights the model: studio and evening (with a lamp and a sun, for models without "
                     "lights), overcast, or a .hdr or .exr file in equirectangular projection; or none: a formula and "
                     "a lamp");
            option.reads = true;
            return offering(std::move(option), {"studio", "overcast", "evening", "none"});
        }(),
        number("environment-rotation", light, "DEGREES", &Options::environmentRotation, kRotations,
               "rotate the environment counter-clockwise, seen from above"),
        number("environment-intensity", light, "X", &Options::environmentIntensity, {},
               "factor on the light of the environment"),
        choice("background", look, &Options::background, kBackgrounds,
               "what is behind the model: paper (a photographer's; the default in the studio), blur (the environment "
               "out of focus; the default in others), environment, gradient (the default without one), or none "
               "(transparent)"),
        choice("ground", light, &Options::ground, kGrounds,
               "on: the model stands on level ground, which only shows its shadow; off: it floats"),
        number("shadow-softness", light, "DEGREES", &Options::shadowSoftness, kSoftnesses,
               "angle that the shadow-casting light subtends: 0 for sharp edges, 0.5 for the sun (default: 10, in the "
               "evening 3)"),
        flag("no-shadows", light, &Options::noShadows, "draw no shadows of lights"),
        flag("no-normal-maps", diagnostics, &Options::noNormalMaps, "use interpolated normals only"),
        flag("specular-antialiasing", look, &Options::specularAntialiasing,
             "light 16 to 256 normals per pixel, more for sharper highlights, each roughened by the detail below its "
             "spacing"),
        flag("point-sampled", diagnostics, &Options::pointSampled,
             "read the nearest texel of the finest level, for comparing devices"),
        view(),
    };
}

Error wrong(std::string message)
{
    std::ranges::replace(message, '\n', ' '); // errors are one line
    return usageError(std::move(message));
}

std::string unknownOption(const std::string& name)
{
    for (const auto& [removed, why] : removedPictureOptions())
        if (name == fmt::format("--{}", removed))
            return fmt::format("unknown option {}: {}", name, why);
    return "unknown option " + name;
}

} // namespace

std::span<const PictureOption> pictureOptions()
{
    static const std::vector<PictureOption> table = makeTable();
    return table;
}

const PictureOption* findPictureOption(std::string_view name)
{
    const auto found = std::ranges::find(pictureOptions(), name, &PictureOption::name);
    return found == pictureOptions().end() ? nullptr : &*found;
}

std::span<const std::pair<std::string_view, std::string_view>> removedPictureOptions()
{
    static constexpr std::pair<std::string_view, std::string_view> kRemoved[] = {
        {"lighting", "lights are always evaluated in world space"},
        {"normal-mapping", "lights and the environment always meet the perturbed normal"},
        {"rows", "rows always run down"},
        {"derivatives", "derivatives are always fine"}};
    return kRemoved;
}

Status setOption(const PictureOption& option, const std::string& word, PictureOptions& options)
{
    if (const std::string why = option.check ? option.check(word) : ""; !why.empty())
        return wrong(why);
    option.set(options, word);
    return Done{};
}

Status readPictureWords(std::span<const std::string> words, PictureOptions& options, std::string& frame)
{
    bool onlyModel = false, hasModel = false;
    std::set<std::string> given;
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
        const PictureOption* option = name.starts_with("--") ? findPictureOption(name.substr(2)) : nullptr;
        if (!option && name != "--frame")
            return wrong(unknownOption(name));
        if (option && option->flag) {
            if (equals != std::string::npos)
                return wrong(name + " takes no value; found '" + word.substr(equals + 1) + "'");
            options.*option->flag = true;
            continue;
        }
        if (!given.insert(name).second)
            return wrong(name + " is given twice; expected once");
        if (equals == std::string::npos && ++i == words.size())
            return wrong(name + " needs a value");
        const std::string value = equals == std::string::npos ? words[i] : word.substr(equals + 1);
        if (!option)
            frame = value;
        else if (Status set = setOption(*option, value, options); !set)
            return usageError(name + ": " + set.error().message);
    }
    return Done{};
}

} // namespace cotan
