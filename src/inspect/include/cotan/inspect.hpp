// Inspects models: compares the normals of two frames or two models, and reports what is at a pixel.
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

// The value of a statistic over an empty set: NaN, so that every comparison with a limit is false.
inline constexpr double kEmptyStatistics = std::numeric_limits<double>::quiet_NaN();

// Degrees, except `over1` and `over5`, which are fractions in [0,1]. All but `count` are NaN for an empty set.
struct AngleStatistics {
    std::size_t count = 0;
    double mean = kEmptyStatistics;
    double median = kEmptyStatistics;
    double percentile95 = kEmptyStatistics;
    double percentile99 = kEmptyStatistics;
    double maximum = kEmptyStatistics;
    double over1 = kEmptyStatistics;
    double over5 = kEmptyStatistics;
};

// "mean 0.17, median 0.12, 95 % 0.41, 99 % 0.62, max 0.88 degrees; over 1: 0.0 %, over 5: 0.0 %";
// "nothing was compared" for an empty set.
std::string toText(const AngleStatistics& s);

// ---- edges ---------------------------------------------------------------------------------

// The edges of triangles and the seams of texture coordinates, drawn over an image.

enum class EdgeKind : std::uint8_t {
    inner,        // uv are continuous across it
    seam,         // uv are discontinuous
    mirroredSeam, // uv are discontinuous and mirrored on one side
    border,       // belongs to only one triangle
};

struct SurfaceEdge {
    glm::vec3 a{0}, b{0}; // world space
    EdgeKind kind = EdgeKind::inner;
};

// Lists every edge once; vertices at equal positions are the same. uv: the set of the normal map, or set 0 without one.
// Of an edge with more than two triangles, the first two determine the kind.
std::vector<SurfaceEdge> surfaceEdges(const Scene& scene);

struct EdgesShown {
    bool triangles = false; // all edges, in grey
    bool seams = false;     // seams in yellow, mirrored seams in magenta, borders in cyan
};

// Draws the visible parts of the edges one pixel wide. image: 8 bits, rendered with `camera`. depth: Output::depth of
// the same camera and size. Draws nothing if the sizes differ or an image has no pixels.
void drawEdges(Image& image, const Image& depth, const Camera& camera, std::span<const SurfaceEdge> edges,
               EdgesShown shown);

// ---- what is at a pixel --------------------------------------------------------------------

struct PickedPoint {
    int instance = 0, mesh = 0; // indices into the scene
    std::size_t triangle = 0;   // of the mesh
    glm::dvec3 barycentric{1, 0, 0};
    glm::vec3 position{0}; // world space
    float depth = 0;       // along the view direction, world units
};

// Returns the nearest triangle at a point of an image of this size. point: in pixels from the top left corner; the
// centre of the first pixel is (0.5, 0.5). Back faces of single-sided materials are ignored; alpha masks are not
// applied. Tests every triangle: 1 ms per 100,000.
std::optional<PickedPoint> pick(const Scene& scene, const Camera& camera, glm::ivec2 size, glm::vec2 point);

// ---- inspection colours --------------------------------------------------------------------

// Scenes whose colours display a property of the model, drawn instead of the original scene.

enum class Inspection {
    checker, // eight squares along u and v, identified by colour
    density, // texels per unit length over their median: black 0, blue 1/4, green 1, yellow 2, red 4, white 16 and more
    stretch, // ratio of longer to shorter axis: black 1, blue 1.1, green 1.4, yellow 2, red 4, white 10 and more
    shear,   // degrees from a right angle: black 0, blue 0.5, green 2, yellow 5, red 15, white 45
    mirrored,  // blue: not mirrored, orange: mirrored, grey: no area in uv
    w,         // of stored tangents: blue +1, orange -1, grey if there are none
    facing,    // blue outside, red inside
    baseColor, // this and the following: one map with its factor, or one channel
    alpha,
    normalMap,
    normalMapRed,
    normalMapGreen,
    normalMapBlue,
    roughness,
    metallic,
    occlusion,
    emissive,
    mask, // the colour map of materials that have one, its nearest texels without a factor; others grey
};

// Their names on the command line, in enum order: "checker", "density", ... "normal-map-red" and so on.
std::span<const std::string_view> inspectionNames();
std::optional<Inspection> inspectionFromName(std::string_view name);

// Returns the scene with unlit materials that display `inspection`. Cameras and instances are kept. A mesh whose
// instances have different scales is measured as in its first instance.
Scene inspected(Scene scene, Inspection inspection);

// Returns a view that draws an inspected scene with exact colours: no lights, tone curve, dither or background.
View inspectionView(View view);

// ---- one material for all -------------------------------------------------------------------

// Materials that show the relief alone, by name: "clay" is matt and light, "gloss" smooth and dark, so that highlights
// show what a diffuse surface hides.
std::span<const std::string_view> studyNames();

// Gives all materials of the scene this look; nothing for another name. Normal and height maps stay, and what makes a
// surface invisible: the alpha of masked and blended ones, with their colour map.
void applyStudy(Scene& scene, std::string_view name);

// Whether this name of a view (--view) replaces the materials of the scene: an inspection or a study.
bool replacesMaterials(std::string_view view);

// ---- problem areas -------------------------------------------------------------------------

// The worst places on a model of the kinds that lint measures by area.

