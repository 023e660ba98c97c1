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
            EXPECT_NE(image.error().message.find("1048576 translucent fragments"), std::string::npos);
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
