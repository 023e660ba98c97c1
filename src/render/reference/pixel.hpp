// Shading of a pixel: the surface of a triangle, lights, shadows, and the background.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/portable.hpp"
#include "cotan/view.hpp"
#include "setup.hpp"

namespace cotan::reference {

// ---- the surface: normal, frame, material ---------------------------------------------------

// `src/bake/surface` computes the same for bakers and checkers. This is a separate implementation on purpose: their
// results are judged by images drawn here, so only Scene and the portable text are shared.

// The point of a height map's relief that is seen.
struct ReliefPoint {
    f32::cotan_frame frame{}; // gradients of the height map's uv set
    float height = 1;         // as stored
};

// Interpolated values in the four pixels of a quad, covered or not: helper lanes extrapolate the triangle's plane.
// Lanes are ordered as in Quad.
struct QuadPoints {
    std::array<std::array<double, 3>, 4> weights{};     // of the three vertices, perspective-correct
    std::array<glm::vec3, 4> position{};                // relative to the eye
    std::array<std::array<glm::vec2, 4>, 2> uv{};       // both sets; 0 if the mesh has none. Moved by moveToRelief
    std::array<std::array<glm::vec2, 4>, 2> cornerUv{}; // minus the uv of the triangle's first corner; never moved
    std::array<ReliefPoint, 4> relief{};                // set by moveToRelief
};

QuadPoints interpolate(const Draw& draw, const RasterTriangle& triangle, int x, int y);

// The inputs for shading one triangle.
struct SurfaceInputs {
    const View* view = nullptr;
    const Draw* draw = nullptr; // with its material and maps
    const RasterTriangle* triangle = nullptr;
    const QuadPoints* points = nullptr;
};

// Moves the texture coordinates of all lanes to where the lines of sight meet the material's height map, if it has one.
// in: refers to `points`.
void moveToRelief(const Projection& projection, const SurfaceInputs& in, QuadPoints& points);

// The fraction of light from a unit direction that the relief does not keep from the point that is seen: 0 or 1.
float reliefLight(const SurfaceInputs& in, int lane, glm::vec3 toLight);

// The unit direction from a position relative to the eye to the eye.
glm::vec3 toEye(const Projection& projection, glm::vec3 position);

// Samples a map of the material in one lane; returns 1 if `chain` is null.
glm::vec4 mapTexel(const SurfaceInputs& in, const MipChain* chain, const Texture& texture, int lane);

// Base colour and alpha: factor times map times vertex colour, for every alpha mode.
glm::vec4 baseColorOf(const SurfaceInputs& in, int lane);

// The samples of a pixel that a masked material covers: those where alpha, as a plane over the pixel, reaches the
// cutoff. alphas: of the quad's lanes.
unsigned samplesOfMask(const std::array<float, 4>& alphas, int lane, float cutoff, const SamplePattern& pattern);

struct SurfaceNormal {
    glm::vec3 interpolated{0}; // unit, without the map
    glm::vec3 perturbed{0};    // unit, on the camera's side
    glm::vec3 t{0};
    glm::vec3 b{0};
    glm::vec2 uv{0};            // of the normal map
    f32::cotan_frame frame{};   // frame of `perturbed`
    glm::vec3 dndx{0}, dndy{0}; // differences of `interpolated` to the next pixels, for specular antialiasing
    float smoothVariance = 0;   // variance of `interpolated` in the pixel
    float variance = 0;         // variance of `perturbed` in the pixel
    bool mapped = false;        // has a normal map
};

// The normal, perturbed by the material's normal map.
SurfaceNormal normalOf(const SurfaceInputs& in, int lane);

// One of several normals of a pixel that are lit individually.
struct LitTap {
    glm::vec3 n{0};
    float roughness = 0;
};

// Normals at evenly spaced points of the pixel, to be lit individually for specular antialiasing. `roughness`
// determines their number; the variance in each one's part of the pixel is added to it. normal: mapped, of this lane.
std::vector<LitTap> tapsOf(const SurfaceInputs& in, int lane, const SurfaceNormal& normal, float roughness);

struct CoatNormal {
    glm::vec3 n{0}; // unit, on the camera's side
    float variance = 0;
};

// The coat's normal, from its own map and the view's frame. base: of the surface below.
CoatNormal coatNormalOf(const SurfaceInputs& in, int lane, const SurfaceNormal& base);

// ---- the shadow of the first directional light ----------------------------------------------

struct ShadowMap {
    Projection projection;
    int size = 0;                     // texels a side; 0: no map, everything is lit
    std::vector<float> reversedDepth; // of the first surface that the light meets; row by row
    float texel = 0;                  // world units per texel
    float depthUnit = 0;              // reversed depth per world unit along the light