struct ProblemArea {
    std::string text; // "sheared over 10 degrees: 12.3 % of body, here 63"
    std::size_t mesh = 0;
    double share = 0;    // of the mesh's area, as reported by lint
    double severity = 0; // sort key of the list
    Camera camera; // looks at the worst triangle along its normal; unless hidden, from at least 1/6 of the model away
    std::array<glm::vec3, 3> corners{}; // of that triangle, world space
    std::string_view view;              // the view of `cotan view` and `render` that shows the problem
    bool storedTangents = false;        // that view must use the stored tangents
};

// For each mesh in its first instance and each kind that covers at least 0.1 % of its area: uv without area, stretch
// over kStretched, shear over kSheared, w of stored tangents against the uv, stored tangents over kMaxTangentAngle from
// dP/du (see cotan/lint.hpp). At most `maxCount` areas, the worst first. If something hides the triangle, its camera
// moves closer, unless the triangle would no longer fit into the image.
std::vector<ProblemArea> problemAreas(const Scene& scene, std::size_t maxCount = 50);

// ---- results of comparisons ----------------------------------------------------------------

// Comparison in one view. The degrees are angles between the two normals of a pixel, over the interior pixels of both
// images: those whose eight neighbours are covered too. The images are square, unorm8.
struct ComparedView {
    AngleStatistics degrees;
    Image expected; // normals n as n * 0.5 + 0.5, transparent where nothing is drawn
    Image drawn;
    Image difference; // a heat map: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees; grey: not compared;
                      // for a bake, magenta: the map is of another surface than the one that the camera sees
    std::size_t others = 0, pixels = 0; // for a bake: number of magenta pixels, and of all tested pixels
};

struct ComparedViews {
    std::vector<ComparedView> views;
    AngleStatistics all;                // over the pixels of all views
    std::size_t others = 0, pixels = 0; // for a bake: sums over the views
    bool mapped = false; // a normal map was drawn; if false, nothing is compared: frames do not affect the normals
};

// The reason that a comparison with mapped == false is empty.
inline constexpr const char* kNoNormalMap = "no normal map is drawn";

// ---- one model against another -------------------------------------------------------------

// Whether a model converted to another frame looks like the original: both are drawn from several sides with their own
// frames, and the normals are compared.

inline constexpr int kConversionViews = 5;  // from four sides, 90 degrees apart, and from above
inline constexpr int kConversionSide = 768; // pixels

// A model and the frame that its maps are read with; none: each mesh's own (Mesh::readWith).
struct ModelInFrame {
    Scene scene;
    std::optional<Frame> frame = Frame::cotangent;
    TangentOrigin tangents = TangentOrigin::stored; // the tangents it is drawn with
};

// The normals of one model, one image per camera: square, float32, alpha 1 on surfaces.
struct DrawnSides {
    std::vector<Camera> cameras;
    std::vector<Image> normals;
    bool mapped = false; // some drawn material uses a normal map
};

// Draws both models with the cameras of the first and compares them. side: of an image, in pixels. Afterwards the
// renderer has no scene. Each image advances renderer.progress: kConversionViews images of one model, then of the
// other.
// Errors: those of Renderer::load and Renderer::draw; ErrorKind::input if triangles cover an image too many times.
Result<ComparedViews> verifyConversion(Renderer& renderer, ModelInFrame before, ModelInFrame after,
                                       int side = kConversionSide);

// The two steps of verifyConversion, for callers who cannot hold both models at once.
//
// Draws a model's normals. cameras: empty for kConversionViews around the model. Errors: those of verifyConversion.
Result<DrawnSides> drawSides(Renderer& renderer, ModelInFrame model, std::vector<Camera> cameras = {},
                             int side = kConversionSide);
// Compares images that drawSides has drawn with the same cameras; `after` is compared with the expected `before`.
// Errors: ErrorKind::usage if the number or size of the images differs.
Result<ComparedViews> compareSides(const DrawnSides& before, const DrawnSides& after);

// ---- one frame against another -------------------------------------------------------------

// Whether a view of a scene uses normal maps, so that the frame affects the normals.
bool showsNormalMaps(const Scene& scene, const View& view);

struct ComparedFrames {
    std::array<Image, 2> shaded;
    AngleStatistics normals;                           // degrees between the two normals; empty unless `mapped`
    Image difference;                                  // a heat map of these degrees
    bool mapped = false;                               // showsNormalMaps
    double tangentsOpposed = 0, bitangentsOpposed = 0; // fraction of the pixels; NaN if nothing was compared
    std::string verdict; // distinguishes inverted or rotated tangents from small differences
};

inline constexpr int kComparedFramesImages = 8; // drawn by compareFrames; each advances renderer.progress

// Draws the loaded scene, which is `scene`, with both frames. Errors: those of Renderer::draw.
Result<ComparedFrames> compareFrames(Renderer& renderer, const Scene& scene, View view,
                                     std::array<std::optional<Frame>, 2> frames);

// The statistics, or the reason that there are none.
std::string toText(const ComparedFrames& compared);

struct FrameError {
    AngleStatistics degrees; // empty if no normal map is drawn
    Image difference;        // a heat map
};

// The error of the view's frame relative to another. Draws two images. Errors: those of Renderer::draw.
Result<FrameError> errorAgainst(Frame meant, Renderer& renderer, const Scene& scene, View view);

} // namespace cotan
