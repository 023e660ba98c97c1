// Translucent layers and the shadows of casters, as the reference renderer draws them.
#include "covering_scenes.hpp"
#include "reference_scene.hpp"

namespace cotan {
namespace {

Image draw(const Scene& scene, const View& view) { return testing::rendered(scene, view); }

TEST(ReferenceLayers, manyPanesComposeInTheOrderOfDistance)
{
    for (const int count : {2, 11, 64})
        layers::manyPanesComposeInTheOrderOfDistance(draw, count);
}

TEST(ReferenceLayers, texelsOfAlphaOneHideWhatIsBehind) { layers::texelsOfAlphaOneHideWhatIsBehind(draw); }

TEST(ReferenceLayers, crossingPanesChangeTheirOrderInsideAPixel)
{
    layers::crossingPanesChangeTheirOrderInsideAPixel(draw);
}

TEST(ReferenceLayers, opaqueSurfacesHideLayersBehindThem) { layers::opaqueSurfacesHideLayersBehindThem(draw); }

TEST(ReferenceLayers, layersCoverTheirOwnSamplesOnly) { layers::layersCoverTheirOwnSamplesOnly(draw); }

TEST(ReferenceLayers, ofEquallyFarLayersTheLaterIsInFront) { layers::ofEquallyFarLayersTheLaterIsInFront(draw); }

TEST(ReferenceLayers, perspectiveAndRowsUpwardKeepTheOrder) { layers::perspectiveAndRowsUpwardKeepTheOrder(draw); }

TEST(ReferenceLayers, dataOutputsShowTheNearestLayer) { layers::dataOutputsShowTheNearestLayer(draw); }

TEST(ReferenceLayers, transmissiveLayersTintWhatIsBehind) { layers::transmissiveLayersTintWhatIsBehind(draw); }

TEST(ReferenceLayers, masksCoverTheSamplesOnTheirSide) { layers::masksCoverTheSamplesOnTheirSide(draw); }

TEST(ReferenceLayers, castersShadowWhereTheirMaterialStands) { layers::castersShadowWhereTheirMaterialStands(draw); }

// Nearest first, each sample is written once. Farthest first, most of what is drawn is hidden later: after a while it
// is looked at what comes, and not shaded.
TEST(ReferenceLayers, opaqueSurfacesLookTheSameInAnyOrder)
{
    const auto drawnBy = [](bool nearestFirst) {
        Scene scene;
        Mesh mesh;
        for (int k = 0; k < 40; ++k) {
            const int i = nearestFirst ? 39 - k : k; // the higher, the nearer
            layers::Pane pane;
            pane.corner = {-20.0f + 0.37f * float(i % 7), 10.0f - 0.21f * float(i % 11), 0.5f * float(i)};
            pane.alongU = {40.0f - 0.9f * float(i), 0, 0.3f}; // leans
            pane.alongV = {0.2f * float(i % 5), -20.0f + 0.4f * float(i), 0};
            pane.color = layers::colorOf(i);
            layers::append(mesh, pane);
        }
        layers::addMesh(scene, mesh, layers::addMaterial(scene, AlphaMode::opaque));
        layers::Pane holes; // of a mask that is nowhere: before all, and hides nothing
        holes.corner.z = 30;
        holes.color.w = 0.2f;
        layers::addPane(scene, holes, AlphaMode::mask);
        layers::Pane glass; // behind some, before others
        glass.corner.z = 10.2f;
        glass.color.w = 0.5f;
        layers::addPane(scene, glass);
        return draw(scene, layers::flatView());
    };
    const Image nearestFirst = drawnBy(true), farthestFirst = drawnBy(false);
    EXPECT_EQ(nearestFirst.data, farthestFirst.data);
    EXPECT_NE(layers::at(nearestFirst, 32, 16), layers::at(nearestFirst, 13, 7)) << "several panes are seen";
}

TEST(ReferenceLayers, over1024LayersInAWholeTileAreRefused)
{
    layers::Pane pane;
    pane.color.w = 0.01f;
    View view = layers::flatView(1);
    view.width = view.height = 32;
    view.camera.verticalExtent = 16; // the pane fills the picture
    for (const int count : {1024, 1025}) {
        Mesh mesh;
        for (int i = 0; i < count; ++i)
            layers::append(mesh, pane);
        Scene scene;
        layers::addMesh(scene, mesh, layers::addMaterial(scene, AlphaMode::blend));
        const Result<Image> image = renderReference(scene, view);
        EXPECT_EQ(bool(image), count == 1024);
        if (!image) {
            EXPECT_EQ(image.error().kind, ErrorKind::unavailable);
            EXPECT_EQ(image.error().message,
                      "reference renderer: more than 1048576 translucent fragments in a tile of 32x32 pixels");
        }
    }
}

TEST(ReferenceLayers, tooManyTrianglesAreRefusedBeforeAnythingIsMade)
{
    Scene scene = testing::sceneOf(Mesh{});
    scene.meshes[0].indices.resize(3 * 200'000);
    scene.instances.resize(501);
    const Result<Image> image = renderReference(scene, View{});
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().kind, ErrorKind::input);
    EXPECT_EQ(image.error().message, "scene: 501 instances draw 100200000 triangles: expected at most 100000000");
}

} // namespace
} // namespace cotan
