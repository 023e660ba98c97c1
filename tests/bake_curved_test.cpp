// The curved surface through a mesh's vertices and normals, compared with the surface that was tessellated.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "bake/curved_normals.hpp"
#include "bake/high_surface.hpp"
#include "truth/random.hpp"

namespace cotan {
namespace {

// Height of a relief of a few waves with slopes up to 0.7. normalAt gives its normal.
double height(double x, double y)
{
    return 0.1 * std::sin(5 * x + 1) * std::cos(4 * y) + 0.05 * std::sin(3 * x - 2 * y);
}
glm::dvec3 normalAt(double x, double y)
{
    const double hx = 0.5 * std::cos(5 * x + 1) * std::cos(4 * y) + 0.15 * std::cos(3 * x - 2 * y);
    const double hy = -0.4 * std::sin(5 * x + 1) * std::sin(4 * y) - 0.1 * std::cos(3 * x - 2 * y);
    return glm::normalize(glm::dvec3(-hx, -hy, 1));
}

enum class Winding { outwards, inwards };

// A grid of cells x cells quads over the unit square, each of two triangles. Inner vertices are moved to make the mesh
// irregular, like real ones.
Scene relief(int cells, Winding winding = Winding::outwards)
{
    Scene scene;
    scene.name = "relief";
    Mesh mesh;
    Random random(3);
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const bool inside = i > 0 && i < cells && j > 0 && j < cells;
            const double x = (i + (inside ? 0.3 * random.range(-1, 1) : 0)) / cells;
            const double y = (j + (inside ? 0.3 * random.range(-1, 1) : 0)) / cells;
            mesh.positions.emplace_back(float(x), float(y), float(height(x, y)));
            mesh.normals.emplace_back(normalAt(x, y));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto a = std::uint32_t(j * (cells + 1) + i), b = a + 1, d = a + std::uint32_t(cells) + 1, c = d + 1;
            for (std::uint32_t k : {a, b, c, a, c, d})
                mesh.indices.push_back(k);
        }
    if (winding == Winding::inwards)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({});
    return scene;
}

// Intersection of a ray from above with the relief itself, by Newton's method.
glm::dvec3 truthAlong(glm::dvec3 origin, glm::dvec3 direction)
{
    double t = -origin.z / direction.z;
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 p = origin + t * direction, n = normalAt(p.x, p.y);
        t += (height(p.x, p.y) - p.z) * n.z / glm::dot(direction, n);
    }
    const glm::dvec3 p = origin + t * direction;
    return normalAt(p.x, p.y);
}

double degrees(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29577951308232;
}

struct Errors {
    double interpolated = 0, curved = 0; // mean degrees
};

Errors errorsOf(const Scene& scene)
{
    auto surface = HighSurface::make({scene}, 1);
    EXPECT_TRUE(surface);
    surface->curve(1);
    Errors errors;
    Random random(11);
    const int rays = 4000;
    for (int i = 0; i < rays; ++i) {
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3(0.5 * random.range(-1, 1), 0.5 * random.range(-1, 1), -1));
        const glm::dvec3 target(random.range(0.2, 0.8), random.range(0.2, 0.8), 0);
        const glm::vec3 origin(target - direction * (0.5 / -direction.z)), towards(direction);
        const Hit hit = surface->trace({origin, towards, 0, 10});
        if (!hit.found) {
            ADD_FAILURE() << "ray " << i;
            break;
        }
        const glm::dvec3 truth = truthAlong(glm::dvec3(origin), glm::dvec3(towards));
        errors.interpolated += degrees(glm::dvec3(surface->normalOf(hit, HighNormals::smooth, towards)), truth) / rays;
        errors.curved += degrees(glm::dvec3(surface->normalOf(hit, HighNormals::curved, towards)), truth) / rays;
    }
    return errors;
}

