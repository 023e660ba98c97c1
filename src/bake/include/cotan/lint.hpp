// Says how far off a model's normal maps will be without stored tangents, before anything is drawn:
//
//     auto scene = cotan::loadScene("model.glb");
//     if (!scene)
//         return fail(scene.error().message);
//     const cotan::LintReport report = cotan::lintScene(*scene);
//     std::printf("%s\n", report.recommendation.c_str());
//     const cotan::LintCheck check = cotan::checkLimits(report, {.degrees = 5});
//     for (const cotan::LintFailure& failure : check.failures)
//         std::printf("%s\n", failure.text.c_str());
//
// All angles in degrees, areas of the world, shares of the primitive's area in [0,1]. Part of the library cotan::bake.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// ---- statistics of a weighted set ----------------------------------------------------------

// Of an empty set, or one without weight, the count is 0 and the rest NaN: no comparison with a limit holds.
struct ValueSummary {
    std::size_t count = 0; // of the values that count
    double mean = std::numeric_limits<double>::quiet_NaN();
    double percentile95 =
        std::numeric_limits<double>::quiet_NaN(); // the smallest that 95 % of the weight do not exceed
    double maximum = std::numeric_limits<double>::quiet_NaN();
};

// ---- the report ----------------------------------------------------------------------------

inline constexpr double kStretched = 1.2; // the longer gradient over the shorter: an orthonormal frame is 2 degrees off
inline constexpr double kSheared = 10;    // degrees between the gradients of u and v and a right angle
inline constexpr double kTurned = 45;     // degrees between a stored tangent and dP/du
inline constexpr std::size_t kMaxPlacings = 8; // of one mesh
inline constexpr double kTestTilt = 35;        // degrees: the texel whose step across edges is measured

// Shares are NaN where there is no area to take them of.
struct UvQuality {
    double area = 0;
    double degenerate = 0; // uv without area: points and lines
    double mirrored = 0;
    double overlapping = 0;         // on texels that this or another primitive of the same image uses again
    double overlappingMirrored = 0; // of those: texels that are used in both orientations
    double stretched = 0;           // over kStretched
    double sheared = 0;             // over kSheared
    ValueSummary stretch;           // ratio, at least 1; degenerate triangles left out
    ValueSummary shear;             // degrees
    double gradient = 0;            // the longer uv gradient per unit of length, median; 0: there is none
    double largestUv = 0;           // magnitude
};

inline constexpr std::size_t kMaxEdges = 1 << 20; // whose steps are measured

// Of more than kMaxEdges, every second, third and so on is measured; `edges` counts all.
struct EdgeSteps {
    std::size_t edges = 0;  // interior: position, normal and uv agree on both sides, and the orientation
    ValueSummary cotangent; // of a texel tilted by kTestTilt, over eight directions, weighted by area
    ValueSummary orthonormal;
};

struct StoredTangents {
    bool present = false;
    double reversedW = 0; // share of area where the bitangent points against the uv
    double turned = 0;    // share of area where the tangent is over kTurned from dP/du
    ValueSummary angle;   // degrees from dP/du in the plane of the normal; of nothing, the shares say nothing
};

// How another frame reads the map, which was made for PrimitiveLint::madeFor.
struct Reading {
    std::string name; // of the frame; "stored" for mikktspace with the tangents of the file
    ValueSummary error;
};

// For each of the frames that may be advised.
struct FrameSummaries {
    ValueSummary orthonormal, cotangent, smooth;
};

struct PrimitiveLint {
    std::string mesh, material;
    // Instances of one mesh that stretch it differently are reported apart: this is number `placing`, from
    // 0, of `placings`; of those only the first kMaxPlacings.
    std::size_t placing = 0, placings = 1;
    // An extension of the material that reads tangents without a map of its own that could be converted; and how far
    // what it reads turns with the frames that may be advised (directionTurn), empty where that is not known.
    std::string tangentsFor;
    FrameSummaries turned;
    int image = -1;        // of the normal map; -1: none
    bool unread = false;   // there is one, in a format that is not read: nothing is known of its pixels
    std::string notJudged; // why a normal map that there is was not judged; empty if it was
    std::size_t triangles = 0;
    bool hasUv = false;
    UvQuality uv;
    EdgeSteps steps;
    StoredTangents stored;
    Frame madeFor = Frame::mikktspace; // what the map is for: the frame that the file names, or else glTF's
    // cotangent, orthonormal, smooth, exact, triangle and, if present and what the map is for, stored; empty without a
    // map
    std::vector<Reading> readings;
    double precision = 0; // degrees by rounding of float derivatives at LintOptions::distance
    double closest = 0;   // the distance at which that is half a degree; both 0 where uv have no gradient
};

// Which way green points, from the map alone, and which way the material reads it. `cotan map detect` gives
// the same verdict.
struct GreenEvidence {
    int image = -1;
    std::string name;
    bool declaredUp = true; // green up the picture, as the material reads it
    maps::GreenVerdict verdict;

    bool decided() const { return verdict.green != maps::Green::undecidable; }
    bool asDeclared() const { return !decided() || (verdict.green == maps::Green::up) == declaredUp; }
};

