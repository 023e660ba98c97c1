// What a pixel of a triangle sees of its surface: normal, frame, material.
//
// `src/bake/surface` answers the same question for bakers and checkers. This is a second answer on purpose: what they
// make is judged by pictures that are drawn here, so nothing is shared but Scene and the portable text.
#pragma once

#include <array>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/portable.hpp"
#include "cotan/view.hpp"
#include "setup.hpp"
#include "texture.hpp"

namespace cotan::reference {

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
    const Draw* draw = nullptr;
    const Material* material = nullptr;
    const MaterialMaps* maps = nullptr;
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

} // namespace cotan::reference
