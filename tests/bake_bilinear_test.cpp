// Bar C3: the error of bilinear filtering near triangle edges. Also checks that the float frames that maps are baked
// with agree with the double frames that define them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/bake_surfaces.hpp"
#include "bake/low_points.hpp"
#include "bake/surface/uv_raster.hpp"
#include "tessellation_scene.hpp"

namespace cotan {
namespace {

constexpr int kTexels = 1024; // per unit of uv

// A map of the 12-segment sphere in one frame; its rows of texels are computed on first use.
class BakedRelief {
public:
    BakedRelief(Frame frame)
        : surface_(surfaces().front()), mesh_(tessellate(surface_, 12, false)), frame_(frame),
          low_(*makeLowSurface(sceneOf(mesh_), -1, frame, TangentOrigin::generated)),
          raster_({low_.texcoords, low_.indices}, kTexels, kTexels)
    {
    }

    const Tessellation& mesh() const { return mesh_; }

    glm::dvec3 target(const Interpolated& x) const
    {
        return truthS(surface_.at(x.parameters), texelOf(Waves{1.2, 12}.at(x.uv.x, x.uv.y)));
    }

    // Gets the texel, quantised to 16 bits, and the target normal there. Returns false outside all triangles.
    bool texel(int x, int y, glm::dvec3& m, glm::dvec3& normal)
    {
        if (x < 0 || y < 0 || x >= kTexels || y >= kTexels)
            return false;
        auto [row, isNew] = rows_.try_emplace(y);
        if (isNew)
            raster_.row(y, row->second);
        const auto samples = row->second.of(std::size_t(x));
        const auto sample = std::ranges::find_if(samples, &UvSample::covers);
        if (sample == samples.end())
            return false;
        const double b1 = sample->b1, b2 = sample->b2;
        normal = target(interpolate(mesh_, {sample->triangle, {1 - b1 - b2, b1, b2}}));
        m = encode(pointOf(low_, sample->triangle, b1, b2).frame, Covector3d(normal));
        for (int k = 0; k < 3; ++k)
            m[k] = std::round((m[k] + 1) * 32767.5) / 32767.5 - 1;
        return true;
    }

private:
    Surface surface_;
    Tessellation mesh_;
    Frame frame_;
    LowSurface low_;
    UvRaster raster_;
    std::map<int, UvRow> rows_;
};

struct NearEdges {
    std::vector<double> shaded, objectSpace; // degrees, sorted
    double mean(const std::vector<double>& v) const
    {
        double sum = 0;
        for (double e : v)
            sum += e;
        return sum / double(v.size());
    }
};

// Whether the point is within one texel of an edge of its triangle.
bool nearEdge(const Tessellation& mesh, const TrianglePoint& at)
{
    const std::uint32_t* v = &mesh.indices[3 * at.triangle];
    const glm::dvec2 a(mesh.texcoords[v[0]]), b(mesh.texcoords[v[1]]), c(mesh.texcoords[v[2]]);
    const double twiceArea = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    const double edges[3] = {glm::length(c - b), glm::length(a - c), glm::length(b - a)};
    for (int k = 0; k < 3; ++k)
        if (at.weights[std::size_t(k)] * twiceArea / edges[k] * kTexels < 1)
            return true;
    return false;
}

NearEdges filtered(Frame frame)
{
    BakedRelief relief(frame);
    NearEdges result;
    Random random(19);
    while (result.shaded.size() < 1500) {
        const TrianglePoint at = randomPoint(random, relief.mesh());
        if (!nearEdge(relief.mesh(), at))
            continue;
        const Interpolated x = interpolate(relief.mesh(), at);
        const glm::dvec2 p = x.uv * double(kTexels) - 0.5, base = glm::floor(p), f = p - base;
        glm::dvec3 m(0), normal(0);
        bool whole = true;
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                glm::dvec3 texel(0), target(0);
                whole = whole && relief.texel(int(base.x) + i, int(base.y) + j, texel, target);
                const double weight = (i ? f.x : 1 - f.x) * (j ? f.y : 1 - f.y);
                m += texel * weight;
                normal += target * weight;
            }
        if (!whole)
            continue;
        const glm::dvec3 truth = relief.target(x);
        result.shaded.push_back(degreesBetween(shade(frame, false, x, x.edges, m), truth));
        result.objectSpace.push_back(degreesBetween(normal, truth));
    }
    std::sort(result.shaded.begin(), result.shaded.end());
    std::sort(result.objectSpace.begin(), result.objectSpace.end());
    return result;
}

TEST(BakeBarC3, smoothFramesFilterAlmostAsWellAsObjectSpace)
{
    const NearEdges smooth = filtered(Frame::smooth);
    EXPECT_LT(smooth.mean(smooth.shaded), 1.2 * smooth.mean(smooth.objectSpace)); // no frame can avoid that error
    EXPECT_LT(smooth.shaded[smooth.shaded.size() * 95 / 100], 0.10);
}

TEST(BakeBarC3, aFramePerTriangleCreasesAtEdges)
{
    // The range that bar C3 names for frames per triangle: 0.14 to 1.5 degrees.
    const NearEdges perTriangle = filtered(Frame::cotangent);
    EXPECT_GT(perTriangle.mean(perTriangle.shaded), 0.14);
}

TEST(BakeFrames, agreeInFloatAndDouble)
{
    for (const Surface& surface : surfaces())
        for (Frame frame : {Frame::cotangent, Frame::unit, Frame::orthonormal, Frame::gradient, Frame::exact,
                            Frame::smooth, Frame::vertex, Frame::mikktspace}) {
            const Tessellation mesh = tessellate(surface, 16, true);
            const auto low = makeLowSurface(sceneOf(mesh), -1, frame, TangentOrigin::generated);
            ASSERT_TRUE(low);
            Random random(20);
            LowPoints points;
            for (int i = 0; i < 200; ++i) {
                std::vector<UvSample> samples; // up to a packet; sometimes several on one triangle
                while (samples.size() < std::size_t(1 + i % 16)) {
                    const TrianglePoint at = randomPoint(random, mesh);
                    samples.push_back({std::uint32_t(at.triangle), float(at.weights[1]), float(at.weights[2]), true});
                    if (samples.size() % 3 == 2)
                        samples.push_back({std::uint32_t(at.triangle), 0.25f, 0.5f, true});
                }
                samples.resize(std::min(samples.size(), kLanes));
                pointsOf(*low, samples, points);
                std::vector<glm::dvec3> expected;
                Lanes3 targets, texels;
                for (std::size_t k = 0; k < samples.size(); ++k) {
                    const LowPoint exact = pointOf(*low, samples[k].triangle, samples[k].b1, samples[k].b2);
                    EXPECT_LT(glm::length(glm::dvec3(points.position.at(k)) - exact.position), 1e-5); // rounding near 1
                    EXPECT_LT(glm::length(glm::dvec3(points.normal.at(k)) - exact.normal), 1e-6);
                    const glm::dvec3 target = glm::normalize(exact.normal + 0.6 * random.direction());
                    targets.set(k, glm::vec3(target));
                    expected.push_back(encode(exact.frame, Covector3d(target)));
                }
                encode(points, targets, texels);
                // A frame as skewed as a sphere's at its poles loses two of float's seven digits. For comparison, one
                // step of an 8-bit texel is 0.4 degrees, of a 16-bit one 0.002.
                for (std::size_t k = 0; k < samples.size(); ++k)
                    EXPECT_LT(degreesBetween(glm::dvec3(texels.at(k)), expected[k]), 1e-3) << name(frame);
            }
        }
}

} // namespace
} // namespace cotan
