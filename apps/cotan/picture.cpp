#include "picture.hpp"

#include <future>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "cotan/draw/camera_words.hpp"
#include "cotan/draw/exposure.hpp"
#include "cotan/report/words.hpp"
#include "cotan/scene/geometry.hpp"
#include "cotan/shapes/shapes.hpp"
#include "cotan/surface/vertex_frames.hpp"
#include "parse.hpp"
#include "picture_light.hpp"

namespace cotan::app {

namespace {

const std::map<std::string, NormalMapping> kNormalMappings = {{"shading", NormalMapping::shading},
                                                              {"rays", NormalMapping::rays},
                                                              {"shadowed", NormalMapping::shadowed},
                                                              {"facets", NormalMapping::facets},
                                                              {"mirror-facet", NormalMapping::mirrorFacet}};

Result<View> makeView(const PictureOptions& options, const Scene& scene)
{
    View view;
    const auto size = parseSize(options.size);
    if (!size)
        return size.error();
    view.width = size->first;
    view.height = size->second;
    const bool ownCamera = options.camera.empty() && options.model.empty() && !scene.cameras.empty();
    const std::string camera = !options.camera.empty() ? options.camera : ownCamera ? "0" : "front";
    auto parsed = cameraFromWords(camera, scene, view.width, view.height);
    if (!parsed)
        return usageError("--camera: " + parsed.error().message);
    view.camera = *parsed;
    if (Status lit = lightPicture(options, view); !lit)
        return lit.error();
    view.shading = options.shading == "pbr" ? Shading::pbr : Shading::blinnPhong;
    view.lighting = options.lighting == "world" ? Lighting::world
        : options.lighting == "tangent-vertex"  ? Lighting::tangentVertex
                                                : Lighting::tangentPixel;
    view.normalMapping = kNormalMappings.at(options.normalMapping);
    view.rowsUpward = options.rows == "up";
    view.derivatives = options.derivatives == "fine" ? Derivatives::fine : Derivatives::coarse;
    view.samples = options.samples;
    view.normalMaps = !options.noNormalMaps;
    view.pointSampled = options.pointSampled;
    view.specularAntialiasing = options.specularAntialiasing;
    return view;
}

} // namespace

void addPictureOptions(Arguments& a, PictureOptions& o)
{
    a.option("MODEL", o.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file; the built-in scene if left out");
    addMemoryOption(a, o.memory);
    addOwnMaps(a, o.maps);
    a.option("--variant", o.variant,
             "variant of a glTF model's materials, by name or number; those of the file if left out")
        .in("NAME|N");
    a.option("--animation", o.animation,
             "animation of a glTF model, by name or number; the pose of the file if left out")
        .in("NAME|N");
    a.option("--time", o.time, "moment of --animation, in seconds from its start").within(0.0, 1e6).in("S");
    a.option("--size", o.size, "width and height in pixels").in("WxH");
    a.option(
         "--camera", o.camera,
         "front (filling the picture), fit (the whole box around the model), the number of a camera of the file, or "
         "eye and target \"ex,ey,ez,tx,ty,tz\" in world units (default: front; the built-in scene's own)")
        .in("CAMERA");
    addDeviceOption(a, o.device);
    a.option("--shading", o.shading, "shading model: pbr or blinn-phong").from({"pbr", "blinn-phong"}).in("NAME");
    a.option("--lighting", o.lighting,
             "space to light in: world; or tangent space, entered per vertex (tangent-vertex) or per pixel "
             "(tangent-pixel), for comparison and on the reference device only")
        .from({"world", "tangent-vertex", "tangent-pixel"})
        .in("NAME");
    a.option("--normal-mapping", o.normalMapping,
             "what a turned normal does: shading; or by rays, on the reference device only: rays (light from below "
             "the surface is lost), shadowed, facets (a second facet makes up for it), mirror-facet")
        .from({"shading", "rays", "shadowed", "facets", "mirror-facet"})
        .in("NAME");
    addTangentsOption(
        a, o.tangents,
        "for the frames vertex and mikktspace: stored (as in the file, generated where missing) or generated");
    a.option("--samples", o.samples, "samples per pixel of the shaded picture: 1 or 4").from({1, 4}).in("N");
    addLightOptions(a, o);
    a.option("--rows", o.rows,
             "whether the rows of the render target run down or up; the picture is upright either way")
        .from({"down", "up"})
        .in("NAME");
    a.option("--derivatives", o.derivatives, "screen derivatives: fine or coarse").from({"fine", "coarse"}).in("NAME");
    a.flag("--no-normal-maps", o.noNormalMaps, "use interpolated normals only");
    a.flag("--specular-antialiasing", o.specularAntialiasing,
           "light sixteen normals of a pixel, each rougher by what is smaller than its part of it");
    a.flag("--point-sampled", o.pointSampled, "read the nearest texel of the finest level, for comparing devices");
}

Result<Picture> openPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<Frame> frames, const View* like)
{
    Stopwatch watch;
    if (const auto size = parseSize(options.size); !size) // before a large model is loaded
        return size.error();
    if (!options.variant.empty() && options.model.empty())
        return usageError("--variant: expected a model; found the built-in scene");
    if (options.animation.empty() ? options.time > 0 : options.model.empty())
        return usageError(options.animation.empty() ? "--time: expected --animation with it; found none"
                                                    : "--animation: expected a model; found the built-in scene");
    Picture picture;
    std::future<Result<std::shared_ptr<const EnvironmentMap>>> surroundings; // made while the model is read
    if (!like)
        surroundings = std::async(std::launch::async, openSurroundings, options);
    if (options.model.empty()) {
        picture.scene = builtinScene();
    } else {
        LoadLimits limits = limitsFor(options.memory);
        limits.pose = {options.animation, options.time};
        limits.variant = options.variant;
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
    if (!like) {
        auto opened = surroundings.get();
        if (!opened)
            return opened.error();
        picture.view.environmentMap = std::move(*opened);
    }
    picture.meter = !like && options.exposure == "auto" && options.use == PictureUse::shown;
    picture.view.lights = lightsOf(options, picture.scene);
    picture.loadSeconds = watch.lap();
    return picture;
}

Result<std::unique_ptr<Painter>> openPicturePainter(const PictureOptions& options, const CommonOptions& common,
                                                    Picture& picture)
{
    const bool reference =
        options.device == "auto" && (options.lighting != "world" || options.normalMapping != "shading");
    auto ground =
        std::async(std::launch::async, [&] { return groundOf(options, picture.scene, std::as_const(picture.view)); });
    auto painter = openDevice(reference ? "reference" : options.device, common);
    if (!painter)
        return painter;
    if (Status loaded = (*painter)->load(picture.scene); !loaded)
        return loaded.error();
    std::optional<Result<float>> exposure;
    if (picture.meter)
        exposure = meterExposure(**painter, picture.view);
    picture.view.ground = ground.get(); // not needed before, and read by nobody else now
    if (exposure && !*exposure)
        return exposure->error();
    picture.view.exposure = exposure ? **exposure : picture.view.exposure;
    return painter;
}

Status checkLighting(const PictureOptions& options, Frame frame)
{
    if (options.lighting == "tangent-vertex" && frame != Frame::vertex && frame != Frame::mikktspace)
        return usageError(
            fmt::format("--lighting tangent-vertex: expected a frame with tangents at the vertices, vertex or "
                        "mikktspace; found '{}'",
                        name(frame)));
    if (options.normalMapping != "shading" && (options.shading != "pbr" || options.lighting != "world"))
        return usageError(fmt::format("--normal-mapping {}: expected --shading pbr and --lighting world with it; found "
                                      "{} and {}",
                                      options.normalMapping, options.shading, options.lighting));
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
