// Draws an image of a model as `cotan render` does, from the same options.
//
//     cotan::PictureOptions options;
//     options.model = "model.glb";
//     options.size = {640, 480};
//     auto picture = cotan::openPicture(options, /*threads=*/0, {cotan::FrameChoice()});
//     if (!picture)
//         return fail(picture.error().message);
//     picture->view.setFrame(picture->frames.front());
//     auto renderer = cotan::openPictureRenderer(options, *picture);
//     auto image = cotan::drawShow(**renderer, picture->scene, picture->view, options.show, /*floats=*/false,
//                                  picture->meant);
//
// Error messages name options as on the command line.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <future>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "cotan/files.hpp"
#include "cotan/frame.hpp"
#include "cotan/gltf.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- options -------------------------------------------------------------------------------

inline constexpr int kDefaultMemory = 640; // MiB for one image

// Returns limits with `memory` MiB for one image, and at least as much for all images of a model together.
LoadLimits limitsFor(int memory, Pixels pixels = Pixels::all);

// The user's own maps for a model: --normal-map, --base-color, --metallic-roughness, --occlusion, --height-map, --mask.
struct OwnMaps { // file names; empty: the model's map, for heights none
    std::string normal, baseColor, metallicRoughness, occlusion, height;
    std::string mask; // that `cotan bake --mask` wrote, for the view "mask"
    // World units from white down to black, or from the highest to the lowest of a file of floats; 0: no relief. Not
    // set: floats are in world units; for integers 2 % of the diagonal of the scene's box.
    std::optional<float> heightDepth;
    std::string convention; // of the normal map, empty: gltf; without a normal map: how to read the model's own, empty:
                            // as the model declares
    int material = -1;      // index of the only material that gets the maps; -1: all

    std::array<std::string, 6> files() const { return {normal, baseColor, metallicRoughness, occlusion, height, mask}; }
    friend bool operator==(const OwnMaps&, const OwnMaps&) = default;
};

// What an image is used for.
enum class PictureUse {
    shown,    // shaded, for viewing
    radiance, // shaded, as linear radiance
    data,     // not shaded
};

struct PictureSize {
    int width = 1280, height = 720; // pixels, each 1..16384

    bool fits() const; // whether both are in range
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

// Lines drawn over the image.
enum class Edges { none, triangles, seams, all };

// What is behind the model: nothing (transparent) or a Backdrop.
enum class Background { none, gradient, blurred, sharp, paper };

// How to draw a model: the options of `cotan render` and of its window.
struct PictureOptions {
    PictureUse use = PictureUse::shown; // set by the command
    std::string show = "shaded";        // one of showNames(); set by the command
    std::string model;                  // empty: the built-in scene, or the shape
    std::string shape;                  // plane, sphere, torus or teapot
    OwnMaps maps;
    Up up = Up::y; // of the model's file
    std::string variant;
    std::string animation;
    double time = 0;
    bool turntable = false; // set by the command: cameras frame all that the model covers as it rotates
    PictureSize size;
    std::string camera; // empty: the built-in scene's own, or front for a model
    std::string device = "auto";
    Edges edges = Edges::none;
    Shading shading = Shading::pbr;
    TangentOrigin tangents = TangentOrigin::stored;
    std::string environment = "studio"; // or "none"
    double environmentRotation = 0;     // degrees
    float environmentIntensity = 1;
    std::optional<Background> background; // none: depends on the environment
    ToneMapping toneMapping = ToneMapping::neutral;
    std::optional<float> exposure;        // factor; none: metered
    bool ground = true;                   // an otherwise invisible ground receives the model's shadow
    std::optional<double> shadowSoftness; // degrees; none: depends on the environment (shadowSoftnessOf)
    int memory = kDefaultMemory;
    int samples = 4;
    bool noShadows = false;
    bool noNormalMaps = false;
    bool pointSampled = false;
    bool specularAntialiasing = false;
    double maxDegrees = 0.3; // that the frames of `auto` may be off, on average, as ChoiceLimits::of

