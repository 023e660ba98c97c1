// Motions whose deformed surface is known exactly, and the normals and tangents that an engine carries along.
#pragma once

#include <array>

#include <glm/mat3x3.hpp>

#include "meshes.hpp"

struct Motion {
    const char* name;
    const char* text;
    // Position of a point p of the rest pose at time s, 0 to 1, and its derivative by p. They give the exact surface.
    glm::dvec3 (*position)(glm::dvec3 p, double s);
    glm::dmat3 (*derivative)(glm::dvec3 p, double s);
    // For skinned motions: the blended matrix, which an engine applies to normals and tangents. Null for a morph target
    // with positions and normals.
    glm::dmat3 (*blend)(glm::dvec3 p, double s);

    // The normal n and tangent t of the rest pose as an engine transforms them; unit.
    glm::dvec3 carriedNormal(glm::dvec3 p, glm::dvec3 n, double s) const;
    glm::dvec3 carriedTangent(glm::dvec3 p, glm::dvec3 t, double s) const;
    // The exact normal of the deformed surface for the normal n of the rest pose; unit.
    glm::dvec3 exactNormal(glm::dvec3 p, glm::dvec3 n, double s) const;
};

// Bending and twisting by two bones, shearing by a morph target.
extern const std::array<Motion, 3> kMotions;

// carried: normals as an engine transforms them.
enum class Normals { carried, exact };

// The mesh at time s.
Mesh posed(const Mesh& rest, const Motion& motion, double s, Normals normals);
