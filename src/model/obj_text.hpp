// Parses the text of a Wavefront OBJ file into arrays and triangles.
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

// ---- lines and words -------------------------------------------------------------------------

// Text with continued lines (a backslash at the end) joined and white space normalised to ' ' and '\n', without spaces
// at the start and end of lines. Line ends may be LF, CR LF or CR.
class TextLines {
public:
    explicit TextLines(std::string text);

    const std::string& text() const { return text_; }

    // The line number in the file, from 1, of an offset into text().
    std::size_t number(std::size_t offset) const;

private:
    std::string text_;
    std::vector<std::size_t> joined_; // offsets at which continued lines were joined
};

// Iterates over the words of a line.
struct Words {
    std::string_view rest;

    // Empty at the end of the line.
    std::string_view next();

    // The next word, without consuming it.
    std::string_view peek() const { return Words{rest}.next(); }

    // The rest without spaces around it, such as a name that contains spaces.
    std::string_view all() const;
};

// The number that the whole word represents, in any usual notation: 1 -.5 +2. 3e-4. Nothing for other words and for
// numbers that are not finite as float.
std::optional<float> finiteNumber(std::string_view word);

// ---- models ----------------------------------------------------------------------------------

inline constexpr std::uint32_t kObjNone = ~std::uint32_t(0);

// Indices into the arrays of ObjText; kObjNone if the file gives none.
struct ObjCorner {
    std::uint32_t position = kObjNone, texcoord = kObjNone, normal = kObjNone;
};

// The triangles of one group (or object) and one material.
struct ObjPart {
    std::string name;               // of the latest g or o; empty: none
    std::string material;           // of usemtl; empty: none
    std::vector<ObjCorner> corners; // three per triangle
};

struct ObjText {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec4> colors;    // per position, as stored; white if a position has none; empty if none has one
    std::vector<glm::vec2> texcoords; // as stored: v points up
    std::vector<glm::vec3> normals;
    std::vector<ObjPart> parts; // in the order of their first face
    std::size_t polygons = 0;
    std::size_t polygonsWithoutUv = 0;
    std::vector<std::string> libraries; // names in mtllib lines, one entry per line
};

// Reads v vt vn f g o usemtl mtllib. Smoothing groups, lines, points, curves and unknown statements are skipped.
// Polygons become triangles (cutPolygon).
// Errors (ErrorKind::input, with the line number): a malformed or non-finite number, index 0, an index out of range, a
// face without corners, corners of one face with and without texture coordinate or normal, no faces, exceeded limits.
// Negative indices count back from the latest element; faces may precede the elements they refer to.
// Source: the OBJ specification, appendix B1 of the Advanced Visualizer manual; colours after positions as written by
// ZBrush and MeshLab.
Result<ObjText> parseObj(std::string text, const std::string& name, const LoadLimits& limits);

// Cuts a polygon of three or more corners into corners - 2 triangles by ear clipping in the projection along its mean
// normal; holes connected to the rim by a bridge of two edges are supported. Appends three indices into `corners` per
// triangle, with the winding of the polygon. A planar polygon that does not cross itself is covered exactly once, other
// polygons approximately. A polygon without area becomes a fan.
// stepsLeft: the remaining budget of point-in-triangle tests, shared by a model: the tests grow with the square of the
// number of reflex corners. Returns false if the budget is exhausted.
bool cutPolygon(std::span<const glm::vec3> corners, std::vector<std::uint32_t>& triangles, std::size_t& stepsLeft);

} // namespace cotan
