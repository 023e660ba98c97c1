// Translucent layers and the shadows of casters in the reference renderer.
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

TEST(ReferenceLayers, opaqueTexelsHideLayersBehindThem) { layers::opaqueTexelsHideLayersBehindThem(draw); }

TEST(ReferenceLayers, crossingPanesChangeTheirOrderInsideAPixel)
{
    layers::crossingPanesChangeTheirOrderInsideAPixel(draw);
}

TEST(ReferenceLayers, opaqueSurfacesHideLayersBehindThem) { layers::opaqueSurfacesHideLayersBehindThem(draw); }

TEST(ReferenceLayers, layersCoverTheirOwnSamplesOnly) { layers::layersCoverTheirOwnSamplesOnly(draw); }

TEST(ReferenceLayers, laterOfEquallyFarLayersIsInFront) { layers::laterOfEquallyFarLayersIsInFront(draw); }

TEST(ReferenceLayers, perspectiveAndRowsUpwardKeepTheOrder) { layers::perspectiveAndRowsUpwardKeepTheOrder(draw); }

TEST(ReferenceLayers, dataOutputsShowTheNearestLayer) { layers::dataOutputsShowTheNearestLayer(draw); }

TEST(ReferenceLayers, transmissiveLayersTintLayersBehindThem) { layers::transmissiveLayersTintLayersBehindThem(draw); }

TEST(ReferenceLayers, masksCoverTheSamplesOnTheirSide) { layers::masksCoverTheSamplesOnTheirSide(draw); }

TEST(ReferenceLayers, castersShadowByTheirMaterial) { layers::castersShadowByTheirMaterial(draw); }

// Nearest first, each sample is shaded once. Farthest first, most shaded samples are hidden later, so the renderer
// switches to determining visibility before it shades.
TEST(ReferenceLayers, opaqueSurfacesLookTheSameInAnyOrder)
{
    const auto drawnBy = [](bool nearestFirst) {
        Scene scene;
        Mesh mesh;
        for (int k = 0; k < 40; ++k) {
            const int i = nearestFirst ? 39 - k : k; // larger i is nearer
            layers::Pane pane;
            pane.corner = {-20.0f + 0.37f * float(i % 7), 10.0f - 0.21f * float(i % 11), 0.5f * float(i)};
            pane.alongU = {40.0f - 0.9f * float(i), 0, 0.3f}; // tilted
            pane.alongV = {0.2f * float(i % 5), -20.0f + 0.4f * float(i), 0};
            pane.color = layers::colorOf(i);
            layers::append(mesh, pane);
        }
        layers::addMesh(scene, mesh, layers::addMaterial(scene, AlphaMode::opaque));
        layers::Pane holes; // a mask without any opaque texel: in front of everything, hides nothing
        holes.corner.z = 30;
        holes.color.w = 0.2f;
        layers::addPane(scene, holes, AlphaMode::mask);
        layers::Pane glass; // behind some panes, in front of others
        glass.corner.z = 10.2f;
        glass.color.w = 0.5f;
        layers::addPane(scene, glass);
        return draw(scene, layers::flatView());
    };
    const Image nearestFirst = drawnBy(true), farthestFirst = drawnBy(false);
    EXPECT_EQ(nearestFirst.data, farthestFirst.data);
    EXPECT_NE(layers::at(nearestFirst, 32, 16), layers::at(nearestFirst, 13, 7)) << "several panes are seen";
}

TEST(ReferenceLayers, tooManyFragmentsInATileAreRefused)
{
    layers::Pane pane;
    pane.color.w = 0.01f;
    View view = layers::flatView(1);
    view.width = view.height = 32;
    view.camera.verticalExtent = 16; // the pane fills the image
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

TEST(ReferenceLayers, tooManyTrianglesAreRefusedBeforeAllocation)
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
