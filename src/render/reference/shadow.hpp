// The shadow of the first directional light.
#pragma once

#include <vector>

#include "projection.hpp"
#include "setup.hpp"
#include "texture.hpp"

namespace cotan::reference {

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
ShadowMap makeShadowMap(const Scene& scene, const View& view, const std::vector<Draw>& draws,
                        const TextureLibrary& textures, glm::vec3 direction, const Ball& ball, glm::dvec3 eye);

// The share of light that arrives, 0..1: nine bilinear comparisons around the point. The point is first moved off its
// surface along n, and compared with a bias that grows with the slope, both in proportion to a texel.
// position: relative to the eye of the projection. n: unit, on the side that is seen.
// toLight: unit.
float lightReaching(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight);

// The same of a light that covers a disc, whose tangent of half the angle is `softness`: shaders/cotan/shadow.h.
float softLightReaching(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight, float softness);

} // namespace cotan::reference
