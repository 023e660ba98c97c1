// Triangle meshes of analytic surfaces, and attributes interpolated on them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "cotan/tangents.hpp"
#include "truth/quad.hpp"
#include "truth/random.hpp"
#include "truth/surface.hpp"

namespace cotan {

struct Tessellation {
    std::vector<glm::vec3> positions, normals; // exact, rounded to float
    std::vector<glm::vec2> texcoords;
    std::vector<glm::dvec2> parameters; // (s,t) of each vertex
    std::vector<std::uint32_t> indices; // counter-clockwise seen from outside
    // Made by the generators of cotan/tangents.hpp. Tangents per corner, cotangents per vertex.
    std::array<std::vector<glm::vec4>, kFrameCount>
        tangents; // for the frames that read tangents, per corner, as in glTF
    std::vector<glm::vec3> cotangentsU, cotangentsV;
    Cotangents unitCotangents; // for the fused form of `smooth`: scaled so that the longer of the two has length 1

    std::size_t triangleCount() const { return indices.size() / 3; }
};

// A grid of `segments` cells along s and half as many along t (the spout: as many). The vertices of a seam are
// separate, because their uv differ. Irregular: inner vertices are moved by up to 0.3 cells and diagonals chosen at
// random. `vertexFrames`: also generate tangents and cotangents.
Tessellation tessellate(const Surface& surface, int segments, bool irregular, bool vertexFrames = true);

// A point on a triangle of the mesh.
struct TrianglePoint {
    std::size_t triangle = 0;
    std::array<double, 3> weights{1, 0, 0}; // barycentric, sum 1
};

// Returns a random point of a random triangle, uniform within the triangle.
TrianglePoint randomPoint(Random& random, const Tessellation& mesh);

// Interpolated vertex attributes at a point, as a pixel gets them.
struct Interpolated {
    glm::dvec3 position, n; // n is not normalised
    glm::dvec2 parameters, uv;
    std::array<glm::dvec4, kFrameCount> tangents{}; // for the frames that read tangents, as tangentAlongV
    glm::dvec3 cotangentU, cotangentV, unitU, unitV;
    Differences<double> edges; // edges of the triangle
    AffinePatch plane;         // plane of the triangle with its gradients of uv; its normal is on n's side
};
Interpolated interpolate(const Tessellation& mesh, const TrianglePoint& at);

// The perturbed normal of any frame, in double or, with all attributes rounded, in float. Frames from differences use
// `screen`, frames from triangles use the edges, and the others use vertex attributes.
glm::dvec3 shade(Frame frame, bool single, const Interpolated& x, const Differences<double>& screen, glm::dvec3 texel);

} // namespace cotan
