// uv_cases.gltf: one flat grid under sixteen uv and node transforms. The expected normals follow from the gradients of
// uv over the plane of each grid, scaled together and applied to the texel.
#include "models.hpp"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

#include "cotan/frame.hpp"
#include "truth/quad.hpp"

namespace cotan {
namespace {

using namespace test;

constexpr const char* kModel = "synthetic/uv_cases.gltf";

// World-space description of a grid: an affine map from world xy to uv, solved from three vertices that are far apart.
struct Grid {
    std::string name;
    glm::dvec3 low, high; // world space
    glm::dvec3 normal;
    glm::dvec3 gradU, gradV; // zero for degenerate uv
    glm::dvec2 uvAtOrigin;
    bool degenerate = false;
};

Grid gridOf(const Scene& scene, const Instance& instance)
{
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const glm::dmat4 m(instance.toWorld);
    auto world = [&](std::size_t i) { return glm::dvec3(m * glm::dvec4(glm::dvec3(mesh.positions[i]), 1)); };
    Grid g;
    g.name = instance.name;
    g.low = g.high = world(0);
    std::size_t farRight = 0, farUp = 0;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        g.low = glm::min(g.low, world(i));
        g.high = glm::max(g.high, world(i));
        const glm::vec3 d = mesh.positions[i] - mesh.positions[0];
        if (std::abs(d.x) > std::abs((mesh.positions[farRight] - mesh.positions[0]).x) && d.y == 0)
            farRight = i;
        if (std::abs(d.y) > std::abs((mesh.positions[farUp] - mesh.positions[0]).y) && d.x == 0)
            farUp = i;
    }
    g.normal = glm::normalize(glm::transpose(glm::inverse(glm::dmat3(m))) * glm::dvec3(mesh.normals[0]));
    const glm::dvec3 e1 = world(farRight) - world(0), e2 = world(farUp) - world(0);
    const auto& uv = mesh.texcoords[0];
    const glm::dvec2 d1 = glm::dvec2(uv[farRight]) - glm::dvec2(uv[0]);
    const glm::dvec2 d2 = glm::dvec2(uv[farUp]) - glm::dvec2(uv[0]);
    const glm::dvec3 area = glm::cross(e1, e2);
    const double a2 = glm::dot(area, area);
    const glm::dvec3 r1 = glm::cross(e2, area) / a2, r2 = glm::cross(area, e1) / a2;
    g.gradU = r1 * d1.x + r2 * d2.x;
    g.gradV = r1 * d1.y + r2 * d2.y;
    const double size = glm::length(g.gradU) + glm::length(g.gradV);
    g.degenerate = size == 0 || glm::length(glm::cross(g.gradU, g.gradV)) < 1e-6 * size * size;
    g.uvAtOrigin = glm::dvec2(uv[0]) - glm::dvec2(glm::dot(g.gradU, world(0)), glm::dot(g.gradV, world(0)));
    return g;
}

// The decoded texel for nearest sampling; false near a texel's border, where rounding decides.
bool texelAt(const Image& map, glm::dvec2 uv, glm::dvec3& m)
{
    const glm::dvec2 t = (uv - glm::floor(uv)) * glm::dvec2(map.width, map.height);
    const glm::dvec2 f = t - glm::floor(t);
    if (std::min(f.x, f.y) < 0.02 || std::max(f.x, f.y) > 0.98)
        return false;
    const std::uint8_t* p = map.bytes8() + (std::size_t(t.y) * std::size_t(map.width) + std::size_t(t.x)) * 4;
    m = glm::dvec3((p[0] - 128.0) / 127, -(p[1] - 128.0) / 127, (p[2] - 128.0) / 127);
    return true;
}

struct Error {
    double mean = 0, worst = 0;
    int count = 0;
};

Error errorOver(const Grid& g, const Scene& scene, Renderer& renderer)
{
    View view = frontView(glm::vec2(g.low), glm::vec2(g.high), 300 / float(g.high.x - g.low.x));
    view.frame = Frame::cotangent;
    view.pointSampled = true;
    const Image normals = drawWith(renderer, view);
    const Image& map = scene.images[0];
    const double scale = g.degenerate ? 0 : commonScale(g.gradU, g.gradV);
    const double perUnit = view.height / double(view.camera.verticalExtent);
    // Nodes that turn the grid's back to the camera are drawn as a thin sheet: negated.
    const double facing = g.normal.z < 0 ? -1 : 1;
    Error error;
    for (int y = 4; y + 4 < view.height; ++y)
        for (int x = 4; x + 4 < view.width; ++x) {
            const glm::dvec3 p(view.camera.eye.x + (x + 0.5 - view.width * 0.5) / perUnit,
                               view.camera.eye.y - (y + 0.5 - view.height * 0.5) / perUnit, g.low.z);
            glm::dvec3 m(0, 0, 1);
            const glm::dvec2 uv = g.uvAtOrigin + glm::dvec2(glm::dot(g.gradU, p), glm::dot(g.gradV, p));
            if (!g.degenerate && !texelAt(map, uv, m))
                continue;
            const glm::dvec3 got = directionAt(normals, x, y);
            if (got == glm::dvec3(0))
                continue;
            const glm::dvec3 truth =
                facing * glm::normalize(g.gradU * (scale * m.x) + g.gradV * (scale * m.y) + g.normal * m.z);
            if (g.degenerate) {
                EXPECT_NEAR(glm::length(got), 1, 1e-4) << g.name;
                ++error.count;
                continue;
            }
            const double e = degreesBetween(got, truth);
            error.mean += e;
            error.worst = std::max(error.worst, e);
            ++error.count;
        }
    error.mean /= std::max(error.count, 1);
    return error;
}

void check(const char* device)
{
    COTAN_NEEDS_DATA(kModel);
    auto renderer = rendererFor(device);
    if (!renderer)
        GTEST_SKIP() << "no Vulkan device";
    const Scene scene = loadModel(kModel);
    ASSERT_EQ(scene.instances.size(), 16u);
    ASSERT_EQ(scene.images.size(), 1u);
    ASSERT_TRUE(renderer->load(scene));
    int degenerate = 0;
    for (const Instance& instance : scene.instances) {
        const Grid g = gridOf(scene, instance);
        const Error e = errorOver(g, scene, *renderer);
        EXPECT_GT(e.count, 3000) << g.name; // `tiny` covers so few texels that most pixels are near a border
        degenerate += g.degenerate;
        if (!g.degenerate) {
            EXPECT_LT(e.worst, 0.1) << g.name; // float differences of 1/300 pixel: measured below 0.03
        }
        ::testing::Test::RecordProperty(g.name, std::to_string(e.mean) + " mean, " + std::to_string(e.worst) + " max");
    }
    EXPECT_EQ(degenerate, 2);
}

TEST(UvCases, all16TransformsGiveTheAnalyticNormalOnTheReference) { check("reference"); }
TEST(UvCases, all16TransformsGiveTheAnalyticNormalOnVulkan) { check("auto"); }

} // namespace
} // namespace cotan
