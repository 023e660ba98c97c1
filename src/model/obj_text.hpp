// Wavefront OBJ: its text to arrays and triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/model.hpp"
#include "cotan/result.hpp"

namespace cotan {

// ---- lines of words --------------------------------------------------------------------------

// A text whose continued lines (a backslash at the end) are joined, whose white space is ' ' or
// '\n', with none around a line; line ends may be LF, CR LF or CR.
class TextLines {
public:
    explicit TextLines(std::string text);

    const std::string& text() const { return text_; }

    // The line of the file, from 1, that an offset into text() comes from.
    std::size_t number(std::size_t offset) const;

private:
    std::string text_;
    std::vector<std::size_t> joined_; // offsets where a continued line was joined
};

// Walks over the words of a line.
struct Words {
    std::string_view rest;

    // Empty: there are no more.
    std::string_view next();

    // The next word without taking it.
    std::string_view peek() const { return Words{rest}.next(); }

    // What is left, without the spaces around it: a name that may hold spaces.
    std::string_view all() const;
};

// The number that a whole word is, in any of the usual spellings: 1 -.5 +2. 3e-4. Nothing where it
// is something else or not finite as a float.
std::optional<float> finiteNumber(std::string_view word);

// ---- models ----------------------------------------------------------------------------------

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
// nobody knows are passed over. Polygons become triangles (cutPolygon).
// Errors (ErrorKind::input, with the line number): a number that is malformed or not finite, index 0, an index out of
// range (a negative one counts back from the latest and is fine; a face may stand before what it names), a face without
// corners, corners of one face with and without texture coordinate or normal, no faces at all, over the limits.
// Source: the OBJ specification, appendix B1 of the Advanced Visualizer manual; colours behind
// positions as ZBrush and MeshLab write them.
Result<ObjText> parseObj(std::string text, const std::string& name, const LoadLimits& limits);

// Cuts a polygon of three corners or more into corners - 2 triangles by clipping ears, as seen along its mean normal;
// holes that a bridge of two edges joins to the rim are fine. Appends three places in `corners` a triangle; their
// winding is the polygon's. Of a planar polygon that does not cross itself the triangles cover the polygon, once; of
// others, something near. A polygon without area becomes a fan.
// stepsLeft: comparisons of a corner with a triangle that may still be made, one budget for a
// model: many corners that turn inwards take the square of their number. False: it is used up.
bool cutPolygon(std::span<const glm::vec3> corners, std::vector<std::uint32_t>& triangles, std::size_t& stepsLeft);

} // namespace cotan
