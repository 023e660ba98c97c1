// Vertices in world space, relative to the eye.
#pragma once

#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/view.hpp"

namespace cotan::reference {

// One instance of a mesh. Arrays are empty or have one entry a vertex.
struct Draw {
    const Mesh* mesh = nullptr;
    int material = 0;
    glm::mat3 vectors{1};               // takes differences of mesh positions to the world
    bool mirrored = false;              // the matrix reverses orientation
    std::vector<glm::vec3> positions;   // relative to the eye, world axes
    std::vector<glm::vec3> normals;     // unit, or zero where unknown
    std::vector<glm::vec4> tangents;    // unit; w = handedness along +v, see geometry.cpp
    std::vector<glm::vec3> cotangentsU; // any common scale
    std::vector<glm::vec3> cotangentsV;
};

// The draws of a scene: opaque and masked instances in the scene's order, then translucent ones likewise:
// these can be tested against all that hides them, and keep no depth themselves. Instances without a valid mesh or
// triangles are left out. frame: only the attributes that it reads are made. blending: false draws translucent
// materials as opaque ones, in the scene's order.
std::vector<Draw> makeDraws(const Scene& scene, glm::dvec3 eye, Frame frame, bool blending);

} // namespace cotan::reference
