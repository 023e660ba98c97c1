// Looks closely at a model: compares how two frames or two models draw, and says what is at a pixel.
//
//     auto renderer = cotan::openRenderer();
//     auto loaded = (*renderer)->load(scene);
//     auto compared = cotan::compareFrames(**renderer, scene, view, {cotan::Frame::orthonormal, cotan::Frame::exact});
//     if (!compared)
//         return fail(compared.error().message);
//     std::printf("%s\n", toText(*compared).c_str());
//     cotan::writeImage("difference.png", compared->difference);
//     for (const cotan::ProblemArea& area : cotan::problemAreas(scene))
//         std::printf("%s\n", area.text.c_str());
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/frame.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- statistics of angles -------------------------------------------------------------------

// What a statistic of nothing is: no number, so that no comparison with a limit holds.
inline constexpr double kOfNothing = std::numeric_limits<double>::quiet_NaN();

// All in degrees; `over1` and `over5` are shares in [0,1]. All but `count` are NaN for an empty set.
struct AngleStatistics {
    std::size_t count = 0;
    double mean = kOfNothing;
    double median = kOfNothing;
    double percentile95 = kOfNothing;
    double percentile99 = kOfNothing;
    double maximum = kOfNothing;
    double over1 = kOfNothing;
    double over5 = kOfNothing;
};

// "mean 0.17, median 0.12, 95 % 0.41, 99 % 0.62, max 0.88 degrees; over 1: 0.0 %, over 5: 0.0 %";
// "nothing was compared" for an empty set.
std::string toText(const AngleStatistics& s);

// ---- edges ---------------------------------------------------------------------------------

// The edges of triangles, and those where texture coordinates break, over a picture.

enum class EdgeKind : std::uint8_t {
    inner,        // uv go on across it
    seam,         // they do not
    mirroredSeam, // and are mirrored on one side
    border,       // of one triangle only
};

struct SurfaceEdge {
    glm::vec3 a{0}, b{0}; // world
    EdgeKind kind = EdgeKind::inner;
};

// Every edge once; vertices at one position count as one. uv: those of the normal map, set 0 where there is none. Of an
// edge of more than two triangles the first two count.
std::vector<SurfaceEdge> surfaceEdges(const Scene& scene);

struct EdgesShown {
    bool triangles = false; // all; grey
    bool seams = false;     // seams in yellow, mirrored ones in magenta, borders in cyan
};

// Draws them one pixel wide where they are not hidden. picture: 8 bits, what the camera sees. depth: a picture of
// Output::depth of the same camera and size.
void drawEdges(Image& picture, const Image& depth, const Camera& camera, std::span<const SurfaceEdge> edges,
               EdgesShown shown);

// ---- what is at a pixel --------------------------------------------------------------------

struct PickedPoint {
    int instance = 0, mesh = 0; // indices into the scene
    std::size_t triangle = 0;   // of the mesh
    glm::dvec3 barycentric{1, 0, 0};
    glm::vec3 position{0}; // world
    float depth = 0;       // along the view, world units
};

// The nearest triangle that the camera sees at a place of a picture of that size, in pixels from its top left corner;
// the middle of the first pixel is (0.5, 0.5). Back faces of single-sided materials are not seen; what a mask cuts out
// is. Looks at every triangle: 100,000 take a millisecond.
std::optional<PickedPoint> pick(const Scene& scene, const Camera& camera, glm::ivec2 size, glm::vec2 place);

// ---- telling colours -----------------------------------------------------------------------

// A scene in colours that show what a model is made of, to be drawn in place of it.

enum class Inspection {
    checker,   // eight squares along u and v, numbered by colour
    density,   // texels per unit of length: green as the median, blue a quarter of it and less, red four times and more
    stretch,   // the longer axis over the shorter: black 1, blue 1.1, green 1.4, yellow 2, red 4, white 10 and more
    shear,     // degrees from a right angle: black 0, blue 0.5, green 2, yellow 5, red 15, white 45
    mirrored,  // blue as it is, orange mirrored, grey without area in uv
    w,         // of stored tangents: blue +1, orange -1, grey where there are none
    facing,    // blue from outside, red from inside
    baseColor, // this and what follows: one map with its factor, or a channel of it
    alpha,
    normalMap,
    normalMapRed,
    normalMapGreen,
    normalMapBlue,
    roughness,
    metallic,
    occlusion,
    emissive,
};

// Their names on the command line, in that order: "checker", "density", ... "normal-map-red" and so on.
std::span<const std::string_view> inspectionNames();
std::optional<Inspection> inspectionFromName(std::string_view name);

// The scene with unlit materials that show it. Cameras and instances stay. A mesh that several instances stretch
// differently counts as the first of them shows it.
Scene inspected(Scene scene, Inspection inspection);

// The view that draws it with its colours as they are: without light, tone curve and background.
View inspectionView(View view);

// ---- problem areas -------------------------------------------------------------------------

// Where on a model to look: the worst places of what lint takes shares of.

struct ProblemArea {
    std::string text; // "sheared over 10 degrees: 12.3 % of body, here 63"
    std::size_t mesh = 0;
    double share = 0;    // of the mesh's area, as lint has it
    double severity = 0; // what the list is sorted by
    Camera camera; // looks at the worst triangle of its kind along its normal, with an eighth of the model around it
    std::array<glm::vec3, 3> corners{}; // of that triangle, world
    std::string_view view;              // the view of `cotan view` and `render` that shows what is wrong
    bool storedTangents = false;        // which that view shows with the stored tangents only
};

