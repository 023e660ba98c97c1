// Scenes of very many small parts, and of triangles that lie exactly on one another, made cheaper to draw.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// Puts parts of one material together where there are over maxParts: meshes of up to 256 triangles, placed by their
// instances in float; larger ones stay, and so does what would be more than 4 million triangles. Instances with
// matrices that are not finite go; so do the names of parts that are put together, and an opaque part that lies in the
// place of one that is the same. Parts with cotangents stay.
void joinParts(Scene& scene, std::size_t maxParts = 1000);

// Leaves out triangles of opaque meshes that have the corners of an earlier one of their mesh, in the same order round:
// the first is what a picture shows.
void dropRepeated(Scene& scene);

// How many pixels of a picture the triangles cover that face the eye or are drawn from both sides, all that lie behind
// one another; half of those of translucent ones without a coat or the like.
double pixelsCovered(const Scene& scene, const View& view);

// Makes the scene fit to be drawn so many times in this view: dropRepeated where triangles cover the pictures over 20
// times. Errors (ErrorKind::input), all before anything is drawn: after that opaque ones cover them over 64 times, or
// translucent ones 16 times; the edges of long triangles fill them twice, in a scene of few places; or 200 lights
// shine on all of them.
Status settleCovered(Scene& scene, const View& view, std::size_t pictures = 1);

// ---- triangles that lie on others ------------------------------------------------------------

struct CornersOfTriangle {
    std::array<glm::vec3, 3> at{};
    std::int64_t key = 0; // what else has to be equal
};

// How many earlier ones have the corners of each of so many triangles, in the same order: 0, 1, or 2 for more. Empty
// where few repeat, by a sample of them: then nobody waits for an answer about all. Whatever looks at all triangles of
// a place takes a thousand times as long where a thousand lie on one another.
std::vector<std::uint8_t> repeatedTriangles(std::size_t count,
                                            const std::function<CornersOfTriangle(std::size_t)>& triangle);

} // namespace cotan