TEST(Curved, curvedErrorsAreThirdOrderAndInterpolatedOnesSecond)
{
    const Errors coarse = errorsOf(relief(12)), fine = errorsOf(relief(24));
    // Halving the edges divides second-order errors by 4, third-order ones by 8. Irregular neighbours need margins.
    EXPECT_GT(coarse.interpolated / fine.interpolated, 3.2);
    EXPECT_LT(coarse.interpolated / fine.interpolated, 4.8);
    EXPECT_GT(coarse.curved / fine.curved, 7);
    EXPECT_LT(coarse.curved, coarse.interpolated / 5);
    EXPECT_LT(fine.curved, fine.interpolated / 10);
}

TEST(Curved, windingDoesNotMatter)
{
    // The same triangles with the opposite winding: only rounding differs, 1e-7 on steps of a tenth.
    EXPECT_NEAR(errorsOf(relief(12)).curved, errorsOf(relief(12, Winding::inwards)).curved, 1e-4);
}

TEST(Curved, unsharedVerticesAreNoWorseThanInterpolation)
{
    Scene scene = relief(12);
    Mesh apart;
    for (std::uint32_t v : scene.meshes[0].indices) {
        apart.indices.push_back(std::uint32_t(apart.positions.size()));
        apart.positions.push_back(scene.meshes[0].positions[v]);
        apart.normals.push_back(scene.meshes[0].normals[v]);
    }
    scene.meshes[0] = apart;
    const Errors errors = errorsOf(scene);
    EXPECT_LT(errors.curved, errors.interpolated);
}

TEST(Curved, flatFacesStayFlat)
{
    Scene scene = relief(6);
    Mesh flat;
    const Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                        c = mesh.positions[mesh.indices[i + 2]];
        for (const glm::vec3& p : {a, b, c}) {
            flat.indices.push_back(std::uint32_t(flat.positions.size()));
            flat.positions.push_back(p);
            flat.normals.push_back(glm::normalize(glm::cross(b - a, c - a)));
        }
    }
    scene.meshes[0] = flat;
    auto surface = HighSurface::make({scene}, 1);
    ASSERT_TRUE(surface);
    surface->curve(1);
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const Hit hit =
            surface->trace({{float(random.range(0.1, 0.9)), float(random.range(0.1, 0.9)), 1}, {0, 0, -1}, 0, 10});
        ASSERT_TRUE(hit.found);
        // Positions of a face lie in its plane except for rounding, 6e-8, over edges of 1/6: 2e-5 degrees.
        EXPECT_LT(
            degrees(glm::dvec3(surface->normalOf(hit, HighNormals::curved, {0, 0, -1})), glm::dvec3(hit.faceNormal)),
            1e-3);
    }
}

TEST(Curved, shapeOperatorsAreTheSecondDerivativesOfAQuadric)
{
    // z = a x^2 / 2 + b x y + c y^2 / 2 around the first vertex, with seven neighbours in an uneven ring.
    const double a = 0.7, b = -0.3, c = 0.2;
    std::vector<glm::vec3> positions, normals;
    const auto add = [&](double x, double y) {
        positions.emplace_back(x, y, a * x * x / 2 + b * x * y + c * y * y / 2);
        normals.emplace_back(glm::normalize(glm::dvec3(-a * x - b * y, -b * x - c * y, 1)));
    };
    add(0, 0);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 7; ++i) {
        const double angle = 0.9 * i, radius = 0.1 + 0.02 * (i % 3);
        add(radius * std::cos(angle), radius * std::sin(angle));
        indices.insert(indices.end(), {0, i + 1, (i + 1) % 7 + 1});
    }
    const std::array<double, 6> expected{-a, -b, 0, -c, 0, 0}; // dn = -H dp
    const auto expectFirst = [&](const char* what) {
        const auto shapes = shapeOperators(positions, normals, indices, 1);
        ASSERT_EQ(shapes.size(), positions.size());
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_NEAR(shapes[0][k], expected[k], 2e-4) << what << " " << k; // float positions over 0.1
    };
    expectFirst("quadric");
    positions.emplace_back(0.05f, 0.05f, 0.08f); // ignored: its normal is tilted by 85 degrees
    normals.push_back(glm::normalize(glm::vec3(1, 0, 0.08f)));
    positions.push_back(positions[0]); // at the vertex itself
    normals.push_back(glm::normalize(glm::vec3(1, 1, 1)));
    positions.emplace_back(5, 5, 5); // in no triangle
    normals.emplace_back(0, 0, 1);
    indices.insert(indices.end(), {0, 8, 9});
    expectFirst("and two that do not count");
    EXPECT_EQ(shapeOperators(positions, normals, indices, 1).back(), ShapeOperator{});
    normals[0] = {0, 0, 0}; // unknown
    EXPECT_EQ(shapeOperators(positions, normals, indices, 1)[0], ShapeOperator{});
}

