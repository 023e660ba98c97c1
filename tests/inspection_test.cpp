// Models drawn in diagnostic colours, and the values at one of their points.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "cotan/inspect.hpp"
#include "cotan/lint.hpp"
#include "cotan/model.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

// A unit square facing +z and the camera whose image it fills.
Scene square(float stretch, float shear, bool mirrored)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(makePatch(stretch, shear, mirrored, 1));
    scene.instances.push_back({"square", 0, glm::mat4(1)});
    return scene;
}

View straightOn()
{
    View view;
    view.width = view.height = 16;
    view.camera.eye = {0, 0, 5};
    view.camera.orthographic = true;
    view.camera.verticalExtent = 0.9f;
    return view;
}

glm::ivec3 middleOf(const Scene& scene, Inspection inspection, View view = straightOn())
{
    const auto image = drawView(inspected(scene, inspection), inspectionView(view), "reference");
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return {};
    }
    const std::uint8_t* p = image->bytes8() + 4 * (8 * 16 + 7);
    EXPECT_EQ(p[3], 255);
    return {p[0], p[1], p[2]};
}

// Tolerates the rounding of one code from sRGB to linear and back.
void expectColor(glm::ivec3 found, glm::ivec3 expected)
{
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], 1) << i << " of " << found.x << ' ' << found.y << ' ' << found.z;
}

TEST(Inspection, everyNameIsKnownAndNoOther)
{
    for (std::size_t i = 0; i < inspectionNames().size(); ++i)
        EXPECT_EQ(inspectionFromName(inspectionNames()[i]), Inspection(i));
    EXPECT_EQ(inspectionNames().back(), "mask");
    EXPECT_FALSE(inspectionFromName("shaded"));
}

// Colours of the scale: green means a stretch of 1.4 or a shear of 2 degrees, white the end of the scale.
TEST(Inspection, stretchAndShearAreColouredByTheirScale)
{
    expectColor(middleOf(square(1, 0, false), Inspection::stretch), {0, 0, 0});
    expectColor(middleOf(square(1.4f, 0, false), Inspection::stretch), {30, 180, 80});
    expectColor(middleOf(square(20, 0, false), Inspection::stretch), {255, 255, 255});
    expectColor(middleOf(square(1, 0, false), Inspection::shear), {0, 0, 0});
    expectColor(middleOf(square(1, 1, false), Inspection::shear), {255, 255, 255}); // 45 degrees
}

TEST(Inspection, mirroredUvAndTangentWAreColoured)
{
    const glm::ivec3 plain = middleOf(square(1, 0, false), Inspection::mirrored),
                     mirrored = middleOf(square(1, 0, true), Inspection::mirrored);
    EXPECT_GT(plain.z, plain.x);       // blue
    EXPECT_GT(mirrored.x, mirrored.z); // orange
    Scene scene = square(1, 0, false);
    const glm::ivec3 none = middleOf(scene, Inspection::w);
    EXPECT_EQ(none.x, none.z);
    scene.meshes[0].tangents.assign(scene.meshes[0].vertexCount(), {1, 0, 0, -1});
    EXPECT_EQ(middleOf(scene, Inspection::w), mirrored);
}

TEST(Inspection, stretchIsThatOfTheFirstInstance)
{
    Scene scene = square(1, 0, false);
    const glm::mat4 wide = glm::scale(glm::translate(glm::mat4(1), glm::vec3(10, 0, 0)), glm::vec3(20, 1, 1));
    scene.instances.push_back({"wide", 0, wide}); // outside the image
    expectColor(middleOf(scene, Inspection::stretch), {0, 0, 0});
    std::swap(scene.instances[0], scene.instances[1]);
    expectColor(middleOf(scene, Inspection::stretch), {255, 255, 255});
}

TEST(Inspection, uvWithoutAreaHaveNoMirroring)
{
    Scene scene = square(1, 0, true);
    const glm::ivec3 without = middleOf(square(1, 0, true), Inspection::w); // grey: the mesh has no tangents
    scene.meshes[0].texcoords[0].assign(scene.meshes[0].vertexCount(), {0.25f, 0.5f});
    EXPECT_EQ(middleOf(scene, Inspection::mirrored), without);
    scene.meshes[0].texcoords[0].clear();
    EXPECT_EQ(middleOf(scene, Inspection::mirrored), without);
}

