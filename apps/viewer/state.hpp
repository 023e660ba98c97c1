// The state of the viewer. Events and commands change it (input.hpp, commands.hpp); the render thread draws it
// (render_thread.hpp); the window shows it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#include "core/named_values.hpp"
#include "cotan/inspect.hpp"
#include "cotan/scene.hpp"
#include "inspect/angles.hpp"
#include "picture.hpp"
#include "probe.hpp"

namespace cotan::viewer {

// A loaded model, shared by the threads that read it.
struct Model {
    Scene scene;
    Bounds box;
    PictureOptions read;                   // options that it was read with
    std::vector<GltfAnimation> animations; // in the file
    std::uint64_t number = 0;              // unique for each model that is read
};

// The settings in which the two images of a comparison differ.
struct Side {
    std::string frame = "auto"; // or a frame's name
    TangentOrigin tangents = TangentOrigin::stored;
    std::string normalMap;  // a file; empty: the model's own map
    std::string convention; // option text; empty: as the file says
    bool high = false;      // shows State::highModel, if there is one, with its own frames and maps

    friend bool operator==(const Side&, const Side&) = default;
};

enum class Compare {
    off,
    divider, // the first image left of a line, the second right of it
    flip,    // shows one of the two
    angle,   // degrees between their normals, in false colours
};
inline constexpr Named<Compare> kCompares[] = {
    {"off", Compare::off}, {"divider", Compare::divider}, {"flip", Compare::flip}, {"angle", Compare::angle}};

// Actions that the session performs, because they need more than a change of the state.
namespace request {
struct Load {
    std::string model; // a file; empty: the shape or the built-in scene
};
struct LoadHigh {
    std::vector<std::string> files; // of the detailed model, at least one
};
struct Pose {}; // poses the model at picture.time of picture.animation
struct WriteImage {
    std::string file; // empty or "-": an unused name; ".exr": an unused name for a float image
    glm::ivec2 size{0};
};
struct WriteWindow { // the window's contents
    std::string file;
};
struct WriteReport {
    std::string file;
};
struct Copy {
    std::string text;
};
struct Paste {};
struct ChooseFile {
    std::string command = "open"; // that gets the file
};
struct Resize {
    glm::ivec2 size{0};
};
struct LoseSurface {};
struct FindProblemAreas {};
struct RunTask { // taskNamed
    std::string name;
};
struct StopTask {};
struct Quit {};
} // namespace request

using Request =
    std::variant<request::Load, request::LoadHigh, request::Pose, request::WriteImage, request::WriteWindow,
                 request::WriteReport, request::Copy, request::Paste, request::ChooseFile, request::Resize,
                 request::LoseSurface, request::FindProblemAreas, request::RunTask, request::StopTask, request::Quit>;

// The surface under the pointer.
struct Probe {
    std::optional<PickedPoint> hit;
    Probed surface;
    float degrees = -1; // in the image of angles; negative: none
};

// What a task (tasks.hpp) printed.
struct TaskResult {
    std::string title;
    std::vector<std::string> lines;
};

inline constexpr std::size_t kMaxRecent = 10; // files that are remembered

struct State {
    PictureOptions picture; // options of the first image; its camera is the one that a reset returns to
    std::string show = "shaded";
    Side a, b;
    Compare compare = Compare::off;
    bool second = false;  // a flip shows the second
    float divider = 0.5f; // fraction of the width

    glm::ivec2 size{1280, 720}; // pixels
    Camera camera;
    bool cameraMoved = false;    // relative to its position after a reset
    float metered = 0;           // exposure metered for "auto"; 0: not yet
    std::string meteredFrom;     // camera that "auto" meters from, as text; empty: its position after a reset
    bool lightPinned = false;    // the light rotates with the camera
    float pinnedAt = 0;          // azimuth of the camera when it was pinned, degrees
    bool moving = false;         // the user is moving the camera
    float rate = 1, speed = 0.5; // speed of the animation; speed of flying, model sizes per second
    bool playing = false, loops = true;
    bool turning = false; // on the turntable

    std::shared_ptr<const Model> model;                   // null until the first one is read
    std::shared_ptr<const Model> highModel;               // the detailed model that `model` is baked from; null: none
    std::vector<std::string> high;                        // its files
    std::optional<Up> highUp;                             // up axis of these files; none: that of the model
    std::optional<std::vector<ProblemArea>> problemAreas; // none: not searched yet
    std::optional<std::size_t> problemArea;               // the selected one, whose triangle is outlined
    std::vector<std::string> recent;                      // files, most recent first

    bool interfaceShown = true, cheatSheet = false, dark = true, settingsShown = false, problemAreasShown = false;
    bool cardShown = true, statisticsShown = true, resultShown = false;
    float scale = 0; // of the interface; 0: the scale of the screen

    // Input.
    glm::vec2 pointer{-1, -1}, pressedAt{0, 0};
    std::string held; // the button that is down, after the modifiers held: "shift+left"; empty: none
    bool holdsDivider = false;
    bool dragged = false;              // since the button was pressed
    std::vector<std::string> keysDown; // for flying

    // Results.
    Probe probe;
    AngleStatistics statistics;
    std::string statisticsOf; // "cotangent against exact"; empty: none yet
    std::string device, problem, message;
    float progress = -1; // of loading
    std::string loading; // file
    std::string task;    // title of the one that runs; empty: none
    TaskResult result;   // of the last one; empty: none yet
    double drawSeconds = 0;
    std::uint64_t pictures = 0; // drawn so far
    std::size_t loads = 0, failedLoads = 0;
    std::string loadProblem, drawProblem; // the last errors, until resolved; `problem` may be one of them

    std::vector<Request> requests;
};

// Discards the problem areas of another model or pose; if their list is open, requests a new search.
void forgetProblemAreas(State& state);

// The animation selected by picture.animation; null if there is none.
const GltfAnimation* animationOf(const State& state);

// Whether the first or the second image shows the detailed model.
bool showsHigh(const State& state, bool second);

// The up axis of the detailed model's files.
Up highUpOf(const State& state);
// How the first or the second image is drawn, and with which options; `show` is the view, in which detail is clay
// beside a mask, which it has none of.
Side sideOf(const State& state, bool second);
PictureOptions optionsOf(const State& state, bool second);

// Whether the image is about to change, so that a draft of it will do.
inline bool inMotion(const State& state) { return state.moving || state.playing || state.turning; }

// Resets the camera to picture.camera, or to the default of `cotan render`. Does nothing without a model.
void resetCamera(State& state);

// Forgets the detailed model.
void closeHigh(State& state);

// The command line that renders the displayed image: the second one if a flip shows it. Images of the detailed model
// that no command renders are those of `cotan view`.
std::string commandLine(const State& state, const std::string& file, glm::ivec2 size);

// The state as lines "name: value", for tests and people. Numbers are rounded, so that it is the same on every machine.
std::string reportOf(const State& state);

} // namespace cotan::viewer