// For each mesh, as its first instance moves it, and each of these that lint (cotan/lint.hpp) finds on it: uv
// without area, stretched over kStretched, sheared over kSheared; w of stored tangents against the uv, stored tangents
// turned over kTurned. The worst first; at most `most`. Where something stands between the camera and its triangle, the
// camera is nearer, if the triangle fits into the picture from there.
std::vector<ProblemArea> problemAreas(const Scene& scene, std::size_t most = 50);

// ---- faults of maps ------------------------------------------------------------------------

// A sentence for each normal map that was saved as a colour, has channels exchanged or is broken otherwise, by name,
// with the command that fixes it; green that points down where it is declared up counts, too. Empty where all are good.
// Each map is looked at once: a second for 4096 x 4096 texels.
std::vector<std::string> mapFaults(const Scene& scene);

// ---- what a comparison gives ---------------------------------------------------------------

// Seen from one side. The degrees are angles between the two normals of a pixel, over the pixels that show the
// inside of a surface in both: those whose eight neighbours show one, too. The pictures are square, unorm8.
struct ComparedView {
    AngleStatistics degrees;
    Image expected; // normals n as n * 0.5 + 0.5, transparent where nothing is
    Image drawn;
    Image difference; // a heat map: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees; grey: not compared;
                      // of a bake magenta: the map shows another surface than the camera sees
    std::size_t others = 0, pixels = 0; // of a bake: the magenta ones, and all for which that is known
};

struct ComparedViews {
    std::vector<ComparedView> views;
    AngleStatistics all;                // over the pixels of all views
    std::size_t others = 0, pixels = 0; // of a bake: the sums over the views
    bool mapped = false; // a normal map was drawn; if not, nothing is compared, as no frame has a part in the normals
};

// Why a comparison with mapped == false has nothing in it.
inline constexpr const char* kNoNormalMap = "no normal map is drawn";

// ---- one model against another -------------------------------------------------------------

// Whether a model that was made for another frame looks like the original: both drawn from several sides with
// their own frames, and the normals compared.

inline constexpr int kConversionViews = 5;  // from the front, turned by quarters, and from above
inline constexpr int kConversionSide = 768; // pixels

// A model and the frame that its maps are for.
struct ModelInFrame {
    Scene scene;
    Frame frame = Frame::cotangent;
    TangentOrigin tangents = TangentOrigin::stored; // that are drawn with
};

// The normals of one model, one picture a camera: square, float32, alpha 1 where there is surface.
struct DrawnSides {
    std::vector<Camera> cameras;
    std::vector<Image> normals;
    bool mapped = false; // something that is drawn reads a normal map
};

// Draws both models with the cameras of the first and compares. side: of a picture, in pixels.
// The renderer has no scene afterwards. It reports each picture to renderer.progress: kConversionViews of the
// one model, then as many of the other.
// Errors: those of Renderer::load and Renderer::draw; ErrorKind::input where triangles cover a picture too many times.
Result<ComparedViews> verifyConversion(Renderer& renderer, ModelInFrame before, ModelInFrame after,
                                       int side = kConversionSide);

// The two steps of it, for callers who do not want to hold both models at once.
//
// Draws a model's normals. cameras: empty for kConversionViews around the model. Errors: as above.
Result<DrawnSides> drawSides(Renderer& renderer, ModelInFrame model, std::vector<Camera> cameras = {},
                             int side = kConversionSide);
// Compares what drawSides has drawn with the same cameras; `after` counts as drawn, `before` as expected.
// Errors: ErrorKind::usage for pictures of another number or size.
Result<ComparedViews> compareSides(const DrawnSides& before, const DrawnSides& after);

// ---- one frame against another -------------------------------------------------------------

// Whether a view of a scene shows normal maps, so that the frame has a part in the normals.
bool showsNormalMaps(const Scene& scene, const View& view);

struct ComparedFrames {
    std::array<Image, 2> shaded;
    AngleStatistics normals;                           // degrees between the two; empty unless `mapped`
    Image difference;                                  // a heat map of the same
    bool mapped = false;                               // showsNormalMaps
    double tangentsOpposed = 0, bitangentsOpposed = 0; // share of the pixels; NaN where nothing was compared
    std::string verdict; // what tells an inverted or turned tangent from a small difference
};

inline constexpr int kComparedFramesPictures = 8; // that compareFrames draws, each told to renderer.progress

// Draws what is loaded, `scene`, with both. Errors: those of Renderer::draw.
Result<ComparedFrames> compareFrames(Renderer& renderer, const Scene& scene, View view, std::array<Frame, 2> frames);

// The figures, or why there are none.
std::string toText(const ComparedFrames& compared);

struct FrameError {
    AngleStatistics degrees; // empty where no normal map is drawn
    Image difference;        // a heat map
};

// How far the view's frame is from the exact one. Draws two pictures. Errors: those of Renderer::draw.
Result<FrameError> errorAgainstExact(Renderer& renderer, const Scene& scene, View view);

} // namespace cotan
