// Translucent layers and the shadows of casters on the device.
#include "covering_scenes.hpp"
#include "render_scene.hpp"

namespace cotan {

using namespace rendertest;

namespace {

// One device for all tests, with the validation layer if it is installed; any of its messages fails the test.
class RenderLayers : public ::testing::Test {
protected:
    static void SetUpTestSuite()
    {
        auto opened = openVulkanRenderer("", /*validation*/ true);
        if (opened)
            renderer = std::move(*opened);
        else
            reason = opened.error().message;
    }
    static void TearDownTestSuite() { renderer.reset(); }

    void SetUp() override
    {
        if (!renderer)
            GTEST_SKIP() << reason;
        said = renderer->messages().size();
    }
    void TearDown() override
    {
        for (std::size_t i = said; renderer && i < renderer->messages().size(); ++i)
            ADD_FAILURE() << renderer->messages()[i];
    }

    static Image draw(const Scene& scene, const View& view)
    {
        load(*renderer, scene);
        return drawn(*renderer, view);
    }

    static inline std::unique_ptr<Renderer> renderer;
    static inline std::string reason;
    std::size_t said = 0;
};

TEST_F(RenderLayers, manyPanesComposeInTheOrderOfDistance)
{
    for (const int count : {2, 11, 64})
        layers::manyPanesComposeInTheOrderOfDistance(draw, count);
}

TEST_F(RenderLayers, opaqueTexelsHideLayersBehindThem) { layers::opaqueTexelsHideLayersBehindThem(draw); }

TEST_F(RenderLayers, crossingPanesChangeTheirOrderInsideAPixel)
{
    layers::crossingPanesChangeTheirOrderInsideAPixel(draw);
}

TEST_F(RenderLayers, opaqueSurfacesHideLayersBehindThem) { layers::opaqueSurfacesHideLayersBehindThem(draw); }

TEST_F(RenderLayers, layersCoverTheirOwnSamplesOnly) { layers::layersCoverTheirOwnSamplesOnly(draw); }

TEST_F(RenderLayers, laterOfEquallyFarLayersIsInFront) { layers::laterOfEquallyFarLayersIsInFront(draw); }

TEST_F(RenderLayers, perspectiveAndRowsUpwardKeepTheOrder) { layers::perspectiveAndRowsUpwardKeepTheOrder(draw); }

TEST_F(RenderLayers, dataOutputsShowTheNearestLayer) { layers::dataOutputsShowTheNearestLayer(draw); }

TEST_F(RenderLayers, transmissiveLayersTintLayersBehindThem) { layers::transmissiveLayersTintLayersBehindThem(draw); }

TEST_F(RenderLayers, masksCoverTheSamplesOnTheirSide) { layers::masksCoverTheSamplesOnTheirSide(draw); }

TEST_F(RenderLayers, castersShadowByTheirMaterial) { layers::castersShadowByTheirMaterial(draw); }

// The lists hold 2.8 million layers: these panes make 3.5 million and are drawn in bands.
TEST_F(RenderLayers, imagesWithMoreLayersThanFitAreDrawnInBands)
{
    Scene scene;
    std::vector<glm::vec4> nearestFirst;
    for (int i = 0; i < 3; ++i) {
        layers::Pane pane;
        pane.corner.z = -float(i);
        pane.color = layers::colorOf(i);
        nearestFirst.push_back(pane.color);
        layers::addPane(scene, pane);
    }
    View view = layers::flatView(1);
    view.width = 1080;
    view.height = 1080;
    view.camera.verticalExtent = 20;
    const Image image = draw(scene, view);
    for (int y = 0; y < view.height; y += 9)
        layers::expectNear(layers::at(image, 500 + y % 7, y), layers::over(nearestFirst), "a row");
}

TEST_F(RenderLayers, oneRowWithMoreLayersThanFitIsRefused)
{
    Mesh mesh;
    layers::Pane pane;
    pane.color.w = 0.5f;
    for (int i = 0; i < 700; ++i)
        layers::append(mesh, pane);
    Scene scene;
    layers::addMesh(scene, mesh, layers::addMaterial(scene, AlphaMode::blend));
    load(*renderer, scene);
    View view = layers::flatView(1);
    view.width = 4096; // times 700: 2.87 million
    view.height = 1;
    view.camera.verticalExtent = 0.001f;
    const Result<Image> image = renderer->draw(view);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().kind, ErrorKind::unavailable);
    EXPECT_EQ(image.error().message,
              "2867200 translucent fragments in one row of pixels: at most 2796202 can be sorted");
}

} // namespace
} // namespace cotan
