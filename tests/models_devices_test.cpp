// The GPU and the reference renderer draw the same normals.
#include "models.hpp"

#include <algorithm>
#include <iostream>

#include "cotan/frame.hpp"

namespace cotan {
namespace {

using namespace test;

struct Model {
    const char* name;
    const char* file;
};

void PrintTo(const Model& model, std::ostream* out) { *out << model.name; }

class Devices : public ::testing::TestWithParam<Model> {};

AngleStatistics difference(const Scene& scene, Renderer& gpu, Renderer& reference, bool pointSampled)
{
    View view;
    view.width = 640;
    view.height = 480;
    view.camera = fitCamera(bounds(scene), view.width, view.height);
    view.output = Output::normal;
    view.frame = Frame::cotangent;
    view.pointSampled = pointSampled;
    return angleStatistics(interiorAngles(drawWith(gpu, view), drawWith(reference, view)));
}

TEST_P(Devices, pointSampledNormalsAgreeWithTheReference)
{
    COTAN_NEEDS_DATA(GetParam().file);
    auto gpu = rendererFor("auto"), reference = rendererFor("reference");
    if (!gpu)
        GTEST_SKIP() << "no Vulkan device";
    const Scene scene = loadModel(GetParam().file);
    ASSERT_TRUE(gpu->load(scene));
    ASSERT_TRUE(reference->load(scene));
    const AngleStatistics s = difference(scene, *gpu, *reference, true);
    EXPECT_GT(s.count, 5000u);
    EXPECT_LT(s.median, 0.02);      // rounding of interpolation and differences
    EXPECT_LT(s.percentile99, 0.5); // texels whose border falls between the two roundings of uv
    RecordProperty("point_sampled", toText(s));
    // Filtered maps differ, since anisotropic sampling is implementation-defined (measured in docs/project/testing.md):
    // reported, and bounded loosely to detect a broken mip chain.
    const AngleStatistics t = difference(scene, *gpu, *reference, false);
    EXPECT_LT(t.median, 0.5);
    RecordProperty("trilinear", toText(t));
    std::cout << GetParam().name << ": point sampled " << toText(s) << "\n    trilinear " << toText(t) << "\n";
}

// Difference between a blended model and the same model cut out at half alpha: none where its texels are opaque.
struct ModeDifference {
    double fraction = 0; // fraction of pixels that differ by more than 3 steps of 8 bits
    double mean = 0;     // mean of the largest channel difference, in steps
};

ModeDifference modeDifference(const Scene& scene, Renderer& renderer)
{
    Scene cut = scene;
    for (Material& m : cut.materials)
        m.alphaMode = m.alphaMode == AlphaMode::blend ? AlphaMode::mask : m.alphaMode;
    View view;
    view.width = 320;
    view.height = 240;
    view.camera = fitCamera(bounds(scene), view.width, view.height);
    view.lights = defaultLights();
    view.shadows = false; // blended materials cast none
    EXPECT_TRUE(renderer.load(scene));
    const Image blended = drawWith(renderer, view);
    EXPECT_TRUE(renderer.load(cut));
    const Image solid = drawWith(renderer, view);
    ModeDifference result;
    for (std::size_t i = 0; i < blended.pixelCount(); ++i) {
        int step = 0;
        for (std::size_t c = 0; c < 3; ++c)
            step = std::max(step, std::abs(int(blended.bytes8()[4 * i + c]) - int(solid.bytes8()[4 * i + c])));
        result.fraction += step > 3 ? 1 : 0;
        result.mean += step;
    }
    result.fraction /= double(blended.pixelCount());
    result.mean /= double(blended.pixelCount());
    std::cout << "share " << result.fraction << ", mean " << result.mean << "\n";
    return result;
}

// Without sorted layers, the cat has hollow eyes and its coat is behind its body.
TEST(BlendedModel, opaqueTexelsHideLayersBehindThemOnBothDevices)
{
    COTAN_NEEDS_DATA("models/SketchfabCat/scene.gltf");
    const Scene scene = loadModel("models/SketchfabCat/scene.gltf");
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue; // no Vulkan device
        const ModeDifference t = modeDifference(scene, *renderer);
        EXPECT_LT(t.fraction, 0.005) << device;
        EXPECT_LT(t.mean, 0.1) << device;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, Devices,
                         ::testing::Values(Model{"FlightHelmet", "models/FlightHelmet/FlightHelmet.gltf"},
                                           Model{"BoomBox", "models/BoomBox/BoomBox.gltf"},
                                           Model{"SketchfabCat", "models/SketchfabCat/scene.gltf"},
                                           Model{"NormalTangentMirrorTest",
                                                 "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb"},
                                           Model{"uv_cases", "synthetic/uv_cases.gltf"}),
                         [](const auto& model) { return std::string(model.param.name); });

} // namespace
} // namespace cotan
