#include "prefilter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/integer.hpp>

// Processors without such registers pass these vectors in another way; nobody outside this file is passed one.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace cotan::environment {

namespace {

constexpr int kCoarsest = 4;     // blocks a side
constexpr float kWidest = 0.15f; // radians of a texel: beside the horizon, where lobes end
constexpr float kNarrow = 0.35f; // a texel is beside the lobe and its distance from the lobe's middle

// Four numbers that are counted with at once; compilers take glm's apart.
using Four = float __attribute__((vector_size(16)));

Four four(const glm::vec4& v) { return Four{v.x, v.y, v.z, v.w}; }
float sumOf(Four v) { return (v[0] + v[1]) + (v[2] + v[3]); }

// What a texel holds, and sums of texels hold.
struct Held {
    glm::vec3 light{0};  // radiance times solid angle
    glm::vec3 where{0};  // directions, weighed by light
    glm::vec3 middle{0}; // the same by solid angle
    float solidAngle = 0;
};

constexpr unsigned kSamples = 64;

// A microfacet normal as often as it is seen along v; n = z.
glm::dvec3 visibleNormal(glm::dvec3 v, double alpha, glm::dvec2 u)
{
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const double flat = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::dvec3 t =
        flat > 1e-12 ? glm::dvec3(-stretched.y, stretched.x, 0) / std::sqrt(flat) : glm::dvec3(1, 0, 0);
    const glm::dvec3 b = glm::cross(stretched, t);
    const double r = std::sqrt(u.x), phi = 2 * std::numbers::pi * u.y;
    const double x = r * std::cos(phi);
    const double s = (1 + stretched.z) / 2;
    const double y = (1 - s) * std::sqrt(std::max(1 - x * x, 0.0)) + s * r * std::sin(phi);
    const glm::dvec3 h = x * t + y * b + std::sqrt(std::max(1 - x * x - y * y, 0.0)) * stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-9)));
}

// The point of a low-discrepancy set (Hammersley).
glm::dvec2 hammersley(unsigned index, unsigned count)
{
    return {(index + 0.5) / count, glm::bitfieldReverse(index) * 0x1p-32 + 0x1p-33};
}

// Solid angle of a square of side 1 in the map, around a unit direction.
// The map is the octahedron seen from above, unfolded: a square of side 2 there. On the octahedron a direction d ends
// at d / (|x|+|y|+|z|), whose distance r sets the angle: 1/r^3 times the area seen from above.
float solidAngleOfPlace(glm::vec3 d)
{
    const float size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    return 4 * size * size * size;
}

} // namespace

// Over an edge the map goes on with itself, turned round.
void Octahedral::fold()
{
    const int last = size_ - 1;
    for (int i = 0; i < size_; ++i) {
        at(i, -1) = at(last - i, 0);
        at(i, size_) = at(last - i, last);
        at(-1, i) = at(0, last - i);
        at(size_, i) = at(last, last - i);
    }
    for (const int x : {-1, size_})
        for (const int y : {-1, size_})
            at(x, y) = at(x < 0 ? last : 0, y < 0 ? last : 0);
}

glm::vec3 Octahedral::direction(int x, int y, glm::vec2 inside) const
{
    const glm::vec2 place((float(x) + inside.x) / float(size_), (float(y) + inside.y) / float(size_));
    return glm::normalize(f32::cotan_octahedral_direction(place));
}

LampTree::LampTree(const Octahedral& finest)
{
    int texels = finest.size();
    std::vector<Held> held(std::size_t(texels) * std::size_t(texels));
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            const glm::vec3 d = finest.direction(x, y);
            Held& h = held[std::size_t(y) * std::size_t(texels) + std::size_t(x)];
            h.solidAngle = solidAngleOfPlace(d) / (float(texels) * float(texels));
            h.light = glm::vec3(finest.at(x, y)) * h.solidAngle;
            h.middle = d * h.solidAngle;
            h.where = d * (h.light.x + h.light.y + h.light.z);
        }
    while (texels >= 2 * kCoarsest) {
        const int size = texels / 2;
        Level level{size, std::vector<Block>(std::size_t(size) * std::size_t(size))};
        std::vector<Held> sums(level.blocks.size());
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const std::size_t place = std::size_t(y) * std::size_t(size) + std::size_t(x);
                Block& b = level.blocks[place];
                Held& sum = sums[place];
                for (int i = 0; i < 4; ++i) {
                    const Held& h = held[std::size_t(2 * y + i / 2) * std::size_t(texels) + std::size_t(2 * x + i % 2)];
                    const glm::vec3 d = glm::normalize(glm::dot(h.where, h.where) > 0 ? h.where : h.middle);
                    b.x[i] = d.x, b.y[i] = d.y, b.z[i] = d.z;
                    b.solidAngle[i] = h.solidAngle;
                    for (int c = 0; c < 3; ++c)
                        b.light[std::size_t(c)][i] = h.light[c];
                    sum.light += h.light, sum.where += h.where, sum.middle += h.middle;
                    sum.solidAngle += h.solidAngle;
                }
                b.middle = glm::normalize(sum.middle);
                b.width = 0.5f * std::sqrt(sum.solidAngle);
                b.radius = 2 * b.width; // texels are up to 1.7 times as long as wide
            }
        levels_.push_back(std::move(level));
        held = std::move(sums);
        texels = size;
    }
    std::reverse(levels_.begin(), levels_.end());
}