    // For a model that is not in files, as in LoadLimits; may be empty.
    std::function<Result<std::vector<std::byte>>(const std::string& name)> readFile;
    std::function<Result<Image>(std::span<const std::byte> bytes, const std::string& name)> decode;
};

// ---- from options to an image --------------------------------------------------------------

// Replaces maps of the scene's materials by the given ones; does nothing if none is given. limits: for each image.
// show: the view. In "mask" the mask becomes the only colour map, with the uv set and transform of the normal map.
// Factors of a material that would scale a new map (base colour, metallic, roughness, occlusion strength) become 1.
// A height map gets the uv set and transform of the normal map; one with a single value, or a depth of 0, is left out.
// Errors: ErrorKind::usage for an invalid or non-tangent-space convention, a material out of range, or options without
// a map, or "mask" without a mask; ErrorKind::input if an image cannot be read or no mesh that would show it has
// texture coordinates.
Status applyOwnMaps(const OwnMaps& maps, const LoadLimits& limits, Scene& scene, const std::string& show = "");

// Returns the model as read, the shape or the built-in scene, without the options' maps and without derived attributes.
// Errors: as loadScene and checkTrianglesDrawn.
Result<Scene> openModel(const PictureOptions& options);

// Like openModel, with the means to pose an animated model: poseModel returns its scenes at other times. Scene::reach
// of posed scenes covers the whole animation.
struct MovingModel {
    Scene scene;
    std::unique_ptr<AnimatedGltf> animated; // null if there are no animations
};
Result<MovingModel> openMovingModel(const PictureOptions& options);

// Returns the model in the pose of the options. before: an earlier scene of this model; images and frames of meshes are
// copied from it. Errors: as AnimatedGltf::at.
Result<Scene> poseModel(AnimatedGltf& model, const PictureOptions& options, const Scene& before);

// A frame, or nothing for `auto`: the frames of chooseFrames (cotan/frame_choice.hpp) for the maps of a model, the one
// frame that other maps are for.
using FrameChoice = std::optional<Frame>;

// Sets the frame of each mesh to the one that chooseFrames chooses for it within options.maxDegrees.
void chooseFramesOfMeshes(const PictureOptions& options, Scene& scene);

// Resolves a frame choice for the scene of the options' model, with the options' own maps applied, after
// chooseFramesOfMeshes. None: the meshes' frames differ.
std::optional<Frame> chosenFrame(const FrameChoice& choice, const PictureOptions& options, const Scene& scene);

// The name of a resolved choice; if the meshes' frames differ, all of them: "auto (orthonormal, mikktspace)".
std::string nameOfFrames(const std::optional<Frame>& frame, const Scene& scene);

// The frame that errors of images drawn with `drawn` are measured against: the one that the scene's maps are for, the
// options' own maps applied. `exact` if the scene lacks the attributes of that frame, or has those of another.
Frame meantFrame(const PictureOptions& options, const Scene& scene, const std::optional<Frame>& drawn);

// Whether normal maps are drawn and the attributes of the frame that they are for are missing: prepareScene derives
// them for the view "error".
bool lacksMeantFrame(const PictureOptions& options, const Scene& scene);

// Applies the options' own maps to the scene and derives the attributes that the frames need; for inspections (`show`),
// replaces the scene by one in false colours instead. Resolves `auto` in the returned frames, for which it calls
// chooseFramesOfMeshes if no mesh has a frame yet. Errors: as applyOwnMaps.
Result<std::vector<std::optional<Frame>>> prepareScene(const PictureOptions& options, const std::string& show,
                                                       std::initializer_list<FrameChoice> frames, Scene& scene);

// Returns the view of the options, except environment map, lights and ground.
Result<View> viewOf(const PictureOptions& options, const Scene& scene);

// Whether the exposure is to be found by meterExposure.
bool meters(const PictureOptions& options);

// ---- turntable -----------------------------------------------------------------------------

// A model that rotates about the vertical while camera, lights and ground stay fixed.

// Points whose convex hull contains everything that a scene covers while it rotates about the vertical through the
// middle of its box: for Scene::reach, so that one camera frames all of it. They are circles of 32 points at 33
// heights, each as wide as the adjacent slices of the scene, up to 0.5 % too wide. Empty without finite points.
std::vector<glm::vec3> sweptPoints(const Scene& scene);

// Rotates the instances of a scene about the vertical.
class Turntable {
public:
    explicit Turntable(const Scene& scene); // keeps the scene's current transforms

