// What a pixel sees: the surface of a triangle, lights, the shadow of one of them, rays, and what is behind it all.
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

// `src/bake/surface` answers the same question for bakers and checkers. This is a second answer on purpose: what they
// make is judged by pictures that are drawn here, so nothing is shared but Scene and the portable text.

// Interpolated values in the four pixels of a quad, covered or not: helper lanes extrapolate the
// triangle's plane. Order: as in Quad.
struct QuadPoints {
    std::array<std::array<double, 3>, 4> weights{};     // of the three vertices, perspective-correct
    std::array<glm::vec3, 4> position{};                // relative to the eye
    std::array<std::array<glm::vec2, 4>, 2> uv{};       // both sets; 0 where the mesh has none
    std::array<std::array<glm::vec2, 4>, 2> cornerUv{}; // minus that of the triangle's first corner
};

QuadPoints interpolate(const Draw& draw, const RasterTriangle& triangle, int x, int y);

// Everything that shading one triangle needs to look up.
struct SurfaceInputs {
    const View* view = nullptr;
    const Draw* draw = nullptr; // and its material, with its maps
    const RasterTriangle* triangle = nullptr;
    const QuadPoints* points = nullptr;
};

// What a map of the material has in one lane; 1 where there is no chain.
glm::vec4 mapTexel(const SurfaceInputs& in, const MipChain* chain, const Texture& texture, int lane);

// The base colour and alpha: factor, map and vertex colour, whatever the material does with alpha.
glm::vec4 baseColorOf(const SurfaceInputs& in, int lane);

// The samples of a pixel that a masked material covers: where alpha, taken as a plane over the pixel, is not below the
// cutoff. alphas: of the quad's lanes.
unsigned samplesOfMask(const std::array<float, 4>& alphas, int lane, float cutoff, const SamplePattern& pattern);

struct SurfaceNormal {
    glm::vec3 interpolated{0}; // unit, as the mesh has it
    glm::vec3 finished{0};     // unit, perturbed, turned towards the camera's side
    glm::vec3 t{0};
    glm::vec3 b{0};
    glm::vec2 uv{0};              // of the normal map
    f32::cotan_frame frame{};     // that `finished` was made with
    glm::vec3 turnX{0}, turnY{0}; // differences of `interpolated` to the next pixels, where the view asks for them
    float turn = 0;               // the spread that they are
    float spread = 0;             // the same of `finished`
    bool mapped = false;          // there is a normal map, and what follows is set
    glm::vec3 texel{0, 0, 1};     // decoded, unit, in the frame; turned towards the camera's side
};

// As the material's normal map has it.
SurfaceNormal normalOf(const SurfaceInputs& in, int lane);

// One of several normals of a pixel that are lit one by one.
struct LitTap {
    glm::vec3 n{0};
    float roughness = 0;
};

// The normals of even places in the pixel, to be lit one by one for specular antialiasing: as many as the surface's
// roughness asks for, each rougher by what is smaller than its part of the pixel. normal: mapped, of the same lane.
std::vector<LitTap> tapsOf(const SurfaceInputs& in, int lane, const SurfaceNormal& normal, float roughness);

struct CoatNormal {
    glm::vec3 n{0}; // unit, turned towards the camera's side
    float spread = 0;
};

// The coat's normal, from its own map and a frame of the same name. base: of the surface beneath.
CoatNormal coatNormalOf(const SurfaceInputs& in, int lane, const SurfaceNormal& base);

// ---- the shadow of the first directional light ----------------------------------------------

struct ShadowMap {
    Projection projection;
    int size = 0;                     // texels a side; 0: no map, everything is lit
    std::vector<float> reversedDepth; // of what the light meets first; rows first
    float texel = 0;                  // world units a texel
    float depthUnit = 0;              // reversed depth of one world unit along the light

    float at(int x, int y) const { return reversedDepth[std::size_t(y) * std::size_t(size) + std::size_t(x)]; }
};

// Draws the scene as the light sees it, 2048 texels a side, fitted to the ball. Masked materials
// cast the shadow of what their mask leaves; blended ones cover as many texels as their alpha says, by
// cotan_shadow_threshold; what transmits casts none.
ShadowMap makeShadowMap(const View& view, const std::vector<Draw>& draws, glm::vec3 direction, const Ball& ball,
                        glm::dvec3 eye);

