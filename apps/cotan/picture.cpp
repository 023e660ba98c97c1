#include "picture.hpp"

#include <filesystem>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cotan/draw/camera_words.hpp"
#include "cotan/environment/environment.hpp"
#include "cotan/report/words.hpp"
#include "cotan/scene/geometry.hpp"
#include "cotan/shapes/shapes.hpp"
#include "cotan/surface/vertex_frames.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

const std::map<std::string, ToneMapping> kToneMappings = {
    {"none", ToneMapping::none},
    {"neutral", ToneMapping::neutral},
    {"aces", ToneMapping::aces},
    {"agx", ToneMapping::agx},
};

// A name of environmentNames, or a file.
Result<EnvironmentMap> openEnvironment(const PictureOptions& o)
{
    EnvironmentOptions made;
    made.rotation = float(o.environmentRotation * std::numbers::pi / 180);
    made.intensity = o.environmentIntensity;
    if (const auto radiance = builtinRadiance(o.environment)) {
        EnvironmentMap map = makeEnvironment(*radiance, 2, made);
        map.name = o.environment;
        return map;
    }
    if (std::filesystem::path(o.environment).extension().empty())
        return usageError(fmt::format("--environment: expected {}, or a .hdr or .exr file; found '{}'",
                                      fmt::join(environmentNames(), ", "), o.environment));
    const auto picture = readImageWithin(o.memory, o.environment);
    if (!picture)
        return picture.error();
    return environmentOfPicture(*picture, made);
}

// The environment and what is seen of it.
Status surround(const PictureOptions& options, View& view)
{
    const bool surrounded = !options.environment.empty();
    const bool seen = options.background == "environment" || options.background == "blur";
    if (!surrounded && (seen || options.environmentRotation != 0 || options.environmentIntensity != 1))
        return usageError(fmt::format("--{}: expected --environment with it; found none",
                                      seen                                   ? "background " + options.background
                                          : options.environmentRotation != 0 ? "environment-rotation"
                                                                             : "environment-intensity"));
    view.background = options.background != "none";
    if (!surrounded)
        return Done{};
    view.backdrop = options.background == "gradient" ? Backdrop::gradient
        : options.background == "environment"        ? Backdrop::sharp
                                                     : Backdrop::blurred;
    auto map = openEnvironment(options);
    if (!map)
        return map.error();
    view.environmentMap = std::make_shared<const EnvironmentMap>(std::move(*map));
    return Done{};
}

std::vector<Light> lightsOf(const PictureOptions& options, const Scene& scene)
{
    return scene.lights.empty() && options.environment.empty() ? defaultLights() : scene.lights;
}

Result<View> makeView(const PictureOptions& options, const Scene& scene)
{
    View view;
    const auto size = parseSize(options.size);
    if (!size)
        return size.error();
    view.width = size->first;
    view.height = size->second;
    const bool ownCamera = options.camera.empty() && options.model.empty() && !scene.cameras.empty();
    const std::string camera = !options.camera.empty() ? options.camera : ownCamera ? "0" : "fit";
    auto parsed = cameraFromWords(camera, scene, view.width, view.height);
    if (!parsed)
        return usageError("--camera: " + parsed.error().message);
    view.camera = *parsed;
    if (Status lit = surround(options, view); !lit)
        return lit.error();
    view.shading = options.shading == "pbr" ? Shading::pbr : Shading::blinnPhong;
    view.lighting = options.lighting == "world" ? Lighting::world
        : options.lighting == "tangent-vertex"  ? Lighting::tangentVertex
                                                : Lighting::tangentPixel;
    view.rowsUpward = options.rows == "up";
    view.derivatives = options.derivatives == "fine" ? Derivatives::fine : Derivatives::coarse;
    view.samples = options.samples;
    view.exposure = options.exposure;
    view.toneMapping = kToneMappings.at(options.toneMapping);
    view.shadows = !options.noShadows;
    view.normalMaps = !options.noNormalMaps;
    view.pointSampled = options.pointSampled;
    return view;
}

} // namespace

