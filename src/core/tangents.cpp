#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <string>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "corner_groups.hpp"
#include "mikktspace.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

namespace {

using tangents::Edges;
using tangents::edgesAt;
using tangents::Side;
using tangents::slot;

constexpr std::size_t kMinCorners = 100000; // per thread

// Returns the unit direction of dP/du, or zero.
glm::vec3 alongU(const Edges& e)
{
    return unitOrZero((e.dp1 * e.duv2.y - e.dp2 * e.duv1.y) * (e.uvArea() < 0 ? -1.0 : 1.0));
}

// Returns a unit vector perpendicular to n; n may be zero or not finite.
glm::vec3 anyPerpendicular(glm::vec3 n)
{
    // Projects the axis that is farthest from n.
    const glm::vec3 a = glm::abs(n);
    const glm::vec3 axis = a.x <= a.y && a.x <= a.z ? glm::vec3(1, 0, 0)
        : a.y <= a.z                                ? glm::vec3(0, 1, 0)
                                                    : glm::vec3(0, 0, 1);
    const glm::vec3 t = tangents::normalizeOrZero(axis - n * (glm::dot(axis, n) / glm::dot(n, n)));
    return glm::dot(t, t) > 0.5f ? t : glm::vec3(1, 0, 0);
}

} // namespace

std::vector<glm::vec4> vertexTangents(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const LargeArray<std::uint32_t> first = tangents::weld(mesh);
    const std::vector<Side> sides = tangents::cornerSides(mesh);
    std::vector<glm::vec3> sums(2 * mesh.positions.size(), glm::vec3(0));
    for (std::size_t c = 0; c < sides.size(); ++c)
        if (sides[c] != Side::none)
            sums[slot(first[mesh.indices[c]], sides[c])] += alongU(edgesAt(mesh, c / 3, c % 3));

    const auto isEmpty = [&](std::size_t at) { return tangents::isZero(sums[at]); };
    std::vector<glm::vec4> out(sides.size());
    for (std::size_t c = 0; c < out.size(); ++c) {
        const std::uint32_t vertex = first[mesh.indices[c]];
        const glm::vec3 n = mesh.normals[vertex];
        const Side side = tangents::sideOrNearest(sides[c], vertex, isEmpty);
        const glm::vec3 t = tangents::projectedUnit(sums[slot(vertex, side)], n);
        out[c] =
            glm::dot(t, t) > 0.5f ? glm::vec4(t, side == Side::mirrored ? -1 : 1) : glm::vec4(anyPerpendicular(n), 1);
    }
    return out;
}

bool tangents::averageCotangents(const MeshView& mesh, int threads, const Listener& listener, Cotangents& made)
{
    const std::size_t count = mesh.positions.size();
    auto allocate = [&] { made = {zeros<glm::vec3>(count), zeros<glm::vec3>(count)}; };
    const Task sideTask{[](void* function) { (*static_cast<decltype(allocate)*>(function))(); }, &allocate};
    const std::size_t all = threadsFor(mesh.indices.size(), kMinCorners, threads);
    return count == 0 || groupCorners(mesh, all, {&made, {}, {}}, listener, sideTask).first;
}

Cotangents smoothCotangents(const MeshView& mesh, int threads)
{
    Cotangents made;
    if (tangents::usable(mesh, threadsFor(mesh.indices.size(), kMinCorners, threads)))
        tangents::averageCotangents(mesh, threads, {}, made);
    return made;
}

std::vector<std::uint32_t> firstEqualVertices(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const LargeArray<std::uint32_t> first = tangents::weld(mesh);
    return {first.get(), first.get() + mesh.positions.size()};
}

VertexSplit splitVertices(std::size_t vertexCount, std::span<const std::uint32_t> indices,
                          std::span<const glm::vec4> corners)
{
    if (corners.size() != indices.size() || vertexCount >= tangents::kNone || indices.size() >= tangents::kNone
        || std::any_of(indices.begin(), indices.end(), [&](auto i) { return i >= vertexCount; }))
        return {};
    const auto first = tangents::firstEqual(static_cast<std::uint32_t>(indices.size()), [&](std::uint32_t c) {
        const glm::vec4 x = corners[c];
        return std::array{indices[c],           0u, tangents::bitsOf(x.x), tangents::bitsOf(x.y), tangents::bitsOf(x.z),
                          tangents::bitsOf(x.w)};
    });
    VertexSplit split{std::vector<std::uint32_t>(vertexCount), {indices.begin(), indices.end()}};
    std::iota(split.sources.begin(), split.sources.end(), 0u);
    std::vector<bool> claimed(vertexCount); // by the first value, which keeps the vertex
    for (std::uint32_t c = 0; c < indices.size(); ++c) {
        if (first[c] != c) {
            split.indices[c] = split.indices[first[c]];
        } else if (claimed[indices[c]]) {
            split.indices[c] = static_cast<std::uint32_t>(split.sources.size());
            split.sources.push_back(indices[c]);
        }
        claimed[indices[c]] = true;
    }
    return split;
}

