// How a scene is drawn: camera, lights, frame and output.
//
//     cotan::View view;
//     view.width = 640;
//     view.height = 480;
//     view.camera = cotan::frontCamera(scene, view.width, view.height);
//     view.lights = cotan::defaultLights();
//     view.frame = cotan::Frame::smooth;
//     cotan::deriveVertexFrames(scene, view.frame, cotan::TangentOrigin::stored); // attributes that the frame reads
//     if (auto studio = cotan::builtinEnvironment("studio"))
//         view.environmentMap = std::make_shared<cotan::EnvironmentMap>(*std::move(studio));
//     auto image = cotan::drawView(scene, view); // cotan/render.hpp
//
// Both renderers take a View, so their images can be compared. Part of the library cotan::scene.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/frame.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// ---- the view ------------------------------------------------------------------------------

// What the image shows. All outputs except `shaded` are float32: x, y, z, and alpha: 1 on a surface, 0 elsewhere.
enum class Output {
    shaded,    // unorm8, sRGB-encoded and tone mapped; linear float32 if View::linearOutput
    normal,    // perturbed world normal, unit
    tangent,   // frame.t, world
    bitangent, // frame.b, world
    uv,        // transformed uv of the normal map (uv set 0 if there is no map); z = 0
    depth,     // distance along the view axis in world units, in x; y = z = 0
};

enum class Shading { pbr, blinnPhong };

// How unbounded light becomes a displayed colour. The values and their order match shaders/cotan/tone.h.
enum class ToneMapping {
    none,    // clipped at 1
    aces,    // the curve of K. Narkowicz
    neutral, // Khronos PBR Neutral
    agx,
};

// What is visible behind the scene.
enum class Backdrop {
    gradient, // cotan_environment, regardless of what lights the scene
    blurred,  // View::environmentMap, out of focus; `gradient` if there is none
    sharp,    // View::environmentMap in focus; `gradient` if there is none
    paper,    // a photographer's seamless paper, lit from above, independent of the exposure
};

// Incident light from all directions.
struct EnvironmentMap {
    std::string name; // for messages
    Image atlas;      // layout as in shaders/cotan/environment.h: float32, exact in half precision, in [0, 65504]
};

// The shadow of a scene on a horizontal plane.
struct GroundMap {
    float height = 0;    // world y of the plane
    glm::vec2 low{0};    // world x and z where the map begins; outside the map there is no shadow
    glm::vec2 extent{1}; // size of the map in world units
    Image visibility;    // float32, exact in half precision: x is the fraction of light that arrives; z runs down
};

struct View {
    int width = 1280;
    int height = 720;
    Camera camera;
    Frame frame = Frame::cotangent;
    bool framesOfMeshes = false; // meshes with a frame of their own (Mesh::readWith) are drawn with that
    Output output = Output::shaded;
    Shading shading = Shading::pbr;
    std::vector<Light> lights; // the first directional one casts shadows
    bool shadows = true;
    float shadowSoftness = 0; // tangent of half the angle that the shadow-casting light subtends; 0: sharp
    bool normalMaps = true;   // false: the interpolated normal
    bool environment = true;  // ambient and reflections from the environment
    std::shared_ptr<const EnvironmentMap> environmentMap; // null: cotan_environment
    bool background = true; // shaded: the backdrop behind the scene; false: transparent black
    Backdrop backdrop = Backdrop::gradient;
    std::shared_ptr<const GroundMap> ground;     // shaded: shadow of the scene on a horizontal plane; null: none
    bool linearOutput = false;                   // shaded: float32, linear, not tone mapped
    ToneMapping toneMapping = ToneMapping::aces; // shaded, unless linearOutput
    float exposure = 1;
    // Samples per pixel, shaded only: 1; 4, which share one shading result; or 16, each shaded by itself at positions
    // common to both renderers, with textures sampled four times as finely.
    int samples = 4;
    bool dither = true; // unorm8: dithers with a fixed pattern (quantise.h) against banding of gradients
    // Shaded: lights 16 to 256 normals per pixel. Variance of the normals within one adds to its roughness: from
    // curvature, and from the shortened mean normals of the map's mips.
    bool specularAntialiasing = false;
    bool pointSampled = false; // nearest texel of the finest level, for comparing renderers
    // Direction of raster rows during drawing. The image is upright either way; only the sign of y derivatives changes.
    bool rowsUpward = false;

    // Reads maps with one frame, or with each mesh's own.
    void setFrame(std::optional<Frame> one)
    {
        frame = one.value_or(frame);
        framesOfMeshes = !one;
    }
};

