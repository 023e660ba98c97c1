#include <algorithm>

#include "mikktspace.hpp"

namespace cotan::mikktspace {

namespace {

using tangents::fastArcCosine;
using tangents::projectedAngle;
using tangents::projectedSides;
using tangents::projectedUnit;
using tangents::put;
using tangents::vectorAt;

// The following functions are branch-free, so that compilers vectorise them over triangles.

struct Directions {
    glm::vec3 u, v; // unit dP/du, dP/dv, or zero
    bool preserving, joinsAny, degenerate;
};

inline bool equal(glm::vec3 a, glm::vec3 b) { return (a.x == b.x) & (a.y == b.y) & (a.z == b.z); }

inline glm::vec3 select(bool condition, glm::vec3 v)
{
    return {condition ? v.x : 0.0f, condition ? v.y : 0.0f, condition ? v.z : 0.0f};
}

// Returns the directions of dP/du and dP/dv, and whether uv preserve the orientation. c0, c1, c2: uv of the corners.
inline Directions directionsOf(glm::vec3 p0, glm::vec3 p1, glm::vec3 p2, glm::vec2 c0, glm::vec2 c1, glm::vec2 c2)
{
    const bool equal01 = equal(p0, p1), equal02 = equal(p0, p2), equal12 = equal(p1, p2);
    const bool degenerate = equal01 | equal02 | equal12;
    const glm::vec3 d1 = p1 - p0, d2 = p2 - p0;
    const glm::vec2 e1 = c1 - c0, e2 = c2 - c0;
    const float area = e1.x * e2.y - e1.y * e2.x, size = std::abs(area);
    const bool usable = (size > FLT_MIN) & !degenerate;
    const float sign = area > 0 ? 1.0f : -1.0f;
    const glm::vec3 u = d1 * e2.y - d2 * e1.y, v = d2 * e1.x - d1 * e2.x;
    const float lengthU = std::sqrt(glm::dot(u, u)), lengthV = std::sqrt(glm::dot(v, v));
    const bool directed = usable & (lengthU / size > FLT_MIN) & (lengthV / size > FLT_MIN);
    return {select(usable & (lengthU > FLT_MIN), u * (sign / lengthU)),
            select(usable & (lengthV > FLT_MIN), v * (sign / lengthV)), area > 0 && !degenerate, !directed, degenerate};
}

// tangents::projectedUnit(u, n) times the weight of the corner, valid if `sound`.
struct Contribution {
    glm::vec3 value;
    bool sound; // no length needs double precision
};

template<Weight kWeight>
inline Contribution contributionOf(glm::vec3 u, glm::vec3 n, glm::vec3 p, glm::vec3 previous, glm::vec3 next)
{
    const glm::vec3 t = u - n * glm::dot(n, u);
    const glm::vec3 toPrevious = previous - p, toNext = next - p;
    const glm::vec3 a = toPrevious - n * glm::dot(n, toPrevious);
    const glm::vec3 b = toNext - n * glm::dot(n, toNext);
    const float tt = glm::dot(t, t), aa = glm::dot(a, a), bb = glm::dot(b, b);
    const bool sound = (tt > 1e-15f) & (tt < 1e15f) & (aa > 1e-15f) & (aa < 1e15f) & (bb > 1e-15f) & (bb < 1e15f);
    const float sides = std::sqrt(aa * bb);
    const glm::vec3 value = t * (1 / std::sqrt(tt)) * fastArcCosine(glm::dot(a, b) / sides);
    return {kWeight == Weight::area ? value * sides : value, sound};
}

// Triangles side by side, one per lane.
constexpr std::size_t kLanes = 16;
using Lane = float[kLanes];

struct Batch {
    Lane position[3][3], normal[3][3], texcoord[3][2]; // indexed by corner, then axis
    Lane u[3], v[3];
    Lane contribution[3][3];
    std::int32_t flags[kLanes], sound[kLanes];

    template<Weight kWeight> [[gnu::always_inline]] inline void derive()
    {
        std::fill_n(sound, kLanes, 1);
        deriveDirections();
        for (std::size_t k = 0; k < 3; ++k)
            deriveContributions<kWeight>(k);
    }

private:
    [[gnu::always_inline]] inline void deriveDirections()
    {
        for (std::size_t l = 0; l < kLanes; ++l) {
            const Directions d =
                directionsOf(vectorAt(position[0], l), vectorAt(position[1], l), vectorAt(position[2], l),
                             {texcoord[0][0][l], texcoord[0][1][l]}, {texcoord[1][0][l], texcoord[1][1][l]},
                             {texcoord[2][0][l], texcoord[2][1][l]});
            put(u, l, d.u);
            put(v, l, d.v);
            flags[l] =
                (d.preserving ? kPreserving : 0) | (d.joinsAny ? kJoinsAny : 0) | (d.degenerate ? kDegenerate : 0);
        }
    }

