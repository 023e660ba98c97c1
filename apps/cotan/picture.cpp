#include "picture.hpp"

#include <future>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "cotan/draw/camera_words.hpp"
#include "cotan/draw/exposure.hpp"
#include "cotan/inspect/inspection.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/report/words.hpp"
#include "cotan/scene/geometry.hpp"
#include "cotan/shapes/shapes.hpp"
#include "cotan/surface/vertex_frames.hpp"
#include "cotan/verify/frames.hpp"
#include "parse.hpp"
#include "picture_light.hpp"

namespace cotan::app {

namespace {

const std::map<std::string, NormalMapping> kNormalMappings = {{"shading", NormalMapping::shading},
                                                              {"rays", NormalMapping::rays},
                                                              {"shadowed", NormalMapping::shadowed},
                                                              {"facets", NormalMapping::facets},
                                                              {"mirror-facet", NormalMapping::mirrorFacet}};

} // namespace

Result<View> viewOf(const PictureOptions& options, const Scene& scene)
{
    View view;
    const auto size = parseSize(options.size);
    if (!size)
        return size.error();
    view.width = size->first;
    view.height = size->second;
    const bool ownCamera =
        options.camera.empty() && options.model.empty() && options.shape.empty() && !scene.cameras.empty();
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

bool keepsFloats(const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    return extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff";
}

bool meters(const PictureOptions& options) { return options.exposure == "auto" && options.use == PictureUse::shown; }

void addShowOption(Arguments& a, std::string& show)
{
    a.option(
         "--view", show,
         "what to draw: shaded; normal, tangent, bitangent, uv, depth; error (degrees from the frame exact); checker, "
         "density, stretch, shear, mirrored (uv and texels), w (of stored tangents), facing; or one map by itself: "
         "base-color, alpha, normal-map, normal-map-red, -green, -blue, roughness, metallic, occlusion, emissive")
        .from(showNames())
        .in("NAME");
}

void addPictureOptions(Arguments& a, PictureOptions& o)
{
    a.option("MODEL", o.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file; the built-in scene if left out");
    a.option("--shape", o.shape, "without MODEL: a shape to look at maps on: plane, sphere, torus or teapot")
        .from({"plane", "sphere", "torus", "teapot"})
        .in("NAME");
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
         "eye and target \"ex,ey,ez,tx,ty,tz\" in world units, with \",DEGREES\" for another lens than 45 or \",hX\" "
         "for "
         "an orthographic picture X units high, and \",ux,uy,uz\" for what is up (default: front; the built-in scene's "
         "own)")
        .in("CAMERA");
    addDeviceOption(a, o.device);
    a.option("--edges", o.edges,
             "lines over the picture: none, triangles, seams (of uv: yellow; mirrored: magenta; borders: cyan) or all")
        .from({"none", "triangles", "seams", "all"})
        .in("NAME");
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

Result<Scene> openModel(const PictureOptions& options, const CommonOptions& common)
{
    const bool none = options.model.empty();
    if (!none && !options.shape.empty())
        return usageError("--shape: expected no model with it; found " + options.model);
    if (!options.variant.empty() && none)
        return usageError("--variant: expected a model; found the built-in scene");
    if (options.animation.empty() ? options.time > 0 : none)
        return usageError(options.animation.empty() ? "--time: expected --animation with it; found none"
                                                    : "--animation: expected a model; found the built-in scene");
    if (none)
        return options.shape.empty() ? builtinScene() : shapeScene(options.shape);
    LoadLimits limits = limitsFor(options.memory);
    limits.pose = {options.animation, options.time};
    limits.variant = options.variant;
    auto scene = loadTold(common, limits, options.model);
    if (scene)
        if (const Status ok = checkTrianglesDrawn(*scene); !ok) // before anything is said of the rest
            return ok.error();
    return scene;
}

Status prepareScene(const PictureOptions& options, const std::string& show, std::initializer_list<Frame> frames,
                    Scene& scene)
{
    if (Status applied = applyOwnMaps(options.maps, options.memory, scene); !applied)
        return applied;
    if (const auto inspection = inspectionFromName(show)) {
        scene = inspected(std::move(scene), *inspection);
        return Done{};
    }
    for (Frame frame : frames)
        deriveVertexFrames(scene, frame,
                           options.tangents == "generated" ? TangentOrigin::generated : TangentOrigin::stored);
    return Done{};
}

Result<Picture> openPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<Frame> frames, const View* like)
{
    Stopwatch watch;
    if (const auto size = parseSize(options.size); !size) // before a large model is loaded
        return size.error();
    Picture picture;
    std::future<Result<std::shared_ptr<const EnvironmentMap>>> surroundings; // made while the model is read
    if (!like)
        surroundings = std::async(std::launch::async, openSurroundings, options);
    auto scene = openModel(options, common);
    if (!scene)
        return scene.error();
    picture.scene = std::move(*scene);
    if (options.edges != "none")
        picture.edges = surfaceEdges(picture.scene);
    if (Status prepared = prepareScene(options, options.show, frames, picture.scene); !prepared)
        return prepared.error();
    for (const std::string& line : picture.scene.warnings)
        warn(common, line);
    auto view = like ? Result<View>(*like) : viewOf(options, picture.scene);
    if (!view)
        return view.error();
    picture.view = std::move(*view);
    if (!like) {
        auto opened = surroundings.get();
        if (!opened)
            return opened.error();
        picture.view.environmentMap = std::move(*opened);
    }
    picture.meter = !like && meters(options);
    picture.view.lights = lightsOf(options, picture.scene);
    picture.loadSeconds = watch.lap();
    return picture;
}

std::string deviceOf(const PictureOptions& options)
{
    const bool reference =
        options.device == "auto" && (options.lighting != "world" || options.normalMapping != "shading");
    return reference ? "reference" : options.device;
}

Result<std::unique_ptr<Painter>> openPicturePainter(const PictureOptions& options, const CommonOptions& common,
                                                    Picture& picture)
{
    auto ground =
        std::async(std::launch::async, [&] { return groundOf(options, picture.scene, std::as_const(picture.view)); });
    auto painter = openDevice(deviceOf(options), common);
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

namespace {

const std::vector<std::pair<std::string, Output>> kShows = {
    {"shaded", Output::shaded},       {"normal", Output::normal}, {"tangent", Output::tangent},
    {"bitangent", Output::bitangent}, {"uv", Output::uv},         {"depth", Output::depth},
    {"error", Output::normal},
};

} // namespace

const std::vector<std::string>& showNames()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, output] : kShows)
            all.push_back(name);
        all.insert(all.end(), inspectionNames().begin(), inspectionNames().end());
        return all;
    }();
    return names;
}

