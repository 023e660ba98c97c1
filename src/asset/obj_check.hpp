// Wavefront OBJ, before it is given to a parser that trusts it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/asset/load.hpp"
#include "cotan/result.hpp"

namespace cotan {

struct ObjFacts {
    std::size_t positions = 0;
    std::size_t texcoords = 0;
    std::size_t normals = 0;
    std::size_t polygons = 0;  // faces with three corners or more
    std::size_t triangles = 0; // of those polygons, corners - 2 each
    std::size_t polygonsWithoutUv = 0;
    std::vector<std::string> libraries; // what mtllib lines name
};

// Checks the whole text and reduces it in place to what has been checked: continued lines are
// joined, line ends are '\n', tabs and comments behind data become spaces, and lines other than
// v vt vn f g o s usemtl mtllib become comments (so lines, points and free-form surfaces are left
// out).
// Errors (ErrorKind::input, with the line number): a number that is malformed or not finite, index
// 0, an index out of range (a negative one counts back from the latest and is fine), a face without
// corners, corners of one face with and without texture coordinate or normal, no faces at all,
// over the limits. Source: the OBJ specification, appendix B1 of the Advanced Visualizer manual.
Result<ObjFacts> checkObj(std::string& text, const std::string& name, const LoadLimits& limits);

} // namespace cotan
