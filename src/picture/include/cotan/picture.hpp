// Draws an image of a model as `cotan render` does, from the same options.
//
//     cotan::PictureOptions options;
//     options.model = "model.glb";
//     options.size = {640, 480};
//     auto picture = cotan::openPicture(options, /*threads=*/0, {cotan::FrameChoice()});
//     if (!picture)
//         return fail(picture.error().message);
//     picture->view.frame = picture->frames.front();
//     auto renderer = cotan::openPictureRenderer(options, *picture);
//     auto image = cotan::drawShow(**renderer, picture->scene, picture->view, options.show, /*floats=*/false);
//
// Errors name options as the command line does.
#pragma once

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

inline constexpr int kDefaultMemory = 640; // MiB, of one picture

// The limits of reading with so many MiB for one picture, and as much for all of a model together where that is more
// than is usual.
LoadLimits limitsFor(int memory, Pixels pixels = Pixels::all);

// Pictures of one's own on a model: --normal-map, and for models that come without --base-color, --metallic-roughness
// and --occlusion.
struct OwnMaps { // files; empty: what the model has
    std::string normal, baseColor, metallicRoughness, occlusion;
    std::string convention; // of the normal map, gltf where it is empty; without one: how the model's own are read, as
                            // the model says where it is empty
    int material = -1;      // number of the only material that gets them; -1: all
};

// What becomes of a picture.
enum class PictureUse {
    shown,    // light, for people to look at
    radiance, // light, as it is
    data,     // no light
};

struct PictureSize {
    int width = 1280, height = 720; // pixels, each 1..16384

    bool fits() const; // is within those
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

// Lines over the picture.
enum class Edges { none, triangles, seams, all };

// What is behind the model: nothing, which is transparent, or a Backdrop.
enum class Background { none, gradient, blurred, sharp, paper };

// What a picture of a model is to show: the options of `cotan render` and of its window.
struct PictureOptions {
    PictureUse use = PictureUse::shown; // for the command to say
    std::string show = "shaded";        // of showNames; for the command to declare
    std::string model;                  // empty: the built-in scene, or the shape
    std::string shape;                  // plane, sphere, torus or teapot
    OwnMaps maps;
    Up up = Up::y; // of the model's file
    std::string variant;
    std::string animation;
    double time = 0;
    bool turntable = false; // for the command to say: cameras frame all that the model covers as it turns
    PictureSize size;
    std::string camera; // empty: the built-in scene's own, front for a model
    std::string device = "auto";
    Edges edges = Edges::none;
    Shading shading = Shading::pbr;
    Lighting lighting = Lighting::world;
    NormalMapping normalMapping = NormalMapping::shading;
    TangentOrigin tangents = TangentOrigin::stored;
    std::string environment = "studio"; // or none
    double environmentRotation = 0;     // degrees
    float environmentIntensity = 1;
    std::optional<Background> background; // none: by the environment
    ToneMapping toneMapping = ToneMapping::neutral;
    std::optional<float> exposure;        // factor; none: found by metering
    bool ground = true;                   // the model stands on one, which only shows its shadow
    std::optional<double> shadowSoftness; // degrees; none: by the environment (shadowSoftnessOf)
    bool rowsUpward = false;              // as View has it
    Derivatives derivatives = Derivatives::fine;
    int memory = kDefaultMemory;
    int samples = 4;
    bool noShadows = false;
    bool noNormalMaps = false;
    bool pointSampled = false;
    bool specularAntialiasing = false;

