// Triangles over an analytic surface, and what is interpolated on them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/tangents.hpp"
#include "truth/quad.hpp"
#include "truth/random.hpp"
#include "truth/surface.hpp"

namespace cotan {

struct Tessellation {
    std::vector<glm::vec3> positions, normals; // on the surface, rounded to float
    std::vector<glm::vec2> texcoords;
    std::vector<glm::dvec2> parameters; // (s,t) of each vertex
    std::vector<std::uint32_t> indices; // counter-clockwise seen from outside
    // From the generators of cotan/tangents.hpp. Tangents per corner, cotangents per vertex.
    std::array<std::vector<glm::vec4>, kFrameCount>
        tangents; // of the frames that read them, a corner each, as glTF has them
    std::vector<glm::vec3> cotangentsU, cotangentsV;
    Cotangents unitCotangents; // the same for the fused form of `smooth`: the longer of the two is 1 long

    std::size_t triangleCount() const { return indices.size() / 3; }
};

// A grid of `segments` cells along s and, the spout apart, half as many along t; the seam's vertices
// are separate, as their uv differ. Irregular: inner vertices moved by up to 0.3 cells and
// diagonals chosen at random. With `vertexFrames` the generated attributes are filled in.
Tessellation tessellate(const Surface& surface, int segments, bool irregular, bool vertexFrames = true);

// A triangle and where in it.
struct TrianglePoint {
    std::size_t triangle = 0;
    std::array<double, 3> weights{1, 0, 0}; // barycentric, sum 1
};

// A random point of a random triangle, uniform in each.
TrianglePoint randomPoint(Random& random, const Tessellation& mesh);

// What a pixel at that point has, from attributes of the vertices.
struct Interpolated {
    glm::dvec3 position, n; // n not normalised
    glm::dvec2 parameters, uv;
    std::array<glm::dvec4, kFrameCount> tangents{}; // of the frames that read them, as tangentAlongV
    glm::dvec3 cotangentU, cotangentV, unitU, unitV;
    Differences<double> edges; // of the triangle
    AffinePatch plane;         // the triangle's, with its gradients of uv; normal to n's side
};
Interpolated interpolate(const Tessellation& mesh, const TrianglePoint& at);

// The perturbed normal of any frame, in double or, with all attributes rounded, in float. `screen`
// is used by frames from differences, the triangle's edges by `exact`, attributes by the others.
glm::dvec3 shade(Frame frame, bool single, const Interpolated& x, const Differences<double>& screen, glm::dvec3 texel);

} // namespace cotan