TEST(Curved, onlyNearlyFlatTrianglesNotSeenEdgeOnHaveCurvedNormals)
{
    const auto leaning = [](float cosine) { return glm::vec3(std::sqrt(1 - cosine * cosine), 0, cosine); };
    const glm::vec3 up(0, 0, 1);
    const CurvedTriangle flat{{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}, {up, up, up}, {}};
    for (const float side : {1.0f, -1.0f}) { // along or against the ray, of any length
        EXPECT_EQ(curvedNormal(flat, 0.2f, 0.3f, side * leaning(0.052f)), up);
        EXPECT_EQ(curvedNormal(flat, 0.2f, 0.3f, side * leaning(0.048f)), glm::vec3(0));
        EXPECT_EQ(curvedNormal(flat, 0.2f, 0.3f, side * 7 * leaning(0.052f)), up);
        EXPECT_EQ(curvedNormal(flat, 0.2f, 0.3f, side * 7 * leaning(0.048f)), glm::vec3(0));
    }
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (const auto& [cosine, curved] : {std::pair(0.11f, true), {0.09f, false}}) {
            CurvedTriangle t = flat;
            t.normals[corner] = leaning(cosine);
            EXPECT_EQ(glm::length(curvedNormal(t, 0.2f, 0.3f, -up)) > 0.99f, curved) << corner << " " << cosine;
        }
    CurvedTriangle line = flat;
    line.positions[2] = {2, 0, 0};
    EXPECT_EQ(curvedNormal(line, 0.2f, 0.3f, -up), glm::vec3(0));
    CurvedTriangle steep = flat; // far above its plane: an oblique ray meets it beyond the triangle
    for (ShapeOperator& w : steep.shapes)
        w = {-100, 0, 0, -100, 0, 0};
    EXPECT_EQ(curvedNormal(steep, 0.3f, 0.3f, leaning(0.7f)), glm::vec3(0));
}

TEST(Curved, grazingRaysAndUnpreparedSurfacesGiveInterpolatedNormals)
{
    auto surface = HighSurface::make({relief(8)}, 1);
    ASSERT_TRUE(surface);
    const Hit hit = surface->trace({{0.4f, 0.6f, 1}, {0, 0, -1}, 0, 10});
    ASSERT_TRUE(hit.found);
    const glm::vec3 interpolated = surface->normalOf(hit, HighNormals::smooth, {0, 0, -1});
    EXPECT_EQ(surface->normalOf(hit, HighNormals::curved, {0, 0, -1}), interpolated);
    surface->curve(1);
    EXPECT_NE(surface->normalOf(hit, HighNormals::curved, {0, 0, -1}), interpolated);
    const glm::vec3 along = glm::normalize(glm::cross(hit.faceNormal, glm::vec3(0, 1, 0)));
    EXPECT_EQ(surface->normalOf(hit, HighNormals::curved, along), interpolated);
}

} // namespace
} // namespace cotan