// An `up` along the view direction is unusable: y replaces it, as in the renderer.
TEST(Inspection, cameraWithoutUpPicksThePointItDraws)
{
    Scene scene = square(1, 0, false);
    View view = straightOn();
    const auto upright = pick(scene, view.camera, {16, 16}, {3, 4});
    view.camera.up = {0, 0, 1};
    const auto without = pick(scene, view.camera, {16, 16}, {3, 4});
    ASSERT_TRUE(upright && without);
    EXPECT_EQ(upright->triangle, without->triangle);
    EXPECT_EQ(upright->barycentric, without->barycentric);
}

TEST(Inspection, backFacesHaveAnotherColour)
{
    const Scene scene = square(1, 0, false);
    const glm::ivec3 front = middleOf(scene, Inspection::facing);
    View behind = straightOn();
    behind.camera.eye = {0, 0, -5};
    const glm::ivec3 back = middleOf(scene, Inspection::facing, behind);
    EXPECT_GT(front.z, front.x);
    EXPECT_GT(back.x, back.z);
}

TEST(Inspection, mapsAreShownWithUnchangedCodes)
{
    Scene scene = square(1, 0, false);
    Image image = makeImage(1, 1, PixelType::unorm8);
    const std::uint8_t codes[] = {40, 90, 200, 120};
    std::copy_n(codes, 4, image.bytes8());
    scene.images.push_back(image);
    scene.materials[0].normalMap.image = 0;
    scene.materials[0].metallicRoughnessMap.image = 0;
    scene.materials[0].roughness = 1;
    expectColor(middleOf(scene, Inspection::normalMap), {40, 90, 200});
    expectColor(middleOf(scene, Inspection::normalMapGreen), {90, 90, 90});
    expectColor(middleOf(scene, Inspection::roughness), {90, 90, 90});
    expectColor(middleOf(scene, Inspection::metallic), {200, 200, 200});
    expectColor(middleOf(scene, Inspection::baseColor), {255, 255, 255});
    scene.materials[0].normalMap.image = -1;
    expectColor(middleOf(scene, Inspection::normalMap), {128, 128, 255});
}

TEST(Inspection, densityIsRelativeToTheMedian)
{
    Scene scene = square(1, 0, false);
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes.push_back(scene.meshes[0]);
    for (glm::vec2& uv : scene.meshes[0].texcoords[0])
        uv *= 4.0f; // the three meshes have 4, 1 and 1 times the texel density
    for (int i = 1; i < 3; ++i)
        scene.instances.push_back({"away", i, glm::translate(glm::mat4(1), glm::vec3(5 * i, 0, 0))});
    expectColor(middleOf(scene, Inspection::density), {220, 30, 20});
}

TEST(Probe, isEmptyByDefault)
{
    const viewer::Probed p;
    EXPECT_EQ(p.normal, glm::vec3(0));
    EXPECT_EQ(p.w, 0);
    EXPECT_FALSE(p.hasUv);
    EXPECT_EQ(p.texel, glm::ivec2(-1));
}