// One normal map read as it is with the frames that may be advised, against MikkTSpace with the stored tangents,
// where these are to be trusted: what `convert` decides by (mapError, fitsAsItIs).
struct MapFit : FrameSummaries { // empty where nothing was judged: no pixels, or nothing shows the map
    int image = -1;
    std::string name;
};

// Reading the maps as they are comes first: readNamed with the frame that the file names, readOrthonormal as MikkTSpace
// without tangents. Maps are to be converted only where that leaves more than a converted map does in other engines.
enum class Advice { nothing, readNamed, readOrthonormal, convertToOrthonormal, convertToCotangent, convertToSmooth };

struct LintReport {
    std::vector<PrimitiveLint> primitives;
    std::vector<GreenEvidence> maps;
    std::vector<MapFit> fits;
    double distance = 0;        // the viewing distance used, world units
    std::optional<Frame> named; // what the file says that its maps are for (namedFrame)
    Advice advice = Advice::nothing;
    // Stored tangents contradict the uv on more than a tenth of the area, and a map shows that they are wrong: its
    // green is as declared. Where no map can tell, the model stays what its tangents show.
    bool distrustStored = false;
    // What `convert` to the advised frame would do: how many maps it would make anew, how many it would leave, and
    // whether it would drop tangents. With neither it has nothing to do.
    std::size_t mapsConverted = 0, mapsKept = 0;
    bool dropsTangents = false;
    // In sentences, each empty where there is nothing to say: what is wrong with the model as it is, what is seen
    // without tangents, where most, what to do, which maps were not judged, what else reads tangents.
    std::string defects, seen, worst, advised, notJudged, otherReaders;
    std::string recommendation; // all of these
};

// The frame that the report's advice names; orthonormal where it advises nothing.
Frame frameOf(const LintReport& report);

struct LintOptions {
    double distance = 0;    // world units from eye to surface; 0: where the whole model fills the picture
    std::size_t memory = 0; // bytes that may be taken besides the scene; 0: any number
};

// About how many bytes the triangles take at most in lintScene, besides the scene. What it takes for any scene, less
// than 32 MiB, is not counted.
std::size_t lintBytes(const Scene& scene);

// Looks at every primitive (mesh) of the scene as its instances move it: those that differ by rotations,
// mirroring and uniform scales count as one. Never fails: primitives without triangles or uv are listed with what is
// known; of a scene that does not hold together (checkScene) only `defects` says so. options.memory is not asked.
LintReport lintScene(const Scene& scene, const LintOptions& options = {});
// The same with progress, on the thread of the caller: four times for each mesh, and at the end. Errors:
// ErrorKind::stopped; ErrorKind::input, before anything is done, where lintBytes are more than options.memory.
Result<LintReport> lintScene(const Scene& scene, const LintOptions& options, const Progress& progress);

// ---- limits --------------------------------------------------------------------------------

// What of a report is over the limits that a caller sets: the verdict of a check.

struct LintLimits {
    double degrees = -1; // that the error with `frame` may exceed on 5 % of the area; -1: no limit
    double area = -1; // % of a primitive's area: degenerate uv, uv overlapping mirrored, stored tangents against the uv
    std::string frame = "orthonormal"; // a Reading::name

    // Whether anything is to be checked.
    bool any() const { return degrees >= 0 || area >= 0; }
};

// One reason why a model fails.
struct LintFailure {
    // reading, rounding, degenerate_uv, mirrored_overlap, reversed_w, turned_tangents: a value over its limit.
    // reversed_green, not_judged: there is no limit that would allow them.
    std::string kind;
    std::string where;            // nameOf(primitive), or the name of the map; empty: the whole model
    double value = 0, limit = -1; // in degrees or % of the area; limit -1: it has none
    std::string text;             // one sentence, names included
    // What it is about, as the file names it; empty where it is about something else, or the file gives no name.
    std::string mesh = {}, material = {}, map = {};
    bool percent = false;    // value and limit are % of the primitive's area, not degrees
    std::string beside = {}; // what else helps to read the value: the means beside it; empty if nothing does
};

// A check passes where nothing fails. Without any limit nothing is checked, and it passes.
struct LintCheck {
    LintLimits limits;
    std::vector<LintFailure> failures;

    bool passed() const { return failures.empty(); }
};

// Each primitive is held to the limits by itself, not the model as a whole.
// Every check, whichever limit it has, fails for a map whose green points the other way than the file says. One in
// degrees fails also for a map whose pixels were not read, and where there are maps and none was judged. A primitive's
// area in % is compared with limits.area, its degrees with limits.degrees.
LintCheck checkLimits(const LintReport& report, const LintLimits& limits);

// The names that LintLimits::frame may have: those of all readings.
const std::vector<std::string>& readingNames();

// What is wrong with the file as it is, one line each: maps whose green points the other way than it says.
std::vector<std::string> lintWarnings(const LintReport& report);

// "mesh, material NAME", with the placing where there are several.
std::string nameOf(const PrimitiveLint& primitive, std::size_t index);

} // namespace cotan
