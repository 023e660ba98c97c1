// Wavefront OBJ: its text to arrays and triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/model.hpp"
#include "cotan/result.hpp"

namespace cotan {

inline constexpr std::uint32_t kObjNone = ~std::uint32_t(0);

// Indices into the arrays of ObjText; kObjNone where the file names none.
struct ObjCorner {
    std::uint32_t position = kObjNone, texcoord = kObjNone, normal = kObjNone;
};

// The triangles of one group (or object) and one material.
struct ObjPart {
    std::string name;               // of the latest g or o; empty: none
    std::string material;           // of usemtl; empty: none
    std::vector<ObjCorner> corners; // three a triangle
};

struct ObjText {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec4> colors;    // of the positions, as stored; white where there is none; or empty
    std::vector<glm::vec2> texcoords; // as stored: v runs up
    std::vector<glm::vec3> normals;
    std::vector<ObjPart> parts; // in the order of their first face
    std::size_t polygons = 0;
    std::size_t polygonsWithoutUv = 0;
    std::vector<std::string> libraries; // what mtllib lines name, a line each
};

// Reads v vt vn f g o usemtl mtllib; smoothing groups, lines, points, curves and statements that
// nobody knows are passed over. Polygons become triangles (polygon_triangles.hpp).
// Errors (ErrorKind::input, with the line number): a number that is malformed or not finite, index
// 0, an index out of range (a negative one counts back from the latest and is fine; a face may stand
// before what it names), a face without corners, corners of one face with and without texture
// coordinate or normal, no faces at all, over the limits.
// Source: the OBJ specification, appendix B1 of the Advanced Visualizer manual; colours behind
// positions as ZBrush and MeshLab write them.
Result<ObjText> parseObj(std::string text, const std::string& name, const LoadLimits& limits);

} // namespace cotan