TEST(Probe, frameAtAPointFollowsTheGradients)
{
    const Scene scene = square(2, 0, false); // u changes half as fast as v
    const auto hit = pick(scene, straightOn().camera, {16, 16}, {8, 8});
    ASSERT_TRUE(hit);
    viewer::Prober prober;
    const viewer::Probed p = prober.at(scene, 1, *hit, Frame::orthonormal, TangentOrigin::stored);
    EXPECT_LT(glm::length(p.normal - glm::vec3(0, 0, 1)), 1e-6f);
    EXPECT_LT(glm::length(glm::normalize(p.t) - glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::length(glm::normalize(p.b) - glm::vec3(0, -1, 0)), 1e-6f); // v runs down
    EXPECT_EQ(p.w, 1);
    EXPECT_EQ(p.storedTangent, glm::vec3(0));
    EXPECT_TRUE(p.hasUv);
    EXPECT_EQ(p.texel, glm::ivec2(-1)); // there is no map
    const Scene mirrored = square(2, 0, true);
    EXPECT_EQ(prober.at(mirrored, 2, *hit, Frame::orthonormal, TangentOrigin::stored).w, -1);
}

TEST(Probe, texelIsInsideTheMapForAnyUv)
{
    Scene scene = square(1, 0, false);
    scene.images.push_back(makeImage(8, 4, PixelType::unorm8));
    scene.materials[0].normalMap.image = 0;
    for (glm::vec2& uv : scene.meshes[0].texcoords[0])
        uv = uv + glm::vec2(-3, 5);
    const auto hit = pick(scene, straightOn().camera, {16, 16}, {8.5f, 4.5f}); // right of the centre, a quarter down
    ASSERT_TRUE(hit);
    const viewer::Probed p = viewer::Prober().at(scene, 1, *hit, Frame::cotangent, TangentOrigin::stored);
    EXPECT_EQ(p.texel, glm::ivec2(4, 1));
}

TEST(ProblemAreas, cameraLooksAtTheWorstTriangleAlongItsNormal)
{
    Scene scene = square(1, 0, false);
    scene.meshes.push_back(makePatch(3, 0, false, 1));
    scene.instances.push_back({"stretched", 1, glm::translate(glm::mat4(1), glm::vec3(10, 0, 0))});
    const std::vector<ProblemArea> spots = problemAreas(scene);
    ASSERT_EQ(spots.size(), 1u);
    EXPECT_NE(spots[0].text.find("stretched by more than 1.2: 100.0 % of "), std::string::npos) << spots[0].text;
    EXPECT_TRUE(spots[0].text.ends_with(", here 3")) << spots[0].text;
    EXPECT_NEAR(spots[0].camera.target.x, 10, 0.5f);
    EXPECT_GT(spots[0].camera.eye.z, 1.6f); // an eighth of a model that is 13 wide, at 45 degrees
    const auto hit = pick(scene, spots[0].camera, {100, 100}, {50, 50});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mesh, 1);
}

TEST(ProblemAreas, cameraIsInFrontOfOccluders)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(makePatch(3, 0, false, 1));
    scene.meshes.push_back(makePatch(1, 0, false, 1));
    scene.instances.push_back({"stretched", 0, glm::mat4(1)});
    const glm::mat4 before = glm::translate(glm::mat4(1), glm::vec3(-3, -3, 4));
    scene.instances.push_back({"before it", 1, glm::scale(before, glm::vec3(9))});
    const std::vector<ProblemArea> spots = problemAreas(scene);
    ASSERT_EQ(spots.size(), 1u);
    const auto hit = pick(scene, spots[0].camera, {100, 100}, {50, 50});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mesh, 0);
    EXPECT_LT(spots[0].camera.eye.z, 4);
    EXPECT_EQ(spots[0].view, "stretch");
}

// The window lists what `lint` reports, with the same fractions.
TEST(ProblemAreas, fractionsEqualThoseOfLint)
{
    COTAN_NEEDS_DATA("animated/lumberjack.glb");
    const Scene scene = *loadScene(test::dataFile("animated/lumberjack.glb"));
    const PrimitiveLint lint = lintScene(scene).primitives.at(0);
    std::map<std::string, double> fractions;
    for (const ProblemArea& spot : problemAreas(scene))
        for (const char* words : {"without area", "stretched", "sheared", "w contradicts the uv", "rotated"})
            if (spot.text.find(words) != std::string::npos)
                fractions[words] = spot.share;
    EXPECT_NEAR(fractions["stretched"], lint.uv.stretched, 1e-12);
    EXPECT_NEAR(fractions["sheared"], lint.uv.sheared, 1e-12);
    // Reversed green compensates w at most corners, so the problem area counts the remaining ones.
    ASSERT_TRUE(scene.materials[std::size_t(scene.meshes[0].material)].greenReversed);
    EXPECT_NEAR(fractions["w contradicts the uv"], 1 - lint.stored.reversedW, 1e-12);
    EXPECT_NEAR(fractions["rotated"], lint.stored.rotated, 1e-12);
    EXPECT_EQ(fractions.contains("without area"), lint.uv.degenerate >= 0.001);
}

TEST(ProblemAreas, aStoredTangentOnTheWrongSideIsFound)
{
    Scene scene = square(1, 0, false);
    scene.meshes[0].tangents.assign(scene.meshes[0].vertexCount(), {1, 0, 0, 1});
    EXPECT_TRUE(problemAreas(scene).empty());
    for (glm::vec4& tangent : scene.meshes[0].tangents)
        tangent.w = -1;
    ASSERT_EQ(problemAreas(scene).size(), 1u);
    EXPECT_NE(problemAreas(scene)[0].text.find("w contradicts the uv: 100.0 %"), std::string::npos);
}

} // namespace
} // namespace cotan

