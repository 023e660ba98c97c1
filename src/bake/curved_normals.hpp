// Normals between the vertices of a mesh to third order in the length of an edge, where interpolation is of second.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cotan {

// How the normal turns around a vertex: dn = W dp for steps dp along the surface. W is symmetric and takes the normal
// itself to zero. Kept as xx, xy, xz, yy, yz, zz; 1 / length.
using ShapeOperator = std::array<float, 6>;

// One for each vertex, fitted by least squares to the positions and normals of its neighbours: in the vertex's tangent
// plane these are heights and slopes of one polynomial of fourth order, of which the second derivatives are wanted. The
// others take up what would spoil them; a slight pull to zero decides where neighbours are too few. Normals: unit.
// Neighbours whose normals look away, and those at the vertex itself, do not count; a vertex without any gets zero.
std::vector<ShapeOperator> shapeOperators(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                          std::span<const std::uint32_t> indices, int threads);

struct CurvedTriangle {
    std::array<glm::vec3, 3> positions, normals; // normals: unit
    std::array<ShapeOperator, 3> shapes;
};

// The unit normal of the curved surface through the corners, where a ray that meets the flat triangle in (b1, b2)
// meets that surface. `direction`: of the ray, either way. Zero where the ray runs along the triangle, where normals
// look away from it, or where the surface is further from it than its longest edge: then interpolate.
// With y a point of the triangle's plane, f its normal, d = y - y_i, and T_i(d) the step along the surface above d:
//   height  z(y) = sum_i b_i (2/3 T_i f - 1/6 (T_i W_i T_i) / (n_i f)), a reduced Taylor expansion, exact for cubics:
//           A. Guessab, O. Nouisser, G. Schmeisser, Multivariate approximation by a combination of modified Taylor
//           polynomials, J. Comput. Appl. Math. 196, 2006
//   normal  the cubic Bezier triangle with control points n_i and n_i + W_i T_i(edge) / 3, and in the middle what keeps
//           quadratics: G. Farin, Curves and Surfaces for CAGD, 17
glm::vec3 curvedNormal(const CurvedTriangle& triangle, float b1, float b2, glm::vec3 direction);

} // namespace cotan
