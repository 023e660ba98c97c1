#include "reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/parse_number.hpp"
#include "scene/bounds.hpp"

namespace cotan {

namespace {

constexpr double kMomentsASecond = 30;
constexpr std::size_t kMaxMoments = 256, kFewestMoments = 9;
constexpr std::size_t kMaxPosed = 8'000'000; // vertices of all moments
constexpr std::size_t kMaxKept = 300'000;    // points
constexpr std::size_t kDirections = 64;

// Evenly over the sphere, with their opposites (R. Swinbank, R. J. Purser, Fibonacci grids, 2006).
std::array<glm::vec3, kDirections> directions()
{
    std::array<glm::vec3, kDirections> all;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const float z = 1 - (float(i) + 0.5f) / float(kDirections), side = std::sqrt(1 - z * z);
        const float angle = 2.399963f * float(i);
        all[i] = {side * std::cos(angle), side * std::sin(angle), z};
    }
    return all;
}

void addAll(const Scene& scene, std::vector<glm::vec3>& points)
{
    forEachPlacedPoint(
        scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { points.emplace_back(toWorld * glm::vec4(p, 1)); });
}

// The points that lie furthest to both sides along each direction.
void addFurthest(const Scene& scene, std::vector<glm::vec3>& points)
{
    static const std::array<glm::vec3, kDirections> kAlong = directions();
    struct Furthest {
        float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();
        glm::vec3 lowest{0}, highest{0};
    };
    std::array<Furthest, kDirections> found;
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) {
        const glm::vec3 world(toWorld * glm::vec4(p, 1));
        for (std::size_t i = 0; i < kDirections; ++i) {
            const float far = glm::dot(world, kAlong[i]);
            if (far < found[i].low)
                found[i].low = far, found[i].lowest = world;
            if (far > found[i].high)
                found[i].high = far, found[i].highest = world;
        }
    });
    for (const Furthest& f : found)
        if (f.low <= f.high) {
            points.push_back(f.lowest);
            points.push_back(f.highest);
        }
}

std::size_t verticesPlaced(const Scene& scene)
{
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            count += mesh->vertexCount();
    return count;
}

double secondsOf(const AnimatedGltf& model, const std::string& animation)
{
    const auto& all = model.animations();
    const auto named = std::ranges::find(all, animation, &GltfAnimation::name);
    if (named != all.end())
        return named->seconds;
    std::size_t number = 0;
    return parseNumber(std::string_view(animation), number) && number < all.size() ? all[number].seconds : 0;
}

} // namespace

Result<std::vector<glm::vec3>> pointsReached(AnimatedGltf& model, const std::string& animation)
{
    const double seconds = secondsOf(model, animation);
    std::vector<glm::vec3> points;
    std::size_t moments = 1, vertices = 0;
    for (std::size_t i = 0; i < moments; ++i) {
        const double part = moments > 1 ? double(i) / double(moments - 1) : 0;
        const auto scene = model.at({animation, seconds * part});
        if (!scene)
            return scene.error();
        if (i == 0 && seconds > 0) {
            vertices = std::max<std::size_t>(verticesPlaced(*scene), 1);
            const std::size_t payable = std::clamp(kMaxPosed / vertices, kFewestMoments, kMaxMoments);
            moments = std::min(payable, std::size_t(std::min(seconds * kMomentsASecond, 1e6)) + 2);
        }
        if (vertices * moments <= kMaxKept)
            addAll(*scene, points);
        else
            addFurthest(*scene, points);
    }
    return points;
}

} // namespace cotan