void addPictureOptions(Arguments& a, PictureOptions& o)
{
    a.option("MODEL", o.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file; the built-in scene if left out");
    addMemoryOption(a, o.memory);
    addOwnMaps(a, o.maps);
    a.option("--animation", o.animation,
             "animation of a glTF model, by name or number; the pose of the file if left out")
        .in("NAME|N");
    a.option("--time", o.time, "moment of --animation, in seconds from its start").within(0.0, 1e6).in("S");
    a.option("--size", o.size, "width and height in pixels").in("WxH");
    a.option("--camera", o.camera,
             "fit, front (nearer: filling the picture), the number of a camera of the file, or eye and target "
             "\"ex,ey,ez,tx,ty,tz\" in world units (default: fit)")
        .in("CAMERA");
    addDeviceOption(a, o.device);
    a.option("--shading", o.shading, "shading model: pbr or blinn-phong").from({"pbr", "blinn-phong"}).in("NAME");
    a.option("--lighting", o.lighting,
             "space to light in: world; or tangent space, entered per vertex (tangent-vertex) or per pixel "
             "(tangent-pixel), for comparison and on the reference device only")
        .from({"world", "tangent-vertex", "tangent-pixel"})
        .in("NAME");
    addTangentsOption(
        a, o.tangents,
        "for the frames vertex and mikktspace: stored (as in the file, generated where missing) or generated");
    a.option("--samples", o.samples, "samples per pixel of the shaded picture: 1 or 4").from({1, 4}).in("N");
    a.option("--exposure", o.exposure, "factor that multiplies all light").above0().in("X");
    a.option("--tone-mapping", o.toneMapping,
             "how bright light becomes a colour: none (cut off at 1), neutral (Khronos PBR Neutral), aces (Narkowicz's "
             "curve) or agx; files that keep floats stay linear")
        .from({"none", "neutral", "aces", "agx"})
        .in("NAME");
    a.option("--environment", o.environment,
             "surroundings that light the model: studio, overcast, evening, or a .hdr or .exr file in equirectangular "
             "projection; the lamp that models without lights get is left out then")
        .in("NAME|FILE");
    a.option("--environment-rotation", o.environmentRotation,
             "turn the surroundings counter-clockwise, seen from above")
        .within(-360.0, 360.0)
        .in("DEGREES");
    a.option("--environment-intensity", o.environmentIntensity, "factor on the light of the surroundings")
        .above0()
        .in("X");
    a.option("--background", o.background,
             "what is behind the model: gradient, environment, blur (the environment out of focus; the default with "
             "--environment), or none (transparent)")
        .from({"gradient", "environment", "blur", "none"})
        .in("NAME");
    a.option("--rows", o.rows,
             "whether the rows of the render target run down or up; the picture is upright either way")
        .from({"down", "up"})
        .in("NAME");
    a.option("--derivatives", o.derivatives, "screen derivatives: fine or coarse").from({"fine", "coarse"}).in("NAME");
    a.flag("--no-shadows", o.noShadows, "draw no shadows");
    a.flag("--no-normal-maps", o.noNormalMaps, "use interpolated normals only");
    a.flag("--point-sampled", o.pointSampled, "read the nearest texel of the finest level, for comparing devices");
}

Result<Picture> openPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<Frame> frames, const View* like)
{
    Stopwatch watch;
    if (const auto size = parseSize(options.size); !size) // before a large model is loaded
        return size.error();
    Picture picture;
    if (options.animation.empty() ? options.time > 0 : options.model.empty())
        return usageError(options.animation.empty() ? "--time: expected --animation with it; found none"
                                                    : "--animation: expected a model; found the built-in scene");
    if (options.model.empty()) {
        picture.scene = builtinScene();
    } else {
        LoadLimits limits = limitsFor(options.memory);
        limits.pose = {options.animation, options.time};
        auto scene = loadTold(common, limits, options.model);
        if (!scene)
            return scene.error();
        picture.scene = std::move(*scene);
    }
    if (const Status ok = checkTrianglesDrawn(picture.scene); !ok) // before anything is said of the rest
        return ok.error();
    if (Status applied = applyOwnMaps(options.maps, options.memory, picture.scene); !applied)
        return applied.error();
    for (Frame frame : frames)
        deriveVertexFrames(picture.scene, frame,
                           options.tangents == "generated" ? TangentOrigin::generated : TangentOrigin::stored);
    for (const std::string& line : picture.scene.warnings)
        warn(common, line);
    auto view = like ? Result<View>(*like) : makeView(options, picture.scene);
    if (!view)
        return view.error();
    picture.view = std::move(*view);
    picture.view.lights = lightsOf(options, picture.scene);
    picture.loadSeconds = watch.lap();
    return picture;
}

Result<std::unique_ptr<Painter>> openPicturePainter(const PictureOptions& options, const CommonOptions& common,
                                                    const Picture& picture)
{
    const bool reference = options.device == "auto" && options.lighting != "world";
    auto painter = openDevice(reference ? "reference" : options.device, common);
    if (!painter)
        return painter;
    if (Status loaded = (*painter)->load(picture.scene); !loaded)
        return loaded.error();
    return painter;
}

Status checkLighting(const PictureOptions& options, Frame frame)
{
    if (options.lighting == "tangent-vertex" && frame != Frame::vertex && frame != Frame::mikktspace)
        return usageError(
            fmt::format("--lighting tangent-vertex: expected a frame with tangents at the vertices, vertex or "
                        "mikktspace; found '{}'",
                        name(frame)));
    return Done{};
}

Json describeScene(const PictureOptions& options, const Picture& picture)
{
    Json report = {{"model", options.model.empty() ? "built-in" : options.model},
                   {"size", {picture.view.width, picture.view.height}}};
    if (!options.animation.empty())
        report["pose"] = {{"animation", options.animation}, {"seconds", options.time}};
    report.update(countsOf(picture.scene));
    return report;
}

} // namespace cotan::app
