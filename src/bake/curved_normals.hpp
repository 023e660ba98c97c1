// Normals between the vertices of a mesh with an error of third order in the edge length, not second as by
// interpolation.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cotan {

// How the normal changes around a vertex: dn = W dp for steps dp along the surface. W is symmetric and maps the normal
// to zero. Stored as xx, xy, xz, yy, yz, zz; units 1 / length.
using ShapeOperator = std::array<float, 6>;

// The shape operator of each vertex, fitted by least squares to the positions and normals of its neighbours: heights
// and slopes of one polynomial of fourth order over the vertex's tangent plane, whose second derivatives give W. The
// higher derivatives absorb terms that would distort them; a slight regularisation decides if there are too few
// neighbours. Normals must be unit. Neighbours that face away or coincide with the vertex do not count; a vertex
// without neighbours gets zero.
std::vector<ShapeOperator> shapeOperators(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                          std::span<const std::uint32_t> indices, int threads);

struct CurvedTriangle {
    std::array<glm::vec3, 3> positions, normals; // normals: unit
    std::array<ShapeOperator, 3> shapes;
};

// The unit normal of the curved surface through the corners, where a ray that hits the flat triangle at (b1, b2) meets
// that surface. `direction`: of the ray, with either sign. Zero, so that the caller interpolates, if the ray is nearly
// parallel to the triangle, normals face away from it, or the surface is further from it than its longest edge.
// With y a point of the triangle's plane, f its normal, d = y - y_i, and T_i(d) the step along the surface above d:
//   height  z(y) = sum_i b_i (2/3 T_i f - 1/6 (T_i W_i T_i) / (n_i f)), a reduced Taylor expansion, exact for cubics:
//           A. Guessab, O. Nouisser, G. Schmeisser, Multivariate approximation by a combination of modified Taylor
//           polynomials, J. Comput. Appl. Math. 196, 2006
//   normal  the cubic Bezier triangle with control points n_i and n_i + W_i T_i(edge) / 3, and a middle one that
//           reproduces quadratics: G. Farin, Curves and Surfaces for CAGD, 17
glm::vec3 curvedNormal(const CurvedTriangle& triangle, float b1, float b2, glm::vec3 direction);

} // namespace cotan
