// Metallic-roughness for light that meets a surface more than once: nothing of white light is lost.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/portable.hpp"

namespace cotan::reference {

// The next of a sequence of random numbers in [0,1).
float nextRandom(std::uint32_t& state);

// All directions are unit and in axes with the facet's normal as z.
class FacetMaterial {
public:
    FacetMaterial(const f32::cotan_surface& surface, const f32::cotan_gloss& gloss);

    // Reflectance times the cosine of l. Light and eye may change places, but for that cosine.
    glm::vec3 reflect(glm::vec3 v, glm::vec3 l) const;

    // A direction that light comes from, and what that counts; 0 for one below the facet.
    glm::vec3 sample(glm::vec3 v, std::uint32_t& state, glm::vec3& weight) const;

private:
    // GGX, and what its one bounce leaves over, scattered.
    struct Lobe {
        glm::vec3 f0{0};
        float f90 = 1;
        float weight = 0;
        glm::vec3 tint{0}; // of what is left over
        float white = 1;   // the f0 that says how much that is
        float mean = 0;    // of the albedo that goes with it, over the cosine
    };

    static float albedo(const Lobe& lobe, glm::vec2 factors);
    glm::vec2 factors(float nv) const; // of f0 and f90, as albedoFactors of the part `environment`

    float roughness_ = 1;
    Lobe lobes_[2]; // of the dielectric and of the metal
};

} // namespace cotan::reference
