#include "high_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/baker.hpp"
#include "core/loops.hpp"
#include "core/try.hpp"
#include "scene/geometry.hpp"
#include "scene/sample_positions.hpp"

namespace cotan::app {

namespace {

constexpr float kMinSeparation = 0.001f; // of different surfaces, as a fraction of the low surface's diagonal
constexpr int kAcross = 3;               // rays across a pixel; all fit into a packet
constexpr int kMaxLayers = 32;           // maximum number of surfaces on one line
constexpr float kUpright = -1e-3f;       // minimum cosine at which a front counts as facing outwards

// The direction through a point of the image, in pixels. axes: of the view's camera.
glm::vec3 rayThrough(const View& view, const CameraAxes& axes, float x, float y)
{
    const glm::vec3 forward(axes.forward), right(axes.right), up(axes.up);
    const float t = std::tan(view.camera.verticalFieldOfView / 2);
    const float aspect = float(view.width) / float(view.height);
    const float px = x / float(view.width) * 2 - 1, py = 1 - y / float(view.height) * 2;
    return glm::normalize(forward + right * (px * t * aspect) + up * (py * t));
}

struct Expected {
    glm::vec3 normal;
    float offset; // in front of the low surface, along the line
};

// Finds the high surface that a pixel of the low one should show.
class ExpectedNormals {
public:
    // straight: as `options`, with rays that are straight wherever they can be.
    ExpectedNormals(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                    const BakeOptions& straight, const LowTree& tree)
        : low_(low), high_(high), options_(options), tree_(tree), baker_(low, high, options),
          straight_(low, high, straight)
    {
        glm::vec3 from(1e30f), to(-1e30f);
        for (const std::uint32_t i : low.indices) {
            from = glm::min(from, low.positions[i]);
            to = glm::max(to, low.positions[i]);
        }
        diagonal_ = glm::length(to - from);
        limit_ = options.maxDistance > 0 ? options.maxDistance
            : options.starts             ? options.starts->limit
                                         : 0.1f * diagonal_;
    }

    glm::vec3 normalOf(const Hit& hit, glm::vec3 direction) const
    {
        const glm::vec3 n = high_.normalOf(hit, options_.highNormals, direction);
        return options_.highMaps
            ? options_.highMaps->normalAt(hit.instance, hit.triangle, double(hit.b1), double(hit.b2), n)
            : n;
    }

    // Finds the outermost surface that the camera sees on the line of a probe, in the limit.
    std::optional<Expected> seenOn(glm::vec3 eye, std::uint32_t triangle, const Probes& probes, std::size_t i) const
    {
        const glm::vec3 at = probes.point.at(i), direction = probes.direction.at(i);
        if (!(glm::dot(direction, direction) > 0))
            return std::nullopt;
        const float from = openDistance(tree_, triangle, at, direction, 1e-4f * diagonal_, limit_);
        float passed = 0;
        for (int layer = 0; layer < kMaxLayers; ++layer) {
            const float left = from + limit_ - passed;
            const glm::vec3 start = at + direction * (from - passed);
            const Hit hit = left > 0 ? high_.trace({start, -direction, 0, left}) : Hit{};
            if (!hit.found)
                return std::nullopt;
            const bool counts = probes.only[i] == Probes::kAny || probes.only[i] == high_.groupOf(hit.instance);
            if (counts && glm::dot(hit.front, direction) > 0 && glm::dot(hit.front, probes.normal.at(i)) > kUpright
                && sees(eye, start - direction * hit.distance, hit.front))
                return Expected{normalOf(hit, direction), from - passed - hit.distance};
            passed += hit.distance + 1e-5f * diagonal_;
        }
        return std::nullopt;
    }

    // The sum of the normals that a pixel should show, for rays from the eye through it; zero if one is unknown.
    glm::vec3 expectedFor(glm::vec3 eye, std::span<const glm::vec3> rays) const
    {
        std::array<UvSample, kLanes> samples;
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (const auto sample = lowAt(eye, rays[i]))
                samples[i] = *sample;
            else
                return glm::vec3(0);
        const std::span<const UvSample> used(samples.data(), rays.size());
        LowPoints points;
        Probes probes;
        pointsOf(low_, used, points);
        straight_.aim(points, used, probes);
        glm::vec3 sum(0);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (const auto seen = seenOn(eye, samples[i].triangle, probes, i))
                sum += seen->normal;
            else
                return glm::vec3(0);
        return sum;
    }

