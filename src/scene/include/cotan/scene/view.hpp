// How to draw a scene: what both renderers take, so that their pictures can be compared.
#pragma once

#include <memory>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

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
    shading,     // lights and surroundings meet the turned normal
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

struct EnvironmentMap; // cotan/scene/environment.hpp
struct GroundMap;      // cotan/scene/ground.hpp

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
    // Shaded only, a pixel: 1; 4, which share one light; or 16, each lit by itself where samplePlace
    // (cotan/scene/sample_places.hpp) has it, from textures that are read four times as finely.
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

} // namespace cotan