    // A model that is not in files, as LoadLimits has it; may be empty.
    std::function<Result<std::vector<std::byte>>(const std::string& name)> readFile;
    std::function<Result<Image>(std::span<const std::byte> bytes, const std::string& name)> decode;
};

// ---- from options to an image --------------------------------------------------------------

// memory: MiB that one picture may take. Puts the maps on the scene's materials in place of what they have; does
// nothing where none was given. A colour or roughness of the material that would be multiplied with a new picture
// becomes one. Errors: ErrorKind::usage for words that are no convention of a tangent-space map, a material that is not
// there, options without a map; ErrorKind::input where a picture cannot be read or no mesh that would show it has
// texture coordinates.
Status applyOwnMaps(const OwnMaps& maps, int memory, Scene& scene);

// The model as it was read, the shape or the built-in scene, without the maps of the options and what frames derive.
// Errors: as loadScene and checkTrianglesDrawn.
Result<Scene> openModel(const PictureOptions& options);

// The same, and where the model has animations what poses it: the scenes of other moments come from poseModel. Scenes
// that an animation poses have what they reach in all of it.
struct MovingModel {
    Scene scene;
    std::unique_ptr<AnimatedGltf> animated; // null where nothing moves
};
Result<MovingModel> openMovingModel(const PictureOptions& options);

// The model at the moment that the options name. images: of a scene that was made of it before, which are copied.
// Errors: as AnimatedGltf::at.
Result<Scene> poseModel(AnimatedGltf& model, const PictureOptions& options, const std::vector<Image>& images);

// A frame, or none for `auto`: the one that the normal maps mean.
using FrameChoice = std::optional<Frame>;

// The frame that is chosen for a scene of that model, with the options' own maps on it.
Frame chosenFrame(const FrameChoice& choice, const PictureOptions& options, const Scene& scene);

// Puts the options' own maps on it, and derives the attributes that the frames need or, where `show` asks for it, makes
// it a scene of telling colours. Returns the frames, each `auto` by its name. Errors: as applyOwnMaps.
Result<std::vector<Frame>> prepareScene(const PictureOptions& options, const std::string& show,
                                        std::initializer_list<FrameChoice> frames, Scene& scene);

// The view that the options name, but for the environment, lights and ground.
Result<View> viewOf(const PictureOptions& options, const Scene& scene);

// Whether the exposure is to be found by meterExposure.
bool meters(const PictureOptions& options);

// A model that is loaded and a view of it; the frame and the output are for the caller to set.
struct Picture {
    Scene scene;
    View view;
    bool meter = false;                                    // the exposure is to be found
    std::vector<Frame> frames;                             // that were asked for, each `auto` by its name
    std::vector<SurfaceEdge> edges;                        // to be drawn over it
    double loadSeconds = 0;                                // for the caller to set
    std::future<Result<std::unique_ptr<Renderer>>> device; // being opened, for openPictureRenderer
};

// Loads the model (or makes the built-in scene), derives the attributes that `frames` need, and
// sets up the view: that of `like`, but for the lights, where it is given. What is to be warned of is in the scene.
// The device is opened beside that; threads: as for openRenderer.
Result<Picture> openPicture(const PictureOptions& options, int threads, std::initializer_list<FrameChoice> frames,
                            const View* like = nullptr);

// Whether --lighting can do with that frame: tangents at the vertices are what tangent-vertex needs.
Status checkLighting(const PictureOptions& options, FrameChoice frame);

// The name of the device that the options ask for: "auto" is the reference renderer for what it alone draws.
std::string deviceOf(const PictureOptions& options);

// The device that the options name, with the picture's scene loaded and its exposure found; its note tells of a
// fallback. Once for a picture, which must outlive it. Errors: those of openRenderer, Renderer::load and draw.
Result<std::unique_ptr<Renderer>> openPictureRenderer(const PictureOptions& options, Picture& picture);

// What --view can show.
const std::vector<std::string>& showNames();

// What of --view a picture shows, as a renderer draws it.
Output outputOf(const std::string& show);

// A picture of what --view names; floats: as a file that keeps them has it. `error` is told the degrees of "error".
// Errors: those of Renderer::draw.
Result<Image> drawShow(Renderer& renderer, const Scene& scene, View view, const std::string& show, bool floats,
                       const std::function<void(const AngleStatistics&)>& error = {});

// Draws the edges that the options ask for over a picture of 8 bits that the renderer has drawn of the view. Nothing
// for pictures that keep floats. Errors: those of Renderer::draw.
Status layEdges(Renderer& renderer, View view, const PictureOptions& options, std::span<const SurfaceEdge> edges,
                Image& picture);

// ---- light ---------------------------------------------------------------------------------

// The environment that the options name; null for none. Errors: those of readImage and environmentOfPicture;
// ErrorKind::usage for a name that is none.
Result<std::shared_ptr<const EnvironmentMap>> openEnvironmentMap(const PictureOptions& options);

// Degrees that the light which casts shadows covers: what the options say, else 3 in the environment `evening`, whose
// sun is small, and 10 in all others.
double shadowSoftnessOf(const PictureOptions& options);

// Sets what else the view has of light, by the options; all but the lights and the ground, which the scene has a part
// in. Errors: ErrorKind::usage for options that need an environment where there is none.
Status lightPicture(const PictureOptions& options, View& view);

// The lights of the scene, or those that the options give it.
std::vector<Light> lightsOf(const PictureOptions& options, const Scene& scene);

// The shadow on the ground, if the options want it; where the view has a ground, at its height.
std::shared_ptr<const GroundMap> groundOf(const PictureOptions& options, const Scene& scene, const View& view);

// ---- turntable -----------------------------------------------------------------------------

// A model that turns once around the vertical, while camera, light and ground stay as they are.

// Points around all that a scene covers while it turns about the vertical through the middle of its box: for
// Scene::reach, so that one camera frames all of it. Circles of 32 points at 33 heights, up to 0.5 % too wide and each
// as wide as its slice of the height. Empty for a scene without finite points.
std::vector<glm::vec3> sweptPoints(const Scene& scene);

// Where the instances of a scene stand, and how they stand when it has turned.
class Turntable {
public:
    explicit Turntable(const Scene& scene); // as it stands now

    // Places the instances of that scene: turned counter-clockwise by so many degrees, as seen from above. Lights and
    // cameras stay.
    void turn(Scene& scene, double degrees) const;

private:
    std::vector<glm::mat4> places_;
    glm::dvec3 middle_{0};
};

} // namespace cotan
