// Predicts the error of a model's normal maps without stored tangents, before anything is drawn:
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
// Angles are in degrees, areas in world units, fractions of area in [0,1]. Part of the library cotan::bake.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/frame_choice.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// ---- statistics of a weighted set ----------------------------------------------------------

// For an empty set, or one without weight, the count is 0 and the rest NaN, so that no comparison with a limit holds.
struct ValueSummary {
    std::size_t count = 0; // of the values with weight
    double mean = std::numeric_limits<double>::quiet_NaN();
    double percentile95 =
        std::numeric_limits<double>::quiet_NaN(); // smallest value that 95 % of the weight do not exceed
    double maximum = std::numeric_limits<double>::quiet_NaN();
};

// ---- the report ----------------------------------------------------------------------------

inline constexpr double kStretched = 1.2; // longer gradient over shorter: an orthonormal frame errs by 2 degrees
inline constexpr double kSheared = 10;    // degrees by which the angle between the gradients of u and v differs from 90
inline constexpr double kMaxTangentAngle = 45; // degrees between a stored tangent and dP/du
inline constexpr std::size_t kMaxPlacings = 8; // per mesh
inline constexpr double kTestTilt = 35;        // degrees: tilt of the texel whose step across edges is measured

// Fractions are NaN if the primitive has no area.
struct UvQuality {
    double area = 0;
    double degenerate = 0; // uv without area: points and lines
    double mirrored = 0;
    double overlapping = 0;         // on texels that this or another primitive with the same image uses again
    double overlappingMirrored = 0; // of those: on texels that are used in both orientations
    double stretched = 0;           // stretch over kStretched
    double sheared = 0;             // shear over kSheared
    ValueSummary stretch;           // ratio, at least 1; without degenerate triangles
    ValueSummary shear;             // degrees
    double gradient = 0;            // median of the longer uv gradient per unit of length; 0: none
    double largestUv = 0;           // maximum of |u| and |v|
};

inline constexpr std::size_t kMaxEdges = 1 << 20; // maximum number whose steps are measured

// If there are more than kMaxEdges, only every second, third and so on is measured; `edges` counts all.
struct EdgeSteps {
    std::size_t edges = 0;  // interior: both sides have the same position, normal, uv and orientation
    ValueSummary cotangent; // of a texel tilted by kTestTilt in eight directions, weighted by area
    ValueSummary orthonormal;
};

struct StoredTangents {
    bool present = false;
    double reversedW = 0; // fraction of the area where the bitangent points against the uv
    double rotated = 0;   // fraction of the area where the tangent is over kMaxTangentAngle from dP/du
    ValueSummary angle;   // degrees from dP/du in the plane of the normal; if empty, the fractions mean nothing
};

// Error of reading the map, which was made for PrimitiveLint::madeFor, with another frame.
struct Reading {
    std::string name; // of the frame; "stored" for mikktspace with the file's tangents
    ValueSummary error;
};

// A summary for each frame that may be advised.
struct FrameSummaries {
    ValueSummary orthonormal, cotangent, smooth;
};

struct PrimitiveLint {
    std::size_t meshIndex = 0; // into Scene::meshes
    std::string mesh, material;
    // Instances that stretch a mesh differently are reported separately: this is number `placing`, from 0, of
    // `placings`, of which only the first kMaxPlacings are reported.
    std::size_t placing = 0, placings = 1;
    // Extension of the material that reads tangents and has no map of its own that could be converted, or that requires
    // them because the surface has no normal map. `rotation`: how far the direction that it reads rotates with each
    // frame that may be advised (directionTurn); empty if that does not matter.
    std::string tangentsFor;
    FrameSummaries rotation;
    int image = -1;        // of the normal map; -1: none
    bool unread = false;   // the map has a format that is not read: its pixels are unknown
    std::string notJudged; // why an existing normal map was not judged; empty if it was
    std::size_t triangles = 0;
    bool hasUv = false;
    UvQuality uv;
    EdgeSteps steps;
    StoredTangents stored;
    Frame madeFor = Frame::mikktspace; // frame of the map: the one that the file names, otherwise glTF's
    // cotangent, orthonormal, smooth, exact, triangle; of a map for mikktspace also area-weighted and, with tangents in
    // the file, stored. Empty without a map
    std::vector<Reading> readings;
    double precision = 0; // degrees of error by rounding of float derivatives at LintOptions::distance
    double closest = 0;   // distance at which that is half a degree; both are 0 if uv have no gradient
};

// What a map alone shows: which way green points, and which way the material reads it, as in `cotan map detect`; and
// what is wrong with the map as a file.
struct GreenEvidence {
    int image = -1;
    std::string name;
    bool declaredUp = true; // green points up the image, as the material reads it
    // Some surfaces, or all that show it, read it with green reversed without their tangents (scene/normal_maps.hpp).
    bool reversedByTangents = false, reversedEverywhere = false;
    maps::GreenVerdict verdict = {};
    std::vector<maps::Fault> faults = {}; // maps::faultsInModel, without Kind::greenDown
    std::string sentence = {};            // these, with the command that fixes them; empty without faults
    std::string note = {};                // maps::noteOf

