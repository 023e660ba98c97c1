#include "lamps.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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

} // namespace

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

} // namespace cotan::environment
