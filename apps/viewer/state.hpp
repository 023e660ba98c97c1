// What the viewer is doing. Events and commands change it (input.hpp, commands.hpp); the render thread draws it
// (render_thread.hpp); the window shows it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/inspect.hpp"
#include "cotan/scene.hpp"
#include "inspect/angles.hpp"
#include "picture.hpp"
#include "probe.hpp"

namespace cotan::viewer {

// A model as it was read, shared by the threads that look at it.
struct Model {
    Scene scene;
    Bounds box;
    PictureOptions read;                   // that it was read with
    std::vector<GltfAnimation> animations; // that it has
    std::uint64_t number = 0;              // another for each that is read
};

// What one of two pictures differs in from the other.
struct Side {
    std::string frame = "auto"; // or a frame's name
    TangentOrigin tangents = TangentOrigin::stored;
    std::string normalMap;  // a file; empty: the model's own
    std::string convention; // words; empty: as the file says

    friend bool operator==(const Side&, const Side&) = default;
};

enum class Compare {
    off,
    divider, // the first left of a line, the second right of it
    flip,    // one of the two
    angle,   // degrees between their normals, in false colours
};

// What is done by the session and not by a change of the state.
namespace request {
struct Load {
    std::string model; // a file; empty: the shape or the built-in scene
};
struct Pose {}; // the model at picture.time of picture.animation
struct WritePicture {
    std::string file; // empty or "-": a free name; ".exr": the same of floats
    glm::ivec2 size{0};
};
struct WriteWindow { // what it shows
    std::string file;
};
struct WriteReport {
    std::string file;
};
struct Copy {
    std::string text;
};
struct Paste {};
struct ChooseFile {};
struct Resize {
    glm::ivec2 size{0};
};
struct LoseSurface {};
struct FindProblemAreas {};
struct Quit {};
} // namespace request

using Request = std::variant<request::Load, request::Pose, request::WritePicture, request::WriteWindow,
                             request::WriteReport, request::Copy, request::Paste, request::ChooseFile, request::Resize,
                             request::LoseSurface, request::FindProblemAreas, request::Quit>;

// What is under the pointer.
struct Probe {
    std::optional<PickedPoint> hit;
    Probed surface;
    float degrees = -1; // in the picture of angles; below 0: none
};

inline constexpr std::size_t kMaxRecent = 10; // files that are kept

struct State {
    PictureOptions picture; // of the first picture; its camera: the words that a reset goes back to
    std::string show = "shaded";
    Side a, b;
    Compare compare = Compare::off;
    bool second = false;  // flipped to the second
    float divider = 0.5f; // share of the width

    glm::ivec2 size{1280, 720}; // pixels
    Camera camera;
    bool cameraMoved = false;    // from where a reset puts it
    float metered = 0;           // exposure that "auto" has found; 0: not yet
    std::string meteredFrom;     // camera that "auto" looks from, in words; empty: where a reset puts it
    bool lightPinned = false;    // the light turns with the camera
    float pinnedAt = 0;          // azimuth of the camera when it was pinned, degrees
    bool moving = false;         // the camera is in someone's hand
    float rate = 1, speed = 0.5; // of the animation; of flying, model sizes a second
    bool playing = false, loops = true;

    std::shared_ptr<const Model> model;                   // null until the first one is read
    std::optional<std::vector<ProblemArea>> problemAreas; // none: nobody has looked yet
    std::optional<std::size_t> problemArea; // of those, the one that was gone to: its triangle is outlined
    std::vector<std::string> recent;        // files, the latest first

    bool interfaceShown = true, cheatSheet = false, dark = true, settingsShown = false, problemAreasShown = false;
    bool cardShown = true, statisticsShown = true;
    float scale = 0; // of the interface; 0: as the screen asks for

    // Input.
    glm::vec2 pointer{-1, -1}, pressedAt{0, 0};
    std::string held; // the button that is down, with what was held: "shift+left"; empty: none
    bool holdsDivider = false;
    bool dragged = false;              // since the button went down
    std::vector<std::string> keysDown; // of flying

    // What came back.
    Probe probe;
    AngleStatistics statistics;
    std::string statisticsOf; // "cotangent against exact"; empty: none yet
    std::string device, problem, said;
    float progress = -1; // of loading
    std::string loading; // file
    double drawSeconds = 0;
    std::uint64_t pictures = 0; // drawn so far
    std::size_t loads = 0, failedLoads = 0;
    std::string loadProblem, drawProblem; // what went wrong last, until it works again; `problem` may be one of them

    std::vector<Request> requests;
};

// The hot spots are those of another model or moment; finds them again where they are listed.
void forgetProblemAreas(State& state);

// The animation of the model that picture.animation names; null where there is none.
const GltfAnimation* animationOf(const State& state);

// What draws the first picture, or the second.
PictureOptions optionsOf(const State& state, bool second);
inline const Side& sideOf(const State& state, bool second) { return second ? state.b : state.a; }

// The camera that a reset gives: by picture.camera, or the default of `cotan render`. Does nothing without a model.
void resetCamera(State& state);

// The command that writes the picture: the second one where a flip shows it.
std::string commandLine(const State& state, const std::string& file, glm::ivec2 size);

// The state in lines "name: value" for tests and people; numbers rounded, so that it is the same everywhere.
std::string reportOf(const State& state);

} // namespace cotan::viewer