    template<Weight kWeight> [[gnu::always_inline]] inline void deriveContributions(std::size_t k)
    {
        const auto &p = position[k], &next = position[(k + 1) % 3], &previous = position[(k + 2) % 3], &n = normal[k];
        for (std::size_t l = 0; l < kLanes; ++l) {
            const Contribution c = contributionOf<kWeight>(vectorAt(u, l), vectorAt(n, l), vectorAt(p, l),
                                                           vectorAt(previous, l), vectorAt(next, l));
            put(contribution[k], l, select((flags[l] & kJoinsAny) == 0, c.value));
            sound[l] &= c.sound ? 1 : 0;
        }
    }
};

#if defined(__x86_64__) && defined(__GNUC__)
// Eight lanes at a time if the CPU supports it. Without fused multiply-add, so that the values are the same.
template<Weight kWeight> [[gnu::target("avx2")]] void deriveEight(Batch& batch) { batch.derive<kWeight>(); }

template<Weight kWeight> void derive(Batch& batch)
{
    static const bool eight = __builtin_cpu_supports("avx2") != 0;
    eight ? deriveEight<kWeight>(batch) : batch.derive<kWeight>();
}
#else
template<Weight kWeight> void derive(Batch& batch) { batch.derive<kWeight>(); }
#endif

void gather(const Triangles& t, std::size_t first, std::size_t lanes, Batch& batch)
{
    for (std::size_t l = 0; l < lanes; ++l)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = 3 * (first + l) + k;
            put(batch.position[k], l, t.position(corner));
            put(batch.normal[k], l, t.normal(corner));
            const glm::vec2 uv = t.texcoord(corner);
            batch.texcoord[k][0][l] = uv.x;
            batch.texcoord[k][1][l] = uv.y;
        }
}

// Returns the weight of a corner's triangle; 0 for a triangle without a direction.
float weightOf(const Triangles& t, std::size_t c)
{
    if (t.has(c / 3, kJoinsAny))
        return 0;
    const glm::vec3 p = t.position(c), previous = t.position(previousCorner(c)), next = t.position(nextCorner(c));
    const float angle = projectedAngle(p, previous, next, t.normal(c));
    return t.weight == Weight::angle ? angle : angle * projectedSides(p, previous, next, t.normal(c));
}

void scatter(const Batch& batch, std::size_t first, std::size_t lanes, Triangles& t, std::span<glm::vec4> contributions)
{
    for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t f = first + l;
        t.flags[f] = static_cast<std::uint8_t>(batch.flags[l]);
        t.alongV[f] = vectorAt(batch.v, l);
        for (std::size_t k = 0; k < 3; ++k)
            contributions[3 * f + k] = glm::vec4(
                batch.sound[l] != 0 ? vectorAt(batch.contribution[k], l)
                                    : projectedUnit(vectorAt(batch.u, l), t.normal(3 * f + k)) * weightOf(t, 3 * f + k),
                0);
    }
}

// Branch-free, so that compilers vectorise it.
VertexRange rangeOf(std::span<const std::uint32_t> vertices)
{
    VertexRange range{vertices[0], vertices[0]};
    for (const std::uint32_t v : vertices) {
        range.minimum = std::min(range.minimum, v);
        range.maximum = std::max(range.maximum, v);
    }
    return range;
}

} // namespace

Triangles makeTriangles(const MeshView& mesh, Weight weight, LargeArray<std::uint32_t> firstVertex, std::size_t threads,
                        std::span<glm::vec4> contributions)
{
    const std::size_t count = mesh.indices.size() / 3;
    std::uint32_t moved = 0; // without a branch, so that compilers compare several at once
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        moved |= firstVertex[v] ^ v;
    const std::size_t blocks = (count + kBlock - 1) / kBlock;
    Triangles t{mesh, weight, count, mesh.indices.data(), {}, makeLargeArray<std::uint8_t>(count), {}, {}};
    t.alongV = makeLargeArray<glm::vec3>(count);
    t.ranges.assign(blocks, {0, kNone});
    if (moved != 0)
        t.vertices = (t.welded = makeLargeArray<std::uint32_t>(3 * count)).get();
    runParts(blocks, threads, [&](std::size_t firstBlock, std::size_t endBlock) {
        const auto batch = std::make_unique<Batch>();
        for (std::size_t block = firstBlock; block < endBlock; ++block) {
            const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, count);
            if (t.welded)
                for (std::size_t c = 3 * begin; c < 3 * end; ++c)
                    t.welded[c] = firstVertex[mesh.indices[c]];
            if (threads > 1) // a single thread reads all blocks anyway
                t.ranges[block] = rangeOf({t.vertices + 3 * begin, 3 * (end - begin)});
            for (std::size_t first = begin; first < end; first += kLanes) {
                const std::size_t lanes = std::min(kLanes, end - first);
                gather(t, first, lanes, *batch);
                weight == Weight::area ? derive<Weight::area>(*batch) : derive<Weight::angle>(*batch);
                scatter(*batch, first, lanes, t, contributions);
            }
        }
    });
    return t;
}

glm::vec3 alongU(const Triangles& t, std::size_t f)
{
    return directionsOf(t.position(3 * f), t.position(3 * f + 1), t.position(3 * f + 2), t.texcoord(3 * f),
                        t.texcoord(3 * f + 1), t.texcoord(3 * f + 2))
        .u;
}

} // namespace cotan::mikktspace
