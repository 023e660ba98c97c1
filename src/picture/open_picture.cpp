#include "cotan/picture.hpp"

#include <algorithm>
#include <future>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/loops.hpp"
#include "core/try.hpp"
#include "cotan/frame_choice.hpp"
#include "cotan/maps.hpp"
#include "cotan/model.hpp"
#include "files/bytes.hpp"
#include "files/file_registry.hpp"
#include "inspect/angles.hpp"
#include "picture/option_words.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/parts.hpp"

namespace cotan {

LoadLimits limitsFor(int memory, Pixels pixels)
{
    LoadLimits limits;
    limits.imageBytes = std::size_t(memory) << 20;
    limits.allImageBytes = std::max(limits.allImageBytes, limits.imageBytes);
    if (memory > kDefaultMemory) // the user has raised the limit
        limits.imageBytesBeyond = limits.imageBytes;
    limits.imageSide = 1 << 20; // only the memory limit applies
    limits.pixels = pixels;
    return limits;
}

bool PictureSize::fits() const { return width >= 1 && height >= 1 && width <= 16384 && height <= 16384; }

namespace {

constexpr auto kBeside = kHasThreads ? std::launch::async : std::launch::deferred;

constexpr Named<Output> kShows[] = {{"shaded", Output::shaded},   {"normal", Output::normal},
                                    {"tangent", Output::tangent}, {"bitangent", Output::bitangent},
                                    {"uv", Output::uv},           {"depth", Output::depth},
                                    {"error", Output::normal}};

Status checkSize(const PictureSize& size)
{
    if (size.fits())
        return Done{};
    return usageError(fmt::format("--size: expected WxH, each from 1 to 16384; found '{}'", sizeWord(size)));
}

Status checkModelOptions(const PictureOptions& options)
{
    const bool noModel = options.model.empty();
    if (!noModel && !options.shape.empty())
        return usageError("--shape: expected no model with it; found " + options.model);
    if (!options.variant.empty() && noModel)
        return usageError("--variant: expected a model; found the built-in scene");
    if (options.up != Up::y && noModel)
        return usageError("--up: expected a model; found the built-in scene");
    if (options.animation.empty() ? options.time > 0 : noModel)
        return usageError(options.animation.empty() ? "--time: expected --animation with it; found none"
                                                    : "--animation: expected a model; found the built-in scene");
    return Done{};
}

LoadLimits limitsOf(const PictureOptions& options)
{
    LoadLimits limits = limitsFor(options.memory);
    limits.pose = {options.animation, options.time};
    limits.variant = options.variant;
    limits.up = options.up;
    limits.readFile = options.readFile;
    limits.decode = options.decode;
    return limits;
}

// Applies what loadScene also does, for a scene that was read without it.
Status complete(AnimatedGltf& model, const PictureOptions& options, Scene& scene)
{
    if (!options.animation.empty()) {
        COTAN_TRY(points, model.reach(options.animation));
        scene.reach = std::move(*points);
    }
    if (options.up == Up::z)
        rotateZUpToYUp(scene);
    return Done{};
}

Result<Scene> checkedScene(Result<Scene> scene)
{
    if (scene)
        if (const Status ok = checkTrianglesDrawn(*scene); !ok) // before other errors are reported
            return ok.error();
    return scene;
}

Result<MovingModel> still(Result<Scene> scene)
{
    if (!scene)
        return scene.error();
    return MovingModel{std::move(*scene), nullptr};
}

} // namespace

Result<View> viewOf(const PictureOptions& options, const Scene& scene)
{
    View view;
    COTAN_CHECK(checkSize(options.size));
    view.width = options.size.width;
    view.height = options.size.height;
    const bool ownCamera = options.camera.empty() && options.model.empty() && options.shape.empty()
        && !scene.cameras.empty() && !options.turntable;
    const std::string camera = !options.camera.empty() ? options.camera : ownCamera ? "0" : "front";
    auto parsed = parseCamera(camera, scene, view.width, view.height);
    if (!parsed)
        return usageError("--camera: " + parsed.error().message);
    view.camera = *parsed;
    COTAN_CHECK(lightPicture(options, view));
    view.shading = options.shading;
    view.samples = options.samples;
    view.normalMaps = !options.noNormalMaps;
    view.pointSampled = options.pointSampled;
    view.specularAntialiasing = options.specularAntialiasing;
    return view;
}

bool meters(const PictureOptions& options) { return !options.exposure && options.use == PictureUse::shown; }

Result<Scene> openModel(const PictureOptions& options)
{
    COTAN_CHECK(checkModelOptions(options));
    if (options.model.empty())
        return options.shape.empty() ? builtinScene() : shapeScene(options.shape);
    return checkedScene(loadScene(options.model, limitsOf(options)));
}

Result<MovingModel> openMovingModel(const PictureOptions& options)
{
    const std::string ending = lowerExtension(options.model);
    const bool gltf = options.readFile || ending == ".gltf" || ending == ".glb";
    if (!gltf || !checkModelOptions(options))
        return still(openModel(options));
    const LoadLimits limits = limitsOf(options);
    COTAN_TRY(opened, AnimatedGltf::open(options.model, limits));
    COTAN_TRY(scene, checkedScene((*opened)->at(limits.pose)));
    COTAN_CHECK(complete(**opened, options, *scene));
    if (const auto refused = firstRefusal())
        return *refused;
    if ((*opened)->animations().empty())
        opened->reset();
    return MovingModel{std::move(*scene), std::move(*opened)};
}

Result<Scene> poseModel(AnimatedGltf& model, const PictureOptions& options, const Scene& before)
{
    auto scene = model.at({options.animation, options.time}, &before.images);
    if (!scene)
        return scene;
    COTAN_CHECK(complete(model, options, *scene));
    for (std::size_t i = 0; i < std::min(scene->meshes.size(), before.meshes.size()); ++i)
        scene->meshes[i].readWith = before.meshes[i].readWith;
    return scene;
}

namespace {

MapSource sourceOf(const PictureOptions& options)
{
    return options.model.empty() ? MapSource::shape : options.maps.normal.empty() ? MapSource::model : MapSource::own;
}

// The frames of the meshes, each once.
std::vector<Frame> framesOf(const Scene& scene)
{
    std::vector<Frame> all;
    for (const Mesh& mesh : scene.meshes)
        if (mesh.readWith && std::ranges::find(all, *mesh.readWith) == all.end())
            all.push_back(*mesh.readWith);
    std::ranges::sort(all);
    return all;
}

} // namespace

void chooseFramesOfMeshes(const PictureOptions& options, Scene& scene)
{
    for (const FrameDecision& d : chooseFrames(scene, {.limits = ChoiceLimits::of(options.maxDegrees)}))
        if (d.reason != ChoiceReason::noMap)
            scene.meshes[d.mesh].readWith = d.frame;
}

std::optional<Frame> chosenFrame(const FrameChoice& choice, const PictureOptions& options, const Scene& scene)
{
    if (choice)
        return choice;
    const MapSource source = sourceOf(options);
    const std::vector<Frame> own = framesOf(scene);
    if (source != MapSource::model || own.empty())
        return autoFrame(scene, source);
    return own.size() == 1 ? std::optional(own.front()) : std::nullopt;
}

Frame meantFrame(const PictureOptions& options, const Scene& scene, const std::optional<Frame>& drawn)
{
    const Frame meant = meantFrame(scene, sourceOf(options));
    const bool otherTangents = drawn && readsTangents(*drawn) && readsTangents(meant) && *drawn != meant;
    return otherTangents || !checkVertexAttributes(scene, meant, false) ? Frame::exact : meant;
}

bool lacksMeantFrame(const PictureOptions& options, const Scene& scene)
{
    return drawsNormalMaps(scene) && !checkVertexAttributes(scene, meantFrame(scene, sourceOf(options)), false);
}

std::string nameOfFrames(const std::optional<Frame>& frame, const Scene& scene)
{
    if (frame)
        return std::string(name(*frame));
    std::vector<std::string_view> names;
    for (const Frame f : framesOf(scene))
        names.push_back(name(f));
    return fmt::format("{} ({})", kAutoFrame, fmt::join(names, ", "));
}

namespace {

// Resolves the choices for a scene with the options' own maps.
std::vector<std::optional<Frame>> resolved(const PictureOptions& options, std::initializer_list<FrameChoice> choices,
                                           Scene& scene)
{
    const bool automatic = std::ranges::any_of(choices, [](const FrameChoice& c) { return !c; });
    if (automatic && sourceOf(options) == MapSource::model && framesOf(scene).empty())
        chooseFramesOfMeshes(options, scene);
    std::vector<std::optional<Frame>> frames;
    for (const FrameChoice& choice : choices)
        frames.push_back(chosenFrame(choice, options, scene));
    return frames;
}

// Derives what the frames need, or replaces the scene by one in false colours.
void derive(const PictureOptions& options, const std::string& show, const std::vector<std::optional<Frame>>& frames,
            Scene& scene)
{
    if (const auto inspection = inspectionFromName(show)) {
        scene = inspected(std::move(scene), *inspection);
        return;
    }
    for (const std::optional<Frame>& frame : frames)
        deriveVertexFrames(scene, frame, options.tangents);
    applyStudy(scene, show);
    if (show == "error") // tangents that a frame has made stay
        deriveVertexFrames(scene, meantFrame(scene, sourceOf(options)), TangentOrigin::stored);
}

} // namespace

Result<std::vector<std::optional<Frame>>> prepareScene(const PictureOptions& options, const std::string& show,
                                                       std::initializer_list<FrameChoice> choices, Scene& scene)
{
    COTAN_CHECK(applyOwnMaps(options.maps, limitsFor(options.memory), scene, show));
    auto frames = resolved(options, choices, scene);
    derive(options, show, frames, scene);
    return frames;
}

Result<Picture> openPicture(const PictureOptions& options, int threads, std::initializer_list<FrameChoice> frames)
{
    if (const Status fits = checkSize(options.size); !fits) // before a large model is loaded
        return fits.error();
    Picture picture;
    // Slow work that runs while the model is read.
    picture.device = std::async(kBeside, [name = options.device, threads] { return openRenderer(name, threads); });
    auto environment = std::async(kBeside, openEnvironmentMap, options);
    COTAN_TRY(model, options.animation.empty() ? still(openModel(options)) : openMovingModel(options));
    picture.scene = std::move(model->scene);
    picture.animated = std::move(model->animated);
    picture.imagesOfFile = picture.scene.images.size();
    joinParts(picture.scene);
    if (options.turntable)
        picture.scene.reach = sweptPoints(picture.scene);
    if (options.edges != Edges::none)
        picture.edges = surfaceEdges(picture.scene);
    COTAN_CHECK(applyOwnMaps(options.maps, limitsFor(options.memory), picture.scene, options.show));
    picture.frames = resolved(options, frames, picture.scene);
    if (picture.animated && inspectionFromName(options.show))
        picture.inspected = {picture.scene.materials, picture.scene.images};
    derive(options, options.show, picture.frames, picture.scene);
    if (options.show == "error" && !picture.frames.empty())
        picture.meant = meantFrame(options, picture.scene, picture.frames.front());
    COTAN_TRY(view, viewOf(options, picture.scene));
    picture.view = std::move(*view);
    COTAN_TRY(opened, environment.get());
    picture.view.environmentMap = std::move(*opened);
    if (drawsNormalMaps(picture.scene))
        for (std::string& line : maps::mapFaults(picture.scene))
            picture.scene.warnings.push_back(std::move(line));
    picture.meter = meters(options);
    picture.view.lights = lightsOf(options, picture.scene);
    COTAN_CHECK(limitCoverage(picture.scene, picture.view));
    if (options.turntable)
        picture.table.emplace(picture.scene);
    return picture;
}

namespace {

// Replaces the scene by the model at another time. A pose changes no material and no image.
Status pose(const PictureOptions& options, double seconds, Picture& picture)
{
    PictureOptions then = options;
    then.time = seconds;
    Scene before;
    before.images.resize(picture.imagesOfFile);
    COTAN_TRY(posed, poseModel(*picture.animated, then, before));
    joinParts(*posed);
    before = std::exchange(picture.scene, std::move(*posed));
    Scene& scene = picture.scene;
    if (inspectionFromName(options.show)) {
        std::tie(scene.materials, scene.images) = picture.inspected;
    } else {
        scene.materials = std::move(before.materials);
        scene.images = std::move(before.images);
    }
    if (options.edges != Edges::none)
        picture.edges = surfaceEdges(scene);
    for (std::size_t i = 0; i < scene.meshes.size() && scene.meshes.size() == before.meshes.size(); ++i)
        scene.meshes[i].readWith = before.meshes[i].readWith;
    derive(options, options.show, picture.frames, scene);
    picture.view.lights = lightsOf(options, scene);
    return limitCoverage(scene, picture.view);
}

} // namespace

Status movePicture(const PictureOptions& options, double to, Picture& picture, Renderer& renderer)
{
    if (picture.table)
        picture.table->turn(picture.scene, to);
    else if (Status posed = pose(options, to, picture); !posed)
        return posed;
    auto ground = std::async(kBeside, [&] { return groundOf(options, picture.scene, std::as_const(picture.view)); });
    Status loaded = renderer.load(picture.scene, /*sameImages=*/true);
    picture.view.ground = ground.get();
    if (picture.table && options.edges != Edges::none)
        picture.edges = surfaceEdges(picture.scene);
    return loaded;
}

Result<std::unique_ptr<Renderer>> openPictureRenderer(const PictureOptions& options, Picture& picture)
{
    auto ground = std::async(kBeside, [&] { return groundOf(options, picture.scene, std::as_const(picture.view)); });
    auto renderer = picture.device.get();
    if (!renderer)
        return renderer;
    COTAN_CHECK((*renderer)->load(picture.scene));
    std::optional<Result<float>> exposure;
    if (picture.meter)
        exposure = meterExposure(**renderer, picture.view);
    picture.view.ground = ground.get(); // not needed before, and no other thread reads it now
    if (exposure && !*exposure)
        return exposure->error();
    picture.view.exposure = exposure ? **exposure : picture.view.exposure;
    return renderer;
}

// ---- outputs: light, a vector, an inspection, an error --------------------------------------

const std::vector<std::string>& showNames()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = wordsOf(kShows);
        all.insert(all.end(), inspectionNames().begin(), inspectionNames().end());
        all.insert(all.end(), studyNames().begin(), studyNames().end());
        return all;
    }();
    return names;
}