Output outputOf(const std::string& show)
{
    for (const auto& [name, output] : kShows)
        if (name == show)
            return output;
    return Output::shaded;
}

Result<Image> drawShow(Painter& painter, const Scene& scene, View view, const std::string& show, bool floats,
                       const std::function<void(const AngleStatistics&)>& error)
{
    view.output = outputOf(show);
    if (inspectionFromName(show))
        return painter.draw(inspectionView(view));
    if (show == "error") {
        auto found = errorAgainstExact(painter, scene, view);
        if (!found)
            return found.error();
        if (error)
            error(found->degrees);
        return std::move(found->difference);
    }
    view.linearOutput = show == "shaded" && floats;
    auto image = painter.draw(view);
    if (image && show != "shaded" && !floats)
        return asColor(view.output, *image);
    return image;
}

Status layEdges(Painter& painter, View view, const PictureOptions& options, std::span<const SurfaceEdge> edges,
                Image& picture)
{
    if (options.edges == "none" || picture.type != PixelType::unorm8)
        return Done{};
    view.output = Output::depth;
    const auto depth = painter.draw(view);
    if (!depth)
        return depth.error();
    drawEdges(picture, *depth, view.camera, edges, {options.edges != "seams", options.edges != "triangles"});
    return Done{};
}

Json describeScene(const PictureOptions& options, const Picture& picture)
{
    Json report = {{"model",
                    !options.model.empty()       ? options.model
                        : !options.shape.empty() ? options.shape
                                                 : "built-in"},
                   {"size", {picture.view.width, picture.view.height}}};
    if (!options.animation.empty())
        report["pose"] = {{"animation", options.animation}, {"seconds", options.time}};
    report.update(countsOf(picture.scene));
    return report;
}

} // namespace cotan::app