    bool decided() const { return verdict.green != maps::Green::undecidable; }
    bool asDeclared() const { return !decided() || (verdict.green == maps::Green::up) == declaredUp; }
};

// Errors of one normal map read unchanged with each frame that may be advised, against the frame that it is for with
// the stored tangents, if these are trusted. `convert` decides by the same errors (mapError, fitsAsItIs).
struct MapFit : FrameSummaries { // empty if nothing was judged: no pixels, or no surface shows the map
    int image = -1;
    std::string name;
};

// readNamed: with the frame that the file names; readChosen: each primitive with the frame of its decision.
enum class Advice { nothing, readNamed, readChosen };

struct LintReport {
    std::vector<PrimitiveLint> primitives;
    std::vector<GreenEvidence> maps;
    std::vector<MapFit> fits;
    std::vector<FrameDecision> decisions; // one for each mesh, with all candidates
    double distance = 0;                  // viewing distance used, world units
    std::optional<Frame> named;           // frame that the file names for its maps (namedFrame)
    Advice advice = Advice::nothing;
    // Stored tangents contradict the uv on more than a tenth of the area, and a map proves them wrong: its green is as
    // declared. If no map can tell, the stored tangents are trusted.
    bool distrustStored = false;
    // Meshes whose tangents `convert` would drop, and those that would keep them. If it drops none, there is nothing to
    // do.
    std::size_t dropping = 0, keeping = 0;
    // Sentences, empty if there is nothing to say: defects of the model as it is, the visible error without tangents,
    // the worst primitive, the advice, maps that were not judged, other readers of tangents.
    std::string defects, seen, worst, advised, notJudged, otherReaders;
    std::string recommendation;     // all of these, joined
    std::vector<std::string> hints; // one line each: hard edges that uv do not split
};

// The frame that the report advises: of chosen ones, that of most meshes. orthonormal if it advises nothing.
Frame frameOf(const LintReport& report);

struct LintOptions {
    double distance = 0;    // world units from eye to surface; 0: where the whole model just fits the image
    std::size_t memory = 0; // bytes that lint may take besides the scene; 0: no limit
    ChoiceLimits limits{};  // of LintReport::decisions
};

// About the maximum number of bytes that the triangles take in lintScene, besides the scene. The memory that every
// scene takes, less than 32 MiB, is not counted.
std::size_t lintBytes(const Scene& scene);

// Checks every primitive (mesh) of the scene as its instances transform it: transforms that differ by rotation,
// mirroring and uniform scale count as one. Never fails: primitives without triangles or uv are listed with what is
// known; for an inconsistent scene (checkScene) only `defects` and `recommendation` are set. Ignores options.memory.
LintReport lintScene(const Scene& scene, const LintOptions& options = {});
// The same with progress, on the caller's thread: once for each mesh, three times for each of its placings, and at the
// end. Errors: ErrorKind::stopped; ErrorKind::input, before anything is done, if lintBytes exceeds options.memory.
Result<LintReport> lintScene(const Scene& scene, const LintOptions& options, const Progress& progress);

// ---- limits --------------------------------------------------------------------------------

// Compares a report with limits that the caller sets.

struct LintLimits {
    double degrees = -1; // maximum error with `frame` on 95 % of the area; -1: no limit
    double area = -1;    // maximum % of a primitive's area: degenerate uv, mirrored overlap, wrong stored tangents
    std::string frame = "orthonormal"; // a Reading::name

    // Whether any limit is set.
    bool any() const { return degrees >= 0 || area >= 0; }
};

// One reason why a model fails.
struct LintFailure {
    // reading, rounding, degenerate_uv, mirrored_overlap, reversed_w, turned_tangents: a value over its limit.
    // reversed_green, broken_map, not_judged: no limit allows them.
    std::string kind;
    std::string where;            // nameOf(primitive), or the name of the map; empty: the whole model
    double value = 0, limit = -1; // in degrees or % of the area; limit -1: none
    std::string text;             // one sentence, names included
    // What fails, as the file names it; empty if it is something else, or unnamed.
    std::string mesh = {}, material = {}, map = {};
    bool percent = false;    // value and limit are % of the primitive's area, not degrees
    std::string beside = {}; // context of the value: the means; empty if there is none
};

// A check passes if nothing fails. Without any limit nothing is checked, and it passes.
struct LintCheck {
    LintLimits limits;
    std::vector<LintFailure> failures;

    bool passed() const { return failures.empty(); }
};

// Compares each primitive by itself, not the whole model: areas in % with limits.area, angles with limits.degrees.
// Under any limit, a map whose green points against the file's declaration fails, and one whose faults change the light
// (maps::changesLight). Under a limit in degrees, a map whose pixels were not read fails too, and so does a model with
// maps of which none was judged.
LintCheck checkLimits(const LintReport& report, const LintLimits& limits);

// The names that LintLimits::frame may have: those of all readings.
const std::vector<std::string>& readingNames();

// Defects of the file, one line each: maps whose green points the other way than declared, odd maps (noteOf), and
// hard edges that uv do not split.
std::vector<std::string> lintWarnings(const LintReport& report);

// "mesh, material NAME", with the placing if there are several.
std::string nameOf(const PrimitiveLint& primitive, std::size_t index);

} // namespace cotan