bool showsLight(const std::string& show) { return outputOf(show) == Output::shaded && !inspectionFromName(show); }

Output outputOf(const std::string& show) { return valueOf(kShows, show).value_or(Output::shaded); }

Result<Image> drawShow(Renderer& renderer, const Scene& scene, View view, const std::string& show, bool floats,
                       Frame meant, const std::function<void(const AngleStatistics&)>& error)
{
    view.output = outputOf(show);
    if (inspectionFromName(show))
        return renderer.draw(inspectionView(view));
    if (show == "error") {
        COTAN_TRY(found, errorAgainst(meant, renderer, scene, view));
        if (error)
            error(found->degrees);
        return std::move(found->difference);
    }
    const bool shaded = view.output == Output::shaded;
    view.linearOutput = shaded && floats;
    auto image = renderer.draw(view);
    if (image && !shaded && !floats)
        return asColor(view.output, *image);
    return image;
}

Status layEdges(Renderer& renderer, View view, const PictureOptions& options, std::span<const SurfaceEdge> edges,
                Image& image)
{
    if (options.edges == Edges::none || image.type != PixelType::unorm8)
        return Done{};
    view.output = Output::depth;
    COTAN_TRY(depth, renderer.draw(view));
    drawEdges(image, *depth, view.camera, edges, {options.edges != Edges::seams, options.edges != Edges::triangles});
    return Done{};
}

} // namespace cotan
