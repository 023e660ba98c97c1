#include "picture.hpp"

#include <cstdlib>

#include <fmt/format.h>

#include "cotan/scene/geometry.hpp"
#include "cotan/shapes/shapes.hpp"
#include "cotan/surface/vertex_frames.hpp"
#include "device.hpp"
#include "parse.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

// CLI11's own range checks let NaN pass.
std::string positiveNumber(const std::string& text)
{
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    const bool good = end != text.c_str() && *end == '\0' && value > 0 && value <= 1e6f;
    return good ? "" : "expected a number above 0 and at most 1e6; found '" + text + "'";
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
    auto parsed = parseCamera(camera, scene, view.width, view.height);
    if (!parsed)
        return parsed.error();
    view.camera = *parsed;
    view.lights = scene.lights.empty() ? defaultLights() : scene.lights;
    view.shading = options.shading == "pbr" ? Shading::pbr : Shading::blinnPhong;
    view.lighting = options.lighting == "world" ? Lighting::world
        : options.lighting == "tangent-vertex"  ? Lighting::tangentVertex
                                                : Lighting::tangentPixel;
    view.rowsUpward = options.rows == "up";
    view.derivatives = options.derivatives == "fine" ? Derivatives::fine : Derivatives::coarse;
    view.samples = options.samples;
    view.exposure = options.exposure;
    view.shadows = !options.noShadows;
    view.normalMaps = !options.noNormalMaps;
    view.pointSampled = options.pointSampled;
    return view;
}

} // namespace

void addPictureOptions(CLI::App& command, PictureOptions& o)
{
    command.add_option("MODEL", o.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file; the built-in scene if left out");
    addMemoryOption(command, o.memory);
    addNormalMapOption(command, o.normalMap);
    command.add_option("--size", o.size, "width and height in pixels")->type_name("WxH")->capture_default_str();
    command.add_option("--camera", o.camera,
                       "fit, the number of a camera of the file, or eye and target "
                       "\"ex,ey,ez,tx,ty,tz\" in world units (default: fit)")
        ->type_name("CAMERA");
    command.add_option("--device", o.device, "auto, reference, or a part of a Vulkan device's name")
        ->type_name("DEVICE")->capture_default_str();
    command.add_option("--shading", o.shading, "pbr or blinn-phong")
        ->check(CLI::IsMember({"pbr", "blinn-phong"}))->type_name("NAME")->capture_default_str();
    command.add_option("--lighting", o.lighting,
                       "world, or, on the reference device and for comparison, tangent-vertex or tangent-pixel: light "
                       "and view vectors are taken to tangent space")
        ->check(CLI::IsMember({"world", "tangent-vertex", "tangent-pixel"}))->type_name("NAME")->capture_default_str();
    command.add_option("--tangents", o.tangents, "for the frames vertex and mikktspace: stored (as in the file, generated where missing) or generated")
        ->check(CLI::IsMember({"stored", "generated"}))->type_name("NAME")->capture_default_str();
    command.add_option("--samples", o.samples, "samples a pixel of the shaded picture: 1 or 4")
        ->check(CLI::IsMember({1, 4}))->type_name("N")->capture_default_str();
    command.add_option("--exposure", o.exposure, "factor on all light")
        ->check(positiveNumber)->type_name("X")->capture_default_str();
    command.add_option("--rows", o.rows, "way the target's rows run while drawing: down or up; the picture is upright either way")
        ->check(CLI::IsMember({"down", "up"}))->type_name("NAME")->capture_default_str();
    command.add_option("--derivatives", o.derivatives, "fine or coarse")
        ->check(CLI::IsMember({"fine", "coarse"}))->type_name("NAME")->capture_default_str();
    command.add_flag("--no-shadows", o.noShadows, "no shadows");
    command.add_flag("--no-normal-maps", o.noNormalMaps, "interpolated normals only");
    command.add_flag("--point-sampled", o.pointSampled, "nearest texel of the finest level, for comparing devices");
}

Result<Picture> openPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<Frame> frames)
{
    Stopwatch watch;
    if (const auto size = parseSize(options.size); !size) // before a large model is loaded
        return size.error();
    Picture picture;
    if (options.model.empty()) {
        picture.scene = builtinScene();
    } else {
        const Progress loading(common, 0, "loading " + options.model);
        auto scene = loadSceneWithin(options.memory, options.model);
        if (!scene)
            return scene.error();
        picture.scene = std::move(*scene);
    }
    if (const Status ok = checkTrianglesDrawn(picture.scene); !ok) // before anything is said of the rest
        return ok.error();
    if (Status applied = applyNormalMap(options.normalMap, options.memory, picture.scene); !applied)
        return applied.error();
    for (Frame frame : frames)
        deriveVertexFrames(picture.scene, frame, options.tangents == "generated" ? TangentOrigin::generated : TangentOrigin::stored);
    for (const std::string& line : picture.scene.warnings)
        warn(common, line);
    auto view = makeView(options, picture.scene);
    if (!view)
        return view.error();
    picture.view = std::move(*view);
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
    if (options.lighting == "tangent-vertex" && !readsTangents(frame))
        return usageError(fmt::format("--lighting tangent-vertex: expected a frame with tangents at the vertices, vertex or "
                                      "mikktspace; found '{}'", name(frame)));
    return Done{};
}

nlohmann::ordered_json describeScene(const PictureOptions& options, const Picture& picture)
{
    const Scene& scene = picture.scene;
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangleCount();
    return {{"model", options.model.empty() ? "built-in" : options.model},
            {"size", {picture.view.width, picture.view.height}},
            {"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"materials", scene.materials.size()},
            {"images", scene.images.size()},
            {"triangles", triangles},
            {"triangles_drawn", trianglesDrawn(scene)},
            {"warnings", scene.warnings}};
}

} // namespace cotan::app
