// A picture of a model, from words to what a renderer is given. Errors name options as the command line does.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cotan/draw/painter.hpp"
#include "cotan/frame.hpp"
#include "cotan/gltf/animated.hpp"
#include "cotan/inspect/edges.hpp"
#include "cotan/picture/options.hpp"
#include "cotan/report/statistics.hpp"
#include "cotan/scene/scene.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

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

// A frame, or none for `auto`: the one that the normal maps mean (cotan/scene/meant_frame.hpp).
using FrameChoice = std::optional<Frame>;

// The frame that is chosen for a scene of that model, with the options' own maps on it.
Frame chosenFrame(const FrameChoice& choice, const PictureOptions& options, const Scene& scene);

// Puts the options' own maps on it, and derives the attributes that the frames need or, where `show` asks for it, makes
// it a scene of telling colours. Returns the frames, each `auto` by its name. Errors: as applyOwnMaps.
Result<std::vector<Frame>> prepareScene(const PictureOptions& options, const std::string& show,
                                        std::initializer_list<FrameChoice> frames, Scene& scene);

// The view that the options name, but for surroundings, lights and ground.
Result<View> viewOf(const PictureOptions& options, const Scene& scene);

// Whether the exposure is to be found by meterExposure.
bool meters(const PictureOptions& options);

// A model that is loaded and a view of it; the frame and the output are for the caller to set.
struct Picture {
    Scene scene;
    View view;
    bool meter = false;                                   // the exposure is to be found
    std::vector<Frame> frames;                            // that were asked for, each `auto` by its name
    std::vector<SurfaceEdge> edges;                       // to be drawn over it
    double loadSeconds = 0;                               // for the caller to set
    std::future<Result<std::unique_ptr<Painter>>> device; // being opened, for openPicturePainter
};

// Loads the model (or makes the built-in scene), derives the attributes that `frames` need, and
// sets up the view: that of `like`, but for the lights, where it is given. What is to be warned of is in the scene.
// The device is opened beside that; threads: as for openPainter.
Result<Picture> openPicture(const PictureOptions& options, int threads, std::initializer_list<FrameChoice> frames,
                            const View* like = nullptr);

// Whether --lighting can do with that frame: tangents at the vertices are what tangent-vertex needs.
Status checkLighting(const PictureOptions& options, FrameChoice frame);

// The name of the device that the options ask for: "auto" is the reference renderer for what it alone draws.
std::string deviceOf(const PictureOptions& options);

// The device that the options name, with the picture's scene loaded and its exposure found; its note tells of a
// fallback. Once for a picture, which must outlive it. Errors: those of openPainter, Painter::load and draw.
Result<std::unique_ptr<Painter>> openPicturePainter(const PictureOptions& options, Picture& picture);

// What --view can show.
const std::vector<std::string>& showNames();

// What of --view a picture shows, as a renderer draws it.
Output outputOf(const std::string& show);

// A picture of what --view names; floats: as a file that keeps them has it. `error` is told the degrees of "error".
// Errors: those of Painter::draw.
Result<Image> drawShow(Painter& painter, const Scene& scene, View view, const std::string& show, bool floats,
                       const std::function<void(const AngleStatistics&)>& error = {});

// Draws the edges that the options ask for over a picture of 8 bits that the painter has drawn of the view. Nothing for
// pictures that keep floats. Errors: those of Painter::draw.
Status layEdges(Painter& painter, View view, const PictureOptions& options, std::span<const SurfaceEdge> edges,
                Image& picture);

} // namespace cotan