// The share of light that arrives, 0..1, of a light that covers a disc, whose tangent of half the angle is `softness`
// (shaders/cotan/shadow.h); 0: nine bilinear comparisons around the point. The point is first moved off its surface
// along n, and compared with a bias that grows with the slope, both in proportion to a texel.
// position: relative to the eye of the projection. n: unit, on the side that is seen. toLight: unit.
float lightReaching(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight, float softness);

// ---- light ----------------------------------------------------------------------------------

// A light, ready for shading.
struct PreparedLight {
    LightKind kind = LightKind::directional;
    glm::vec3 radiance{0};      // colour times intensity
    glm::vec3 position{0};      // relative to the eye
    glm::vec3 toLight{0, 1, 0}; // unit, against the way the light travels
    float range = 0;
    float cosInner = 1;
    float cosOuter = 0;
    bool castsShadow = false;
};

// The view's lights; the first directional one casts the shadow, if the view has shadows.
std::vector<PreparedLight> prepareLights(const View& view, glm::dvec3 eye);

// What all pixels of a picture share.
struct PixelInputs {
    const View& view;
    Projection projection;
    std::vector<PreparedLight> lights;
    ShadowMap shadow;
};

// Lighting in tangent space, as tutorials do it: vectors come to the map's normal, not it to them. Vectors along t, b,
// n of a pixel.
struct TangentSpace {
    f32::cotan_surface surface; // n: the texel; v: carried to tangent space
    f32::cotan_frame pixel{};   // in the pixel
    bool perVertex = false;     // carry at the corners, and interpolate
    std::array<f32::cotan_frame, 3> corners{};
    std::array<glm::vec3, 3> positions{}; // of the corners, relative to the eye
    std::array<double, 3> weights{};
};

// Nothing where the view lights in the world, where there is no normal map, and where what is asked for is missing:
// tangents at the vertices, or a frame that can be inverted. surface: in the world.
std::optional<TangentSpace> tangentSpaceOf(const SurfaceInputs& in, int lane, const SurfaceNormal& normal,
                                           const f32::cotan_surface& surface, bool orthographic);

// A shaded point, beyond what the portable text's surface holds.
struct LitPoint {
    glm::vec3 position{0};        // relative to the eye
    glm::vec3 normal{0};          // unit, not perturbed, on the camera's side: for the shadow
    std::span<const LitTap> taps; // what is reflected is their mean; none: as the surface says
};

// What extensions add to a surface, in the world. Blinn-Phong has none of it.
struct Layers {
    std::optional<f32::cotan_gloss> gloss; // in place of metallic-roughness' own reflections
    std::optional<f32::cotan_sheen> sheen;
    std::optional<f32::cotan_coat> coat;
};

// Linear radiance towards the eye: lights, environment, emission. Not yet exposed. tangent: where there is one, lights
// are taken there and meet its surface in place of `surface`; highlights are not stretched.
glm::vec3 radianceOf(const PixelInputs& all, const f32::cotan_surface& surface, const Layers& layers,
                     const LitPoint& point, const std::optional<TangentSpace>& tangent);

// The factors, by colour, of what is behind a surface that transmits.
glm::vec3 transmittanceOf(const f32::cotan_surface& surface, const Layers& layers);

// ---- light on rays: classic normal mapping, and two facets that make a surface of a turned normal -----------

// Light from one direction, of that irradiance perpendicular to it.
struct ArrivingLight {
    glm::vec3 toLight{0};
    glm::vec3 irradiance{0};
};

// Linear radiance towards the eye of what lights and, where the view has one, the environment give, by one of
// View::normalMapping's ways but `shading`: the mean of 64 walks. Emission is not in it.
// A direction to the eye below the surface counts as one along it. surface: its n is the turned normal. gloss: its
// anisotropy counts as 0. point: its place is where random numbers come from.
glm::vec3 radianceByRays(const f32::cotan_surface& surface, const f32::cotan_gloss& gloss, const LitPoint& point,
                         const View& view, const std::vector<ArrivingLight>& lights);

// ---- pixels ---------------------------------------------------------------------------------

struct Fragment {
    glm::vec4 value{0};   // shaded: linear colour and alpha; otherwise the output's x y z, and 1
    glm::vec3 through{0}; // factors of what is behind, where the material is translucent
};

// Always finite. Shaded colours are exposed and, unless the view wants them linear, tone mapped. Nothing where the
// surface is invisible.
std::optional<Fragment> shade(const PixelInputs& all, const SurfaceInputs& in, int lane);

// The background in a pixel of the raster: the environment where the view wants it, otherwise 0.
glm::vec4 background(const PixelInputs& all, int x, int y);

} // namespace cotan::reference