namespace {

// Vertices that mirrored and unmirrored triangles share.
struct Shared {
    std::vector<Side> sides;            // per corner; corners without a side get one
    std::vector<Side> keepers;          // per vertex: the first side, which keeps the vertex
    std::vector<std::uint32_t> copies;  // per vertex: the copy for the other side, or kNone; empty: no copies
    std::vector<std::uint32_t> sources; // per copy: the vertex that it copies
};

Shared sharedVertices(const MeshView& mesh, std::size_t threads)
{
    const std::size_t count = mesh.positions.size();
    Shared shared{tangents::cornerSides(mesh, threads), std::vector<Side>(count, Side::none), {}, {}};
    std::vector<bool> unmirrored(count);
    for (std::size_t c = 0; c < shared.sides.size(); ++c)
        if (shared.sides[c] == Side::unmirrored)
            unmirrored[mesh.indices[c]] = true;
    for (std::size_t c = 0; c < shared.sides.size(); ++c) {
        const std::uint32_t vertex = mesh.indices[c];
        Side& side = shared.sides[c];
        if (side == Side::none)
            side = unmirrored[vertex] ? Side::unmirrored : Side::mirrored;
        Side& keeper = shared.keepers[vertex];
        if (keeper == Side::none)
            keeper = side;
        if (keeper == side)
            continue;
        if (shared.copies.empty())
            shared.copies.assign(count, tangents::kNone);
        if (shared.copies[vertex] == tangents::kNone) {
            shared.copies[vertex] = static_cast<std::uint32_t>(count + shared.sources.size());
            shared.sources.push_back(vertex);
        }
    }
    return shared;
}

VertexSplit splitOf(const MeshView& mesh, const Shared& shared)
{
    const std::size_t count = mesh.positions.size();
    VertexSplit split{std::vector<std::uint32_t>(count), {mesh.indices.begin(), mesh.indices.end()}};
    std::iota(split.sources.begin(), split.sources.end(), 0u);
    split.sources.insert(split.sources.end(), shared.sources.begin(), shared.sources.end());
    for (std::size_t c = 0; c < shared.sides.size() && !shared.copies.empty(); ++c)
        if (const std::uint32_t vertex = mesh.indices[c]; shared.sides[c] != shared.keepers[vertex])
            split.indices[c] = shared.copies[vertex];
    return split;
}

} // namespace

VertexSplit splitMirrored(const MeshView& mesh)
{
    return tangents::usable(mesh) ? splitOf(mesh, sharedVertices(mesh, 1)) : VertexSplit{};
}

std::vector<glm::vec4> generateTangents(Frame frame, const MeshView& mesh, int threads)
{
    if (frame == Frame::mikktspace)
        return mikktspaceTangents(mesh, threads);
    if (frame == Frame::areaWeighted)
        return areaWeightedTangents(mesh, threads);
    return frame == Frame::vertex ? vertexTangents(mesh) : std::vector<glm::vec4>{};
}

SplitCotangents splitSmoothCotangents(const MeshView& mesh, int threads)
{
    const std::size_t all = threadsFor(mesh.indices.size(), kMinCorners, threads);
    if (!tangents::usable(mesh, all))
        return {};
    const Shared shared = sharedVertices(mesh, all);
    const std::size_t count = mesh.positions.size() + shared.sources.size();
    SplitCotangents made{{}, {std::vector<glm::vec3>(count), std::vector<glm::vec3>(count)}};
    tangents::groupCorners(mesh, all, {&made.cotangents, shared.keepers, shared.copies});
    made.split = splitOf(mesh, shared); // after the memory of the groups is freed
    return made;
}

// ---- with progress -------------------------------------------------------------------------

