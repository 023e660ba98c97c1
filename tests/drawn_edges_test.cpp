// On which pixels the edges of a surface are drawn, in which colour, and what hides them.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cotan/inspect.hpp"
#include "cotan/scene.hpp"

namespace cotan {
namespace {

// 16 x 12 pixels, each one unit wide on the plane z = 0, ten units from the eye; the origin is in the middle.
struct EdgeImage {
    Image image = makeImage(16, 12, PixelType::unorm8), depth = makeImage(16, 12, PixelType::float32);
    Camera camera;

    EdgeImage()
    {
        camera.eye = {0, 0, 10};
        camera.target = {0, 0, 0};
        camera.orthographic = true;
        camera.verticalExtent = 12;
        for (std::size_t i = 0; i < image.pixelCount(); ++i) {
            for (int c = 0; c < 3; ++c)
                image.bytes8()[4 * i + std::size_t(c)] = 200;
            setDepth(i, 10);
        }
    }
    void setDepth(std::size_t pixel, float away)
    {
        depth.floats()[4 * pixel] = away;
        depth.floats()[4 * pixel + 3] = 1;
    }
    glm::ivec4 at(int x, int y) const
    {
        const std::uint8_t* p = image.bytes8() + 4 * (16 * y + x);
        return {p[0], p[1], p[2], p[3]};
    }
    // The pixels that changed, as column and row.
    std::set<std::pair<int, int>> draw(const SurfaceEdge& edge, EdgesShown shown = {false, true})
    {
        drawEdges(image, depth, camera, std::span(&edge, 1), shown);
        std::set<std::pair<int, int>> drawn;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 16; ++x)
                if (at(x, y) != glm::ivec4(200, 200, 200, 0))
                    drawn.insert({x, y});
        return drawn;
    }
};

std::set<std::pair<int, int>> rowOfPixels(int first, int last, int y)
{
    std::set<std::pair<int, int>> all;
    for (int x = first; x <= last; ++x)
        all.insert({x, y});
    return all;
}

const SurfaceEdge kLevel{{-5.4f, 2.4f, 0}, {4.6f, 2.4f, 0}, EdgeKind::seam};

TEST(DrawnEdges, areOnePixelWideFromEndToEnd)
{
    EXPECT_EQ(EdgeImage().draw(kLevel), rowOfPixels(2, 12, 3));
    EXPECT_EQ(EdgeImage().draw({kLevel.b, kLevel.a, EdgeKind::seam}), rowOfPixels(2, 12, 3));
    EXPECT_EQ(EdgeImage().draw({{-30, -4.5f, 0}, {30, -4.5f, 0}, EdgeKind::seam}), rowOfPixels(0, 15, 10));
    EXPECT_EQ(EdgeImage().draw({{-30, 1.5f, 0}, {-6.5f, 1.5f, 0}, EdgeKind::seam}), rowOfPixels(0, 1, 4));
    std::set<std::pair<int, int>> column, diagonal;
    for (int y = 0; y < 12; ++y)
        column.insert({13, y});
    for (int k = 0; k < 7; ++k)
        diagonal.insert({4 + k, 9 - k});
    EXPECT_EQ(EdgeImage().draw({{5.5f, -60, 0}, {5.5f, 60, 0}, EdgeKind::seam}), column);
    EXPECT_EQ(EdgeImage().draw({{-3.5f, -3.5f, 0}, {2.5f, 2.5f, 0}, EdgeKind::seam}), diagonal);
    for (const SurfaceEdge& outside : {SurfaceEdge{{-30, 7, 0}, {30, 7, 0}, EdgeKind::seam},
                                       {{-30, -6.1f, 0}, {30, -6.1f, 0}, EdgeKind::seam},
                                       {{8.1f, -30, 0}, {8.1f, 30, 0}, EdgeKind::seam},
                                       {{-8.1f, -30, 0}, {-8.1f, 30, 0}, EdgeKind::seam},
                                       {{-20, 0, 0}, {0, 20, 0}, EdgeKind::seam}}) // beyond the corner
        EXPECT_TRUE(EdgeImage().draw(outside).empty()) << outside.a.x << " " << outside.a.y;
}

TEST(DrawnEdges, haveTheColourOfTheirKindWithSeamsOverTriangleEdges)
{
    const glm::ivec4 grey(92, 92, 94, 255); // 0.6 of the way from 200 to (20, 20, 24)
    const glm::ivec4 plain(200, 200, 200, 0);
    struct Row {
        EdgeKind kind;
        glm::ivec4 seam;
    };
    for (const Row& row : {Row{EdgeKind::inner, plain},
                           {EdgeKind::seam, {255, 215, 40, 255}},
                           {EdgeKind::mirroredSeam, {255, 60, 220, 255}},
                           {EdgeKind::border, {60, 220, 255, 255}}}) {
        SurfaceEdge edge = kLevel;
        edge.kind = row.kind;
        EdgeImage none, triangles, seams, both;
        EXPECT_TRUE(none.draw(edge, {false, false}).empty());
        triangles.draw(edge, {true, false});
        seams.draw(edge, {false, true});
        both.draw(edge, {true, true});
        EXPECT_EQ(triangles.at(7, 3), grey) << int(row.kind);
        EXPECT_EQ(seams.at(7, 3), row.seam) << int(row.kind);
        EXPECT_EQ(both.at(7, 3), row.kind == EdgeKind::inner ? grey : row.seam) << int(row.kind);
        EXPECT_EQ(both.at(7, 4), plain);
    }
    EdgeImage other; // sizes differ
    other.depth = makeImage(16, 11, PixelType::float32);
    EXPECT_TRUE(other.draw(kLevel).empty());
    other.depth = makeImage(15, 12, PixelType::float32);
    EXPECT_TRUE(other.draw(kLevel).empty());
}

// The tolerance is three thousandths of the depth: a drawn surface is as far away as its edges, except for rounding.
TEST(DrawnEdges, areHiddenIfThePixelAndAllNeighboursAreNearer)
{
    const auto at = [](float z) { // `z` towards the eye
        return SurfaceEdge{{-5.4f, 2.4f, z}, {4.6f, 2.4f, z}, EdgeKind::seam};
    };
    EXPECT_EQ(EdgeImage().draw(at(1)).size(), 11u);
    EXPECT_EQ(EdgeImage().draw(at(-0.029f)).size(), 11u);
    EXPECT_EQ(EdgeImage().draw(at(-0.031f)).size(), 0u);
    using Pixels = std::set<std::pair<int, int>>;
    EdgeImage deeper; // only the pixel above (7, 4) in its column
    deeper.setDepth(16 * 4 + 7, 50);
    EXPECT_EQ(deeper.draw(at(-1)), (Pixels{{7, 3}}));
    EdgeImage above;
    above.setDepth(16 * 2 + 7, 50);
    EXPECT_EQ(above.draw(at(-1)), (Pixels{{7, 3}}));
    EdgeImage within;
    within.setDepth(16 * 3 + 7, 50);
    EXPECT_EQ(within.draw(at(-1)), (Pixels{{6, 3}, {7, 3}, {8, 3}}));
    EdgeImage diagonal;
    diagonal.setDepth(16 * 4 + 30, 50); // neither a corner nor the next row is a neighbour
    EXPECT_TRUE(diagonal.draw(at(-1)).empty());
    EdgeImage nothing; // no surface there
    nothing.depth.floats()[4 * (16 * 3 + 7) + 3] = 0;
    EXPECT_EQ(nothing.draw(at(-1000)), (Pixels{{6, 3}, {7, 3}, {8, 3}}));
}

// The lens sees half its distance to each side.
TEST(DrawnEdges, areClippedBehindThePerspectiveCamera)
{
    const auto drawn = [](glm::vec3 a, glm::vec3 b) {
        EdgeImage image;
        image.camera.orthographic = false;
        image.camera.verticalFieldOfView = 2 * std::atan(0.5f); // 1.2 pixels per unit in the plane
        return image.draw({a, b, EdgeKind::seam});
    };
    EXPECT_EQ(drawn({-4.9f, 0.4f, 0}, {2.6f, 0.4f, 0}), rowOfPixels(2, 11, 5)); // from 8 - 5.88 to 8 + 3.12
    EXPECT_EQ(drawn({-4.9f, 0.2f, 5}, {2.6f, 0.2f, 5}), rowOfPixels(0, 14, 5)); // twice as large
    std::set<std::pair<int, int>> down;
    for (int y = 8; y < 12; ++y)
        down.insert({8, y}); // from 6 + 2.4 to the lower border
    EXPECT_EQ(drawn({0.1f, -2, 0}, {0.1f, -2, 30}), down);
    EXPECT_EQ(drawn({0.1f, -2, 30}, {0.1f, -2, 0}), down);
    EXPECT_TRUE(drawn({0.1f, -2, 11}, {0.1f, -2, 30}).empty());
    EXPECT_TRUE(drawn({-4.9f, 0.4f, 20}, {2.6f, 0.4f, 20}).empty());
}

// If three triangles share an edge, the first two count. Every instance of a mesh has its own edges.
TEST(DrawnEdges, followInstancesAndOccurOnce)
{
    Scene scene;
    scene.materials.resize(1);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {-0.0f, 0, 0}};
    mesh.normals.assign(6, {0, 0, 1});
    mesh.indices = {0, 1, 2, 1, 3, 2, 5, 4, 1, 2, 2, 3}; // the third shares 0 1 through another vertex with a -0
    scene.meshes = {mesh};
    glm::mat4 moved(1);
    moved[3] = {10, 20, 30, 1};
    scene.instances = {{"", 0, glm::mat4(1)}, {"", 0, moved}};
    const std::vector<SurfaceEdge> edges = surfaceEdges(scene);
    ASSERT_EQ(edges.size(), 2 * 7u); // the fourth triangle has no area and adds no edge
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(edges[7 + i].a, edges[i].a + glm::vec3(10, 20, 30)) << i;
        EXPECT_EQ(edges[7 + i].b, edges[i].b + glm::vec3(10, 20, 30)) << i;
        const bool shared = edges[i].a.z == 0 && edges[i].b.z == 0
            && (edges[i].a + edges[i].b == glm::vec3(1, 1, 0) || edges[i].a + edges[i].b == glm::vec3(1, 0, 0));
        // The edge 2 3 belongs to the second triangle and, in both directions, to the fourth.
        const bool twice = edges[i].a + edges[i].b == glm::vec3(1, 2, 0);
        EXPECT_EQ(edges[i].kind != EdgeKind::border, shared || twice) << i;
    }
}

} // namespace
} // namespace cotan