    // Sets the instances of that scene to the kept transforms, rotated counter-clockwise by `degrees` as seen from
    // above. Lights and cameras are not changed.
    void turn(Scene& scene, double degrees) const;

private:
    std::vector<glm::mat4> transforms_;
    glm::dvec3 middle_{0};
};

// ---- an open model --------------------------------------------------------------------------

// A loaded model and a view of it. The caller sets the frame and the output.
struct Picture {
    Scene scene;
    View view;
    bool meter = false;                                    // whether to meter the exposure
    std::vector<std::optional<Frame>> frames;              // the requested ones, with `auto` resolved
    Frame meant = Frame::exact;                            // that the view "error" measures against
    std::vector<SurfaceEdge> edges;                        // to draw over the image
    double loadSeconds = 0;                                // set by the caller
    std::future<Result<std::unique_ptr<Renderer>>> device; // being opened; used by openPictureRenderer
    // Used by movePicture.
    std::unique_ptr<AnimatedGltf> animated;                         // the open file of options.animation
    std::size_t imagesOfFile = 0;                                   // without the options' own maps
    std::pair<std::vector<Material>, std::vector<Image>> inspected; // those that an inspection has replaced
    std::optional<Turntable> table;                                 // for options.turntable
};

// Loads the model (or makes the built-in scene), derives the attributes that `frames` need, and sets up the view.
// Warnings are in the scene. Opens the device in parallel; threads: as for openRenderer.
Result<Picture> openPicture(const PictureOptions& options, int threads, std::initializer_list<FrameChoice> frames);

// Waits for the device, loads the scene into it and meters the exposure; the renderer's note tells of a fallback.
// Call once per Picture, which must outlive the renderer. Errors: of openRenderer, Renderer::load and draw.
Result<std::unique_ptr<Renderer>> openPictureRenderer(const PictureOptions& options, Picture& picture);

// Moves the model, for another image by the same renderer: with options.turntable by `to` degrees from where it was
// read; else to `to` seconds of options.animation, which must not be empty. Reads no file. The camera, the exposure,
// the frames of meshes and the ground's height stay; lights, the shadow on the ground and edges follow. After an error
// `picture` must not be used. Errors: as AnimatedGltf::at, limitCoverage and Renderer::load.
Status movePicture(const PictureOptions& options, double to, Picture& picture, Renderer& renderer);

// The values of --view.
const std::vector<std::string>& showNames();

// Whether a value of --view draws light: the model, or its relief on another material; not data or false colours.
bool showsLight(const std::string& show);

// The renderer's output for a value of --view.
Output outputOf(const std::string& show);

// Draws the image for a value of --view. floats: for a file that stores floats. meant: the frame that the view "error"
// measures against; `error` is called with its statistics, in degrees. Errors: those of Renderer::draw.
Result<Image> drawShow(Renderer& renderer, const Scene& scene, View view, const std::string& show, bool floats,
                       Frame meant, const std::function<void(const AngleStatistics&)>& error = {});

// Draws the requested edges over an 8-bit image that the renderer has drawn of the view. Does nothing for float images.
// Errors: those of Renderer::draw.
Status layEdges(Renderer& renderer, View view, const PictureOptions& options, std::span<const SurfaceEdge> edges,
                Image& image);

// ---- light ---------------------------------------------------------------------------------

// Returns the environment of the options; null for none. Errors: those of readImage and environmentOfImage;
// ErrorKind::usage for an unknown name.
Result<std::shared_ptr<const EnvironmentMap>> openEnvironmentMap(const PictureOptions& options);

// Angle in degrees that the shadow-casting light subtends: from the options; otherwise 3 in the environment `evening`,
// whose sun is small, and 10 in all others.
double shadowSoftnessOf(const PictureOptions& options);

// Sets the view's exposure, tone mapping, shadows and background from the options; lights and ground depend on the
// scene. Errors: ErrorKind::usage for options that need an environment if there is none.
Status lightPicture(const PictureOptions& options, View& view);

// Returns the scene's lights or, if it has none, those that belong to the environment.
std::vector<Light> lightsOf(const PictureOptions& options, const Scene& scene);

// Returns the shadow on the ground, or null if the options want none. If the view has a ground, its height is kept.
std::shared_ptr<const GroundMap> groundOf(const PictureOptions& options, const Scene& scene, const View& view);

} // namespace cotan
