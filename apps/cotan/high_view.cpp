#include "high_view.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
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
constexpr int kMaxLayers = 32;           // maximum number of surfaces on one line
constexpr float kUpright = -1e-3f;       // minimum cosine at which a front counts as facing outwards

// The direction through the centre of pixel (x, y). axes: of the view's camera.
glm::vec3 rayThrough(const View& view, const CameraAxes& axes, int x, int y)
{
    const glm::vec3 forward(axes.forward), right(axes.right), up(axes.up);
    const float t = std::tan(view.camera.verticalFieldOfView / 2);
    const float aspect = float(view.width) / float(view.height);
    const float px = (float(x) + 0.5f) / float(view.width) * 2 - 1, py = 1 - (float(y) + 0.5f) / float(view.height) * 2;
    return glm::normalize(forward + right * (px * t * aspect) + up * (py * t));
}

// Finds the high surface that a pixel of the low one should show.
class ExpectedNormals {
public:
    ExpectedNormals(const LowSurface& low, const HighSurface& high, const BakeOptions& options, const LowTree& tree)
        : low_(low), high_(high), options_(options), tree_(tree), baker_(low, high, options)
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

    struct Answer {
        bool known = false, other = false;
        glm::vec3 normal{0};
    };
    // For a ray from the eye through a pixel.
    Answer expectedFor(glm::vec3 eye, glm::vec3 ray) const
    {
        const LowTree::TreeHit lowHit = tree_.first({eye, ray, 0, 1e30f});
        if (!lowHit.found || lowHit.triangle >= low_.triangleCount() || glm::dot(tree_.face(lowHit.triangle), ray) >= 0)
            return {};
        const UvSample sample{lowHit.triangle, lowHit.b1, lowHit.b2, true};
        LowPoints point;
        Probes probe;
        pointsOf(low_, {&sample, 1}, point);
        baker_.aim(point, {&sample, 1}, probe);
        const glm::vec3 at = probe.point.at(0), direction = probe.direction.at(0);
        if (!(glm::dot(direction, direction) > 0))
            return {};
        const float from = openDistance(tree_, lowHit.triangle, at, direction, 1e-4f * diagonal_, limit_);
        float passed = 0;
        for (int layer = 0; layer < kMaxLayers; ++layer) {
            const float left = from + limit_ - passed;
            const glm::vec3 start = at + direction * (from - passed);
            const Hit hit = left > 0 ? high_.trace({start, -direction, 0, left}) : Hit{};
            if (!hit.found)
                return {};
            const bool counts = probe.only[0] == Probes::kAny || probe.only[0] == high_.groupOf(hit.instance);
            if (counts && glm::dot(hit.front, direction) > 0 && glm::dot(hit.front, probe.normal.at(0)) > kUpright
                && sees(eye, start - direction * hit.distance, hit.front))
                return compareWithBaker(sample, probe, from - passed - hit.distance, normalOf(hit, direction));
            passed += hit.distance + 1e-5f * diagonal_;
        }
        return {};
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
    // Compares with the surface that the baker takes. offset: distance of the expected surface in front of the low one.
    Answer compareWithBaker(const UvSample& sample, const Probes& probe, float offset, glm::vec3 normal) const
    {
        Hits hits;
        baker_.find({&sample, 1}, probe, hits);
        return {true, !hits.found(0) || std::abs(hits.distance[0] - offset) > kMinSeparation * diagonal_, normal};
    }

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    const LowTree& tree_;
    Baker baker_;
    float diagonal_ = 0, limit_ = 0;
};

} // namespace

Result<HighView> renderHighView(const LowSurface& low, const HighSurface& high, const BakeOptions& given,
                                const View& view)
{
    BakeOptions options = given;
    COTAN_CHECK(measureRayStarts(low, high, options));
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
    const ExpectedNormals expectedNormals(low, high, options, *tree);
    const CameraAxes axes = cameraAxes(view.camera);
    parallelFor(0, view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
            const glm::vec3 ray = rayThrough(view, axes, x, y);
            if (const Hit hit = high.trace({view.camera.eye, ray, 0, 1e30f}); hit.found)
                storePixel(result.normals, x, y, glm::vec4(expectedNormals.normalOf(hit, ray), 1), false);
            const ExpectedNormals::Answer answer = expectedNormals.expectedFor(view.camera.eye, ray);
            if (answer.known)
                storePixel(result.expected, x, y, glm::vec4(answer.normal, 1), false);
            result.other[i] = answer.other ? 1 : 0;
        }
    });
    for (std::size_t i = 0; i < result.other.size(); ++i) {
        result.compared += result.expected.floats()[4 * i + 3] > 0;
        result.others += result.other[i];
    }
    return result;
}

} // namespace cotan::app
