// Tessellation of a parametric surface over the unit square, for the built-in shapes.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "cotan/scene.hpp"

namespace cotan {

struct ShapePoint {
    glm::dvec3 position{0};
    glm::dvec3 normal{0, 0, 1}; // unit, outwards
};

// A point of the surface at (u,v) in the unit square. Seen from outside u runs to the right and v
// downwards, so that triangles come out counter-clockwise and images unmirrored.
using Surface = std::function<ShapePoint(double u, double v)>;

struct Grid {
    int cellsU = 1;
    int cellsV = 1;
    bool poleTop = false;    // the edge v = 0 is one point
    bool poleBottom = false; // the edge v = 1 is one point
};

// Adds the tessellated surface to a mesh, with texcoords set 0 = (u,v). Vertices are shared between the cells. At a
// pole each column of cells gets one triangle and a vertex of its own, whose u is the middle of the column.
void appendGrid(Mesh& mesh, const Grid& grid, const Surface& surface);

// Scales texcoords set 0.
void scaleTexcoords(Mesh& mesh, float u, float v);

// x turns as an angle in radians in [0, 2 pi). Whole turns are removed exactly, so that the two
// ends of a closed surface come out as the same bits.
double turns(double x);

} // namespace cotan
