// Motions whose deformed surface is known exactly, and what an engine carries along with them.
#pragma once

#include <array>

#include <glm/mat3x3.hpp>

#include "meshes.hpp"

struct Motion {
    const char* name;
    const char* text;
    // Where a point of the rest pose goes at time s from 0 to 1, and the derivative of that by the point: the
    // exact surface follows from both.
    glm::dvec3 (*position)(glm::dvec3 p, double s);
    glm::dmat3 (*derivative)(glm::dvec3 p, double s);
    // Skinned: the blended matrix, by which an engine takes normals and tangents along. Null: morphed by one
    // target with positions and normals.
    glm::dmat3 (*blend)(glm::dvec3 p, double s);

    // To rest normals and tangents, as the engine has them; unit.
    glm::dvec3 carriedNormal(glm::dvec3 p, glm::dvec3 n, double s) const;
    glm::dvec3 carriedTangent(glm::dvec3 p, glm::dvec3 t, double s) const;
    // The normal of the deformed surface, from that at rest; unit.
    glm::dvec3 exactNormal(glm::dvec3 p, glm::dvec3 n, double s) const;
};

// Bend and twist by two bones, shear by a morph target.
extern const std::array<Motion, 3> kMotions;

// carried: as an engine has them, to be replaced where they are derived.
enum class Normals { carried, exact };

// The mesh at time s.
Mesh posed(const Mesh& rest, const Motion& motion, double s, Normals normals);