    // Whether the map shows another surface than the camera sees on the baker's own line; nothing if it sees none.
    std::optional<bool> bakesAnother(glm::vec3 eye, glm::vec3 ray) const
    {
        const auto sample = lowAt(eye, ray);
        if (!sample)
            return std::nullopt;
        LowPoints point;
        Probes probe;
        pointsOf(low_, {&*sample, 1}, point);
        baker_.aim(point, {&*sample, 1}, probe);
        const auto seen = seenOn(eye, sample->triangle, probe, 0);
        if (!seen)
            return std::nullopt;
        Hits hits;
        baker_.find({&*sample, 1}, probe, hits);
        return !hits.found(0) || std::abs(hits.distance[0] - seen->offset) > kMinSeparation * diagonal_;
    }

private:
    bool sees(glm::vec3 eye, glm::vec3 point, glm::vec3 front) const
    {
        const glm::vec3 direction = point - eye;
        const float distance = glm::length(direction);
        return glm::dot(front, direction) < 0
            && !high_.blocked(
                {eye, direction / distance, 0, distance - std::min(kMinSeparation * diagonal_, 0.5f * distance)});
    }
    // The point of the low surface that a ray from the eye hits first, if on its front.
    std::optional<UvSample> lowAt(glm::vec3 eye, glm::vec3 ray) const
    {
        const LowTree::TreeHit hit = tree_.first({eye, ray, 0, 1e30f});
        if (!hit.found || hit.triangle >= low_.triangleCount() || glm::dot(tree_.face(hit.triangle), ray) >= 0)
            return std::nullopt;
        return UvSample{hit.triangle, hit.b1, hit.b2, true};
    }

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    const LowTree& tree_;
    Baker baker_, straight_;
    float diagonal_ = 0, limit_ = 0;
};

} // namespace

Result<HighView> renderHighView(const LowSurface& low, const HighSurface& high, const BakeOptions& given,
                                const View& view)
{
    BakeOptions options = given;
    COTAN_CHECK(measureRayStarts(low, high, options));
    BakeOptions straight = options;
    if (options.rays != BakeRays::automatic || !options.starts) {
        straight.rays = BakeRays::automatic;
        straight.search = BakeSearch::first;
        straight.cage.clear();
        straight.starts = nullptr;
        COTAN_CHECK(measureRayStarts(low, high, straight));
    }
    std::optional<LowTree> tree = options.starts ? options.starts->tree : std::nullopt;
    if (!tree) {
        COTAN_TRY(made,
                  LowTree::make(low.positions, low.indices, highGroups(low.triangleInstance, options.matched),
                                options.threads));
        tree = std::move(*made);
    }
    HighView result{.normals = makeImage(view.width, view.height, PixelType::float32, "high surface"),
                    .expected = makeImage(view.width, view.height, PixelType::float32, "expected normals"),
                    .other = std::vector<std::uint8_t>(std::size_t(view.width) * std::size_t(view.height), 0)};
    std::vector<std::uint8_t> known(result.other.size(), 0);
    const ExpectedNormals expectedNormals(low, high, options, straight, *tree);
    const CameraAxes axes = cameraAxes(view.camera);
    parallelFor(0, view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
            const glm::vec3 eye = view.camera.eye, ray = rayThrough(view, axes, float(x) + 0.5f, float(y) + 0.5f);
            if (const Hit hit = high.trace({eye, ray, 0, 1e30f}); hit.found)
                storePixel(result.normals, x, y, glm::vec4(expectedNormals.normalOf(hit, ray), 1), false);
            const std::optional<bool> another = expectedNormals.bakesAnother(eye, ray);
            known[i] = another.has_value();
            result.other[i] = another.value_or(false);
            if (!another)
                continue;
            std::array<glm::vec3, kAcross * kAcross> rays;
            for (int k = 0; k < kAcross * kAcross; ++k)
                rays[std::size_t(k)] = rayThrough(view, axes, float(x) + (float(k % kAcross) + 0.5f) / kAcross,
                                                  float(y) + (float(k / kAcross) + 0.5f) / kAcross);
            const glm::vec3 sum = expectedNormals.expectedFor(eye, rays);
            if (glm::dot(sum, sum) > 0)
                storePixel(result.expected, x, y, glm::vec4(glm::normalize(sum), 1), false);
        }
    });
    for (std::size_t i = 0; i < known.size(); ++i) {
        result.compared += known[i];
        result.others += result.other[i];
    }
    return result;
}

} // namespace cotan::app