namespace {

Error expected(const std::string& array, const std::string& what, std::size_t found)
{
    return usageError(array + ": expected " + what + ", found " + std::to_string(found));
}

// Returns why a mesh is not usable; nothing if it is.
std::optional<Error> problemOf(const MeshView& mesh)
{
    const std::size_t count = mesh.positions.size(), indices = mesh.indices.size();
    const std::string oneEach = "one per position (" + std::to_string(count) + ")";
    if (count >= tangents::kNone)
        return expected("positions", "less than 4294967295", count);
    if (mesh.normals.size() != count)
        return expected("normals", oneEach, mesh.normals.size());
    if (mesh.texcoords.size() != count)
        return expected("texcoords", oneEach, mesh.texcoords.size());
    if (indices % 3 != 0 || indices >= tangents::kNone)
        return expected("indices", "three per triangle, less than 4294967295", indices);
    const auto outside = std::find_if(mesh.indices.begin(), mesh.indices.end(), [&](auto i) { return i >= count; });
    if (outside != mesh.indices.end())
        return expected("indices[" + std::to_string(outside - mesh.indices.begin()) + "]",
                        "a number below " + std::to_string(count), *outside);
    return std::nullopt;
}

template<class Made>
Result<Made> made(bool (*make)(const MeshView&, int, const Listener&, Made&), const MeshView& mesh, int threads,
                  const Progress& progress)
{
    if (const auto problem = problemOf(mesh))
        return *problem;
    Listener listener;
    if (progress)
        listener = {[](const void* p, double done) { return (*static_cast<const Progress*>(p))(done); }, &progress};
    Made all;
    if (!make(mesh, threads, listener, all))
        return stoppedError();
    return all;
}

} // namespace

Result<std::vector<glm::vec4>> mikktspaceTangents(const MeshView& mesh, int threads, const Progress& progress)
{
    return made(mikktspace::makeTangents, mesh, threads, progress);
}

Result<std::vector<glm::vec4>> areaWeightedTangents(const MeshView& mesh, int threads, const Progress& progress)
{
    return made(mikktspace::makeAreaWeighted, mesh, threads, progress);
}

Result<Cotangents> smoothCotangents(const MeshView& mesh, int threads, const Progress& progress)
{
    return made(tangents::averageCotangents, mesh, threads, progress);
}

// ---- compared ------------------------------------------------------------------------------

namespace {

bool isDegenerate(const MeshView& mesh, std::size_t corner)
{
    const auto i = mesh.indices.subspan(corner / 3 * 3, 3);
    const glm::dvec2 origin(mesh.texcoords[i[0]]);
    const glm::dvec2 a = glm::dvec2(mesh.texcoords[i[1]]) - origin;
    const glm::dvec2 b = glm::dvec2(mesh.texcoords[i[2]]) - origin;
    const glm::vec3 p = mesh.positions[i[0]], q = mesh.positions[i[1]], r = mesh.positions[i[2]];
    return a.x * b.y == a.y * b.x || p == q || q == r || p == r;
}

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : double(part) / double(whole); }

} // namespace

double reversedFraction(const TangentDifference& d)
{
    const auto turned = std::count_if(d.degrees.begin(), d.degrees.end(), [](float degrees) { return degrees > 90; });
    return share(std::size_t(turned), d.degrees.size());
}

double invertedFraction(const TangentDifference& d) { return share(d.handedness, d.degrees.size()); }

TangentDifference tangentDifference(const MeshView& mesh, std::span<const glm::vec4> stored,
                                    std::span<const glm::vec4> generated)
{
    TangentDifference d;
    d.corners = generated.size();
    for (std::size_t c = 0; c < generated.size(); ++c) {
        const glm::vec4 a = stored[mesh.indices[c]], b = generated[c];
        const glm::dvec3 from(a), to(b);
        if (isDegenerate(mesh, c) || !(glm::length(from) > 0) || !(glm::length(to) > 0)) {
            ++d.degenerate;
            continue;
        }
        d.degrees.push_back(float(glm::degrees(angleBetween(from, to))));
        d.handedness += (a.w < 0) != (b.w < 0);
    }
    return d;
}

void append(TangentDifference& to, const TangentDifference& more)
{
    to.degrees.insert(to.degrees.end(), more.degrees.begin(), more.degrees.end());
    to.corners += more.corners;
    to.degenerate += more.degenerate;
    to.handedness += more.handedness;
}

TangentVerdict verdictOf(const TangentDifference& d)
{
    if (d.degrees.empty())
        return TangentVerdict::nothing;
    if (d.handedness == 0 && *std::max_element(d.degrees.begin(), d.degrees.end()) <= kEqualTangents)
        return TangentVerdict::equal;
    if (invertedFraction(d) >= 0.9)
        return TangentVerdict::inverted;
    const double turned = reversedFraction(d);
    return turned >= 0.4 && turned <= 0.6 ? TangentVerdict::turned : TangentVerdict::off;
}

} // namespace cotan