namespace cotan {
namespace {

// Two triangles that share an edge but no vertices; uv of the second are moved, or mirrored at the edge.
Scene twoTriangles(float moved, bool mirrored)
{
    Scene scene;
    scene.materials.emplace_back();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    mesh.normals.assign(6, {0, 0, 1});
    for (const glm::vec3& p : mesh.positions)
        mesh.texcoords[0].push_back({p.x, 1 - p.y});
    for (std::size_t i = 3; i < 6; ++i)
        mesh.texcoords[0][i].x += moved;
    if (mirrored)
        mesh.texcoords[0][5] = {0, 1};
    mesh.indices = {0, 1, 2, 3, 4, 5};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"two", 0, glm::mat4(1)});
    return scene;
}

EdgeKind sharedEdgeOf(const Scene& scene)
{
    const std::vector<SurfaceEdge> edges = surfaceEdges(scene);
    EXPECT_EQ(edges.size(), 5u);
    int borders = 0;
    EdgeKind found = EdgeKind::border;
    for (const SurfaceEdge& edge : edges) {
        borders += edge.kind == EdgeKind::border;
        if (edge.kind != EdgeKind::border)
            found = edge.kind;
    }
    EXPECT_EQ(borders, 4);
    return found;
}

TEST(Edges, areInnerSeamsOrMirroredSeams)
{
    EXPECT_EQ(sharedEdgeOf(twoTriangles(0, false)), EdgeKind::inner);
    EXPECT_EQ(sharedEdgeOf(twoTriangles(0.25f, false)), EdgeKind::seam);
    EXPECT_EQ(sharedEdgeOf(twoTriangles(0, true)), EdgeKind::mirroredSeam);
}

// 64 by 64 pixels, 50 per unit, looking straight at a point of the plane z = 0.
View straightAt(float x, float y)
{
    View view;
    view.width = view.height = 64;
    view.camera.orthographic = true;
    view.camera.verticalExtent = 1.28f;
    view.camera.eye = {x, y, 5};
    view.camera.target = {x, y, 0};
    return view;
}

// Number of pixels in each column that the seams and borders of `edges` cover in a view of the scene.
std::vector<int> seamsByColumn(const Scene& scene, View view, const std::vector<SurfaceEdge>& edges)
{
    view.output = Output::depth;
    const auto depth = drawView(scene, view, "reference");
    EXPECT_TRUE(depth) << depth.error().message;
    Image image = makeImage(view.width, view.height, PixelType::unorm8);
    drawEdges(image, *depth, view.camera, edges, {false, true});
    std::vector<int> cyan(std::size_t(view.width));
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        cyan[i % cyan.size()] += image.bytes8()[4 * i + 2] == 255;
    return cyan;
}

TEST(Edges, areDrawnInPositionAndHiddenBehindSurfaces)
{
    Scene scene = twoTriangles(0, false);
    const auto seen = [&] {
        const auto columns = seamsByColumn(scene, straightAt(0.5f, 0.5f), surfaceEdges(twoTriangles(0, false)));
        return std::accumulate(columns.begin(), columns.end(), 0);
    };
    EXPECT_NEAR(seen(), 200, 8);             // four sides of 50 pixels
    scene.meshes.push_back(scene.meshes[0]); // an occluder: the same mesh, nearer and larger
    scene.instances.push_back({"before", 1, glm::scale(glm::translate(glm::mat4(1), {-1, -1, 1}), {8, 8, 1})});
    EXPECT_LE(seen(), 4);
}

TEST(Edges, longEdgesAreDrawnWithoutGaps)
{
    Scene scene = twoTriangles(0, false);
    for (glm::vec3& p : scene.meshes[0].positions)
        p = (p - 0.5f) * 4000.0f + glm::vec3(0, 2000, 2000); // only one of its sides crosses the image, along x
    const std::vector<int> columns = seamsByColumn(scene, straightAt(0.01f, 0.01f), surfaceEdges(scene));
    for (std::size_t x = 0; x < columns.size(); ++x)
        EXPECT_GE(columns[x], 1) << x;
}

} // namespace
} // namespace cotan