void LampTree::lobes(std::span<const glm::vec3> normals, float alpha2, std::span<glm::vec3> means) const
{
    const float lobeWidth = 1.3f * std::sqrt(alpha2); // from its middle to half its height
    glm::vec3 sum(0);
    for (const glm::vec3& n : normals)
        sum += n;
    const glm::vec3 middle = glm::normalize(sum);
    float apart = 0;
    for (const glm::vec3& n : normals)
        apart = std::max(apart, glm::distance(n, middle));

    std::vector<const Block*> lamps; // that all of them see
    const auto visit = [&](const auto& self, std::size_t level, int x, int y) -> void {
        const Level& l = levels_[level];
        const Block& b = l.blocks[std::size_t(y) * std::size_t(l.size) + std::size_t(x)];
        const float cosine = glm::dot(middle, b.middle);
        if (cosine < -b.radius - apart)
            return; // behind
        const float away = std::sqrt(std::max(2 - 2 * cosine, 0.0f)) - b.radius - apart;
        if (level + 1 == levels_.size() || b.width <= std::min(kNarrow * std::max(lobeWidth, away), kWidest)) {
            lamps.push_back(&b);
            return;
        }
        for (int i = 0; i < 4; ++i)
            self(self, level + 1, 2 * x + i % 2, 2 * y + i / 2);
    };
    for (int y = 0; y < levels_[0].size; ++y)
        for (int x = 0; x < levels_[0].size; ++x)
            visit(visit, 0, x, y);

    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::vec3 n = normals[i];
        Four red{}, green{}, blue{}, weights{};
        for (const Block* b : lamps) {
            Four nl = four(b->x) * n.x + four(b->y) * n.y + four(b->z) * n.z;
            nl = nl > 0 ? nl : Four{};
            const Four d = 1 + (nl + 1) * (0.5f * (alpha2 - 1)); // the half vector's n.h^2 is (1 + nl) / 2
            const Four w = nl / (d * d);
            weights += four(b->solidAngle) * w;
            red += four(b->light[0]) * w, green += four(b->light[1]) * w, blue += four(b->light[2]) * w;
        }
        means[i] = glm::vec3(sumOf(red), sumOf(green), sumOf(blue)) / sumOf(weights);
    }
}

glm::dvec2 albedoFactors(double nv, double roughness)
{
    nv = std::max(nv, 1e-4);
    const double alpha = std::max(roughness, 0.045) * std::max(roughness, 0.045), alpha2 = alpha * alpha;
    const glm::dvec3 v(std::sqrt(std::max(1 - nv * nv, 0.0)), 0, nv);
    const double rootV = std::sqrt(alpha2 + (1 - alpha2) * nv * nv);
    glm::dvec2 sum(0);
    for (unsigned i = 0; i < kSamples; ++i) {
        const glm::dvec3 h = visibleNormal(v, alpha, hammersley(i, kSamples));
        const double vh = std::max(glm::dot(v, h), 0.0);
        const double nl = 2 * vh * h.z - v.z;
        if (nl <= 0)
            continue;
        // Smith's term for both directions over the one for the eye, which the sampling has in it.
        const double rootL = std::sqrt(alpha2 + (1 - alpha2) * nl * nl);
        const double share = nl * (nv + rootV) / (nl * rootV + nv * rootL);
        const double fresnel = f64::cotan_grazing(std::min(vh, 1.0));
        sum += share * glm::dvec2(1 - fresnel, fresnel);
    }
    return sum / double(kSamples);
}

} // namespace cotan::environment