// ---- cameras and lights --------------------------------------------------------------------

// Returns a perspective camera of 30 degrees in front of the scene, slightly to the right and above. It is as close as
// possible while all vertices stay inside the image with a margin of 4 % per side, centred. For an animation
// (Scene::reach) this holds at all times. Beyond 16 million vertices, counting instances, the corners of the meshes'
// boxes are framed instead. A flat scene is viewed straight on. A scene without finite points gives the default camera.
Camera frontCamera(const Scene& scene, int width, int height);

// Like frontCamera, from another side. azimuth: degrees from the front (+z), counter-clockwise as seen from above: 90
// is the right side (+x), -90 the left, 180 the back. elevation: degrees above the horizon, -90 to 90; 90 looks
// straight down, with the front at the bottom. Both must be finite.
Camera orbitCamera(const Scene& scene, double azimuth, double elevation, int width, int height);

// Lights for a scene without any: one key light from the upper left, in front of the scene.
std::vector<Light> defaultLights();

// ---- environments --------------------------------------------------------------------------

// Linear radiance from a unit world-space direction, y up. Called from several threads. Negative and non-finite values
// count as 0; values above 65504 are clamped to it.
using Radiance = std::function<glm::vec3(glm::vec3 direction)>;

struct EnvironmentOptions {
    float rotation = 0;  // radians around y; turns the environment counter-clockwise as seen from above
    float intensity = 1; // factor on all radiance
};

// Returns the atlas of a radiance. The result is bit-identical for any number of threads.
// samples: per side of each texel of the finest tile; must resolve the smallest detail of the radiance.
EnvironmentMap makeEnvironment(const Radiance& radiance, int samples, const EnvironmentOptions& options = {});

// Returns the atlas of an image in equirectangular projection: twice as wide as high, up at the top, +x in the middle,
// +z a quarter of the width to the right of it.
// Errors: ErrorKind::input for another shape or a type other than float32.
Result<EnvironmentMap> environmentOfImage(const Image& picture, const EnvironmentOptions& options = {});

// Names of the built-in environments: "studio" (soft boxes in a dark room), "overcast", "evening".
const std::vector<std::string>& environmentNames();

// Returns nothing for an unknown name.
std::optional<Radiance> builtinRadiance(const std::string& name);

// Returns the atlas of a built-in environment (see environmentNames), or nothing for another name. The studio with
// default options was computed when Cotan was built and is only loaded; it is bit-identical to what makeEnvironment
// returns and saves a quarter of a second of processor time. All others are computed by the call.
std::optional<EnvironmentMap> builtinEnvironment(const std::string& name, const EnvironmentOptions& options = {});

// ---- ground --------------------------------------------------------------------------------

struct GroundOptions {
    std::optional<float> height; // world y of the plane; none: the scene's lowest point
};

// Returns the shadow that the scene casts on the plane under the view's lights, environment or environmentMap, shadows
// and shadowSoftness; no other field of the view is read. The shadow-casting light is a disc whose size is the
// softness; light from the sky is dimmed by the fraction of a uniform sky that the scene hides. Both are found by
// tracing rays through columns along the light or upright, which count as filled from their lowest to their highest
// surface; shadows from the sky can therefore miss holes. Transmissive materials cast no shadow, blended ones in
// proportion to alpha, masked ones where the mask keeps them. Returns nothing for a scene without extent or without
// light. Bit-identical for any number of threads. Takes about 0.1 s of processor time.
std::optional<GroundMap> makeGround(const Scene& scene, const View& view, const GroundOptions& options = {});

// ---- frames at vertices --------------------------------------------------------------------

// Source of the tangents that the frames `mikktspace` and `vertex` read.
enum class TangentOrigin {
    stored,    // from the file; generated if it has none
    generated, // always derived from positions, normals and uv
};

// Adds the vertex attributes that `frame` reads to every mesh with uv: cotangents for `smooth`, tangents for `vertex`
// and `mikktspace`; without `frame`, those of the mesh's own one (Mesh::readWith), if it has one. Other frames need
// none and leave the scene unchanged. Vertices are split, with all attributes, where tangents differ or uv are
// mirrored; triangles keep their number and order. Renderers refuse a scene without these attributes. Meshes without
// triangles, or without the uv set of their normal map (set 0 if there is no map), are left unchanged. For triangles
// without area in space or in uv, see cotan/tangents.hpp.
void deriveVertexFrames(Scene& scene, std::optional<Frame> frame, TangentOrigin tangents);

} // namespace cotan
