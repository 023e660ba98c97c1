// How a scene is to be drawn: camera, light, frame, what the image shows.
//
//     cotan::View view;
//     view.width = 640;
//     view.height = 480;
//     view.camera = cotan::frontCamera(scene, view.width, view.height);
//     view.lights = cotan::defaultLights();
//     view.frame = cotan::Frame::smooth;
//     cotan::deriveVertexFrames(scene, view.frame, cotan::TangentOrigin::stored); // what that frame reads at vertices
//     if (auto studio = cotan::builtinEnvironment("studio"))
//         view.environmentMap = std::make_shared<cotan::EnvironmentMap>(*std::move(studio));
//     auto image = cotan::drawView(scene, view); // cotan/render.hpp
//
// Both renderers take a View, so that their images can be compared. Part of the library cotan::scene.
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

// What the picture shows. Everything but `shaded` is written as float32: x y z and, in alpha, 1
// where there is a surface and 0 elsewhere.
enum class Output {
    shaded,    // unorm8, sRGB-encoded and tone mapped; float32 linear if View::linearOutput
    normal,    // perturbed world normal, unit
    tangent,   // frame.t, world
    bitangent, // frame.b, world
    uv,        // of the normal map (uv set 0 where there is none), transformed; z = 0
    depth,     // distance along the view axis, in world units, in x; y = z = 0
};

enum class Shading { pbr, blinnPhong };

// Where lights meet a normal-mapped surface. The two others are there to be compared with the first:
// they take vectors into tangent space, light the map's normal as it is read, and so ask for an
// orthonormal frame. The environment is always read in the world. Reference renderer only.
enum class Lighting {
    world,         // the normal is taken to the world
    tangentVertex, // light and view vectors are taken to tangent space by the transpose of t, b, n at
                   // each vertex and interpolated; frames that bring tangents only, others as world
    tangentPixel,  // the same in each pixel, by the inverse of the frame
};

// What a turned normal does to a surface that is otherwise flat there. All but the first follow rays from the point, 64
// a pixel, with a material that keeps all white light; they leave out sheen and stretched highlights. Reference
// renderer only; with Blinn-Phong and in tangent space all are the first.
enum class NormalMapping {
    shading,     // lights and the environment meet the perturbed normal
    rays,        // the same, but light from below the surface is lost, as path tracers have it
    shadowed,    // less of what grazes, too, so that no edge shows (Conty Estevez, Lecocq, Stein 2019)
    facets,      // a second facet of the same material makes up for the turned one (Schuessler and others 2017)
    mirrorFacet, // the same with a mirror as second facet, the paper's own choice
};

// Which differences a 2x2 quad gives: of the pixel's own row and column, or one pair for all four.
enum class Derivatives { fine, coarse };

// How light without bounds becomes a colour of the screen; the numbers of shaders/cotan/tone.h, in their order.
enum class ToneMapping {
    none,    // cut off at 1
    aces,    // the curve of K. Narkowicz
    neutral, // Khronos PBR Neutral
    agx,
};

// What is seen behind the scene.
enum class Backdrop {
    gradient, // cotan_environment, whatever lights the scene
    blurred,  // View::environmentMap, out of focus; the gradient where there is none
    sharp,    // the same as it is
    paper,    // a photographer's seamless paper, lit from above: the same whatever the exposure
};

// Light from all around a scene.
struct EnvironmentMap {
    std::string name; // for messages
    Image atlas;      // as shaders/cotan/environment.h describes it: float32, values that a half holds, in [0, 65504]
};

// The shadow that a scene throws on a level plane.
struct GroundMap {
    float height = 0;    // of the plane, world y
    glm::vec2 low{0};    // x and z of the rectangle that the picture covers; beyond it there is no shadow
    glm::vec2 extent{1}; // of it, world units
    Image shares;        // float32, values that a half holds: x, the share of its light that a place gets; z runs down
};

struct View {
    int width = 1280;
    int height = 720;
    Camera camera;
    Frame frame = Frame::cotangent;
    Output output = Output::shaded;
    Shading shading = Shading::pbr;
    Lighting lighting = Lighting::world;
    NormalMapping normalMapping = NormalMapping::shading;
    std::vector<Light> lights; // the first directional one casts shadows
    bool shadows = true;
    float shadowSoftness = 0; // tangent of half the angle that the light which casts shadows covers; 0: sharp
    bool normalMaps = true;   // false: n as interpolated
    bool environment = true;  // ambient and reflections from the environment
    std::shared_ptr<const EnvironmentMap> environmentMap; // null: cotan_environment
    bool background = true; // shaded: the backdrop behind the scene; false: transparent black
    Backdrop backdrop = Backdrop::gradient;
    std::shared_ptr<const GroundMap> ground;     // shaded: shadow of the scene on a level plane; null: none
    bool linearOutput = false;                   // shaded: float32, linear, not tone mapped
    ToneMapping toneMapping = ToneMapping::aces; // shaded, unless linearOutput
    float exposure = 1;
    // Shaded only, a pixel: 1; 4, which share one light; or 16, each lit by itself, at places that
    // both renderers share, from textures that are read four times as finely.
    int samples = 4;
    bool dither = true; // unorm8: rounds by a fixed pattern (quantise.h), so that gradients do not band
    // Shaded: lights 16 to 256 normals of a pixel, each rougher by what is smaller: turn, and lost length of the map's.
    bool specularAntialiasing = false;
    bool pointSampled = false; // nearest texel of the finest level, for comparing renderers
    Derivatives derivatives = Derivatives::fine;
    // Which way the rows of the raster run while it is drawn. The picture comes out upright in
    // both cases; what changes is the sign of the y derivatives.
    bool rowsUpward = false;
};