    float at(int x, int y) const { return reversedDepth[std::size_t(y) * std::size_t(size) + std::size_t(x)]; }
};

// Draws the scene from the light, 2048 texels a side, fitted to the ball. Masked materials cast the shadow of what the
// mask keeps. Blended ones cover a fraction of texels equal to their alpha, by cotan_shadow_threshold. Transmissive
// ones cast none.
ShadowMap makeShadowMap(const View& view, const std::vector<Draw>& draws, glm::vec3 direction, const Ball& ball,
                        glm::dvec3 eye);

// Fraction of light that arrives, in [0,1]. softness: tangent of half the angle of the light's disc
// (shaders/cotan/shadow.h); 0: nine bilinear comparisons around the point. The point is first offset along n and
// compared with a bias that grows with the slope, both in proportion to a texel. position: relative to the eye of the
// projection. n: unit, on the visible side. toLight: unit.
float lightVisibility(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight, float softness);

// ---- light ----------------------------------------------------------------------------------

// A light, prepared for shading.
struct PreparedLight {
    LightKind kind = LightKind::directional;
    glm::vec3 radiance{0};      // colour times intensity
    glm::vec3 position{0};      // relative to the eye
    glm::vec3 toLight{0, 1, 0}; // unit, against the light's travel
    float range = 0;
    float cosInner = 1;
    float cosOuter = 0;
    bool castsShadow = false;
};

// The view's lights. The first directional one casts the shadow if the view has shadows.
std::vector<PreparedLight> prepareLights(const View& view, glm::dvec3 eye);

// Inputs that all pixels of an image share.
struct PixelInputs {
    const View& view;
    Projection projection;
    std::vector<PreparedLight> lights;
    ShadowMap shadow;
};

// A shaded point: what the surface of the portable text does not contain.
struct LitPoint {
    glm::vec3 position{0};        // relative to the eye
    glm::vec3 normal{0};          // unit, unperturbed, on the camera's side: for the shadow
    std::span<const LitTap> taps; // reflections are averaged over these; empty: uses the surface's normal
};

// What material extensions add to a surface, in world space. None with Blinn-Phong.
struct Layers {
    std::optional<f32::cotan_gloss> gloss; // replaces plain metallic-roughness reflections
    std::optional<f32::cotan_sheen> sheen;
    std::optional<f32::cotan_coat> coat;
};

// Linear radiance towards the eye, before exposure: lights, environment, emission. in, lane: for the shadows of a
// relief.
glm::vec3 radianceOf(const PixelInputs& all, const SurfaceInputs& in, int lane, const f32::cotan_surface& surface,
                     const Layers& layers, const LitPoint& point);

// Transmittance for the colours behind the surface.
glm::vec3 transmittanceOf(const f32::cotan_surface& surface, const Layers& layers);

// ---- pixels ---------------------------------------------------------------------------------

struct Fragment {
    glm::vec4 value{0};         // shaded: linear colour and alpha; otherwise x, y, z of the output, and 1
    glm::vec3 transmittance{0}; // factors of the colours behind translucent materials
};

// Shades a lane; the result is finite. Shaded colours are exposed and, unless the view is linear, tone mapped. Empty if
// the surface is invisible.
std::optional<Fragment> shade(const PixelInputs& all, const SurfaceInputs& in, int lane);

// The background in a pixel of the raster: the environment if the view shows it, otherwise 0.
glm::vec4 background(const PixelInputs& all, int x, int y);

} // namespace cotan::reference
