// What `render` and `compare` share: which model, seen how, drawn by what.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/draw/painter.hpp"
#include "cotan/frame.hpp"
#include "cotan/inspect/edges.hpp"
#include "cotan/report/statistics.hpp"
#include "cotan/scene/view.hpp"
#include "loading.hpp"
#include "own_maps.hpp"

namespace cotan::app {

// What becomes of a picture.
enum class PictureUse {
    shown,    // light, for people to look at
    radiance, // light, as it is
    data,     // no light
};

struct PictureOptions {
    PictureUse use = PictureUse::shown; // for the command to say
    std::string show = "shaded";        // of showNames; for the command to declare
    std::string model;                  // empty: the built-in scene, or the shape
    std::string shape;                  // plane, sphere, torus or teapot
    OwnMaps maps;
    std::string variant;
    std::string animation;
    double time = 0;
    std::string size = "1280x720";
    std::string camera; // empty: the built-in scene's own, front for a model
    std::string device = "auto";
    std::string edges = "none"; // or triangles, seams, all
    std::string shading = "pbr";
    std::string lighting = "world";
    std::string normalMapping = "shading";
    std::string tangents = "stored";
    std::string environment = "studio"; // or none
    double environmentRotation = 0;     // degrees
    float environmentIntensity = 1;
    std::string background; // empty: by the environment
    std::string toneMapping = "neutral";
    std::string exposure = "auto"; // or a factor
    std::string ground = "on";
    double shadowSoftness = -1; // degrees that the light covers; negative: those of the lamp of the surroundings
    std::string rows = "down";
    std::string derivatives = "fine";
    int memory = kDefaultMemory;
    int samples = 4;
    bool noShadows = false;
    bool noNormalMaps = false;
    bool pointSampled = false;
    bool specularAntialiasing = false;
};

void addPictureOptions(Arguments& a, PictureOptions& options);

// Adds --view.
void addShowOption(Arguments& a, std::string& show);

// The model as it was read, the shape or the built-in scene, without the maps of the options and what frames derive.
// Errors: as loadScene and checkTrianglesDrawn, in words.
Result<Scene> openModel(const PictureOptions& options, const CommonOptions& common);

// Puts the options' own maps on it, and derives the attributes that the frames need or, where `show` asks for it, makes
// it a scene of telling colours. Errors: as applyOwnMaps.
Status prepareScene(const PictureOptions& options, const std::string& show, std::initializer_list<Frame> frames,
                    Scene& scene);

// The view that the options name, but for surroundings, lights and ground.
Result<View> viewOf(const PictureOptions& options, const Scene& scene);

// Whether a picture file of that name keeps floats, so that light stays linear and unlimited in it.
bool keepsFloats(const std::filesystem::path& file);

// Whether the exposure is to be found by meterExposure.
bool meters(const PictureOptions& options);

// A model that is loaded and a view of it; the frame and the output are for the caller to set.
struct Picture {
    Scene scene;
    View view;
    bool meter = false;             // the exposure is to be found
    std::vector<SurfaceEdge> edges; // to be drawn over it
    double loadSeconds = 0;
};

// Loads the model (or makes the built-in scene), derives the attributes that `frames` need, and
// sets up the view: that of `like`, but for the lights, where it is given. Warnings are printed.
Result<Picture> openPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<Frame> frames, const View* like = nullptr);

// Whether --lighting can do with that frame: tangents at the vertices are what tangent-vertex needs.
Status checkLighting(const PictureOptions& options, Frame frame);

// The name of the device that the options ask for: "auto" is the reference renderer for what it alone draws.
std::string deviceOf(const PictureOptions& options);

// The device that the options name, with the picture's scene loaded and its exposure found; a fallback is warned about.
// Lighting in tangent space is drawn by the reference renderer unless another device is named.
// The picture must outlive it.
Result<std::unique_ptr<Painter>> openPicturePainter(const PictureOptions& options, const CommonOptions& common,
                                                    Picture& picture);

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

// Sizes and counts for a report.
Json describeScene(const PictureOptions& options, const Picture& picture);

} // namespace cotan::app
