// The GPU and the reference renderer draw the same normals.
#include "models.hpp"

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

AngleStatistics difference(const Scene& scene, app::Painter& gpu, app::Painter& reference, bool pointSampled)
{
    View view;
    view.width = 640;
    view.height = 480;
    view.camera = fitCamera(bounds(scene), view.width, view.height);
    view.output = Output::normal;
    view.frame = int(Frame::cotangent);
    view.pointSampled = pointSampled;
    auto degrees = anglesBetween(drawWith(gpu, view), drawWith(reference, view));
    keepInterior(degrees, view.width, view.height);
    return angleStatistics(degrees);
}

TEST_P(Devices, pointSampledNormalsAgreeWithTheReference)
{
    COTAN_NEEDS_MODEL(GetParam().file);
    auto gpu = painterFor("auto"), reference = painterFor("reference");
    if (!gpu)
        GTEST_SKIP() << "no Vulkan device";
    const Scene scene = loadModel(GetParam().file);
    ASSERT_TRUE(gpu->load(scene));
    ASSERT_TRUE(reference->load(scene));
    const AngleStatistics s = difference(scene, *gpu, *reference, true);
    EXPECT_GT(s.count, 5000u);
    EXPECT_LT(s.median, 0.02);       // rounding of interpolation and differences
    EXPECT_LT(s.percentile99, 0.5);  // texels whose border falls between two roundings of uv
    RecordProperty("point_sampled", toText(s));
    // Filtered maps differ by what an anisotropic sampler is free to choose (docs/testing.md has the
    // measured parts): reported, and bounded loosely so that a broken mip chain would show.
    const AngleStatistics t = difference(scene, *gpu, *reference, false);
    EXPECT_LT(t.median, 2);
    RecordProperty("trilinear", toText(t));
    std::cout << GetParam().name << ": point sampled " << toText(s) << "\n    trilinear " << toText(t) << "\n";
}

INSTANTIATE_TEST_SUITE_P(Models, Devices,
    ::testing::Values(Model{"FlightHelmet", "models/FlightHelmet/FlightHelmet.gltf"},
                      Model{"BoomBox", "models/BoomBox/BoomBox.gltf"},
                      Model{"SketchfabCat", "models/SketchfabCat/scene.gltf"},
                      Model{"NormalTangentMirrorTest", "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb"},
                      Model{"uv_cases", "synthetic/uv_cases.gltf"}),
    [](const auto& model) { return std::string(model.param.name); });

} // namespace
} // namespace cotan