// ---- cameras and lights --------------------------------------------------------------------

// From the front, a little from the right and above, with a lens of 30 degrees: as near as all vertices stay inside
// the picture less a margin of 4 % on each side, with equal room on both sides; in an animation (Scene::reach) at all
// of its moments. Beyond 16 million vertices, instances counted, the corners of the meshes' boxes stand for their
// vertices. What is flat is seen straight on. Nothing finite to see gives the default camera.
Camera frontCamera(const Scene& scene, int width, int height);

// The same from another side. azimuth: degrees from the front (+z) counter-clockwise as seen from above, so that 90 is
// the right side (+x), -90 the left one and 180 the back; elevation: degrees above the horizon, -90 to 90, where 90
// looks straight down with the front below. Both finite.
Camera orbitCamera(const Scene& scene, double azimuth, double elevation, int width, int height);

// The lights for a scene that brings none: one key light from the upper left, fixed to the camera's side of the scene.
std::vector<Light> defaultLights();

// ---- environments --------------------------------------------------------------------------

// Linear radiance from a unit direction, world, y up. Called from several threads. Values that are not finite or
// negative count as 0, larger ones than 65504 as that.
using Radiance = std::function<glm::vec3(glm::vec3 direction)>;

struct EnvironmentOptions {
    float rotation = 0;  // radians around y: the environment turns counter-clockwise, seen from above
    float intensity = 1; // factor on all radiance
};

// The atlas of a radiance. The same bytes for any number of threads.
// samples: a side, in each texel of the finest tile; enough that nothing in the radiance is smaller.
EnvironmentMap makeEnvironment(const Radiance& radiance, int samples, const EnvironmentOptions& options = {});

// The atlas of a picture in equirectangular projection: twice as wide as high, up on top, its middle towards +x, and
// +z a quarter of the width to the right of it.
// Errors: ErrorKind::input for another shape or another type than float32.
Result<EnvironmentMap> environmentOfPicture(const Image& picture, const EnvironmentOptions& options = {});

// The built-in ones: "studio" (soft boxes in a dark room), "overcast", "evening".
const std::vector<std::string>& environmentNames();

// Nothing for a name that is not among them.
std::optional<Radiance> builtinRadiance(const std::string& name);

// The atlas of a built-in one, see environmentNames; nothing for another name. The studio as it is, not turned and not
// dimmed, was made while Cotan was built and is only read: to the byte what makeEnvironment makes of it, without the
// quarter of a second of processor that this takes. The others are made by the call.
std::optional<EnvironmentMap> builtinEnvironment(const std::string& name, const EnvironmentOptions& options = {});

// ---- ground --------------------------------------------------------------------------------

struct GroundOptions {
    std::optional<float> height; // of the plane, world y; none: of the scene's lowest point
};

// The shadow that the scene throws on the plane in the light of the view: lights, environment or environmentMap,
// shadows, shadowSoftness; nothing else of it is read. The light that casts shadows falls through a disc as wide as
// the softness says; what comes from all around is dimmed by how much of the sky the scene hides, as if the sky were
// even. Each is told by rays through columns (what is between the lowest and the highest surface along the light, or
// upright, counts as full), so a hole in what stands can be missed by the light from the sky, not by the other.
// Translucent materials throw none, masked ones that of what their mask leaves. Nothing for a scene without extent,
// or when it gets no light. The same bytes for any number of threads. Takes about 0.1 s of processor time.
std::optional<GroundMap> makeGround(const Scene& scene, const View& view, const GroundOptions& options = {});

// ---- frames at vertices --------------------------------------------------------------------

// Where the tangents come from that a frame reads, `mikktspace` and `vertex`.
enum class TangentOrigin {
    stored,    // those of the file; generated where it has none
    generated, // always derived from positions, normals and uv
};

// Gives every mesh with uv what `frame` reads at its vertices: cotangents for `smooth`, tangents for `vertex` and
// `mikktspace`. Other frames need nothing, and the scene stays as it is. Vertices are split where tangents differ or
// the uv are mirrored, all attributes with them; the triangles keep their number and order. Renderers refuse a scene
// that lacks it. A mesh without triangles or without the uv set of its normal map (set 0 where there is no map) stays
// as it is. Triangles without an area in space or in uv: see cotan/tangents.hpp.
void deriveVertexFrames(Scene& scene, Frame frame, TangentOrigin tangents);

} // namespace cotan
