// Default values of options. Headers promise them field by field, and programs rely on them. The command line and
// cotan.h have their own defaults, so no run of either tests these.
#include <gtest/gtest.h>

#include "batch/child.hpp"
#include "batch/job.hpp"
#include "batch/run.hpp"
#include "cotan/bake.hpp"
#include "cotan/convert.hpp"
#include "cotan/files.hpp"
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "cotan/maps.hpp"
#include "cotan/picture.hpp"
#include "cotan/shader_text.hpp"
#include "cotan/view.hpp"
#include "figures/figures.hpp"
#include "map_files/blend.hpp"
#include "map_files/convert.hpp"
#include "map_files/height.hpp"
#include "map_files/mips.hpp"

namespace cotan {

using namespace app;
namespace {

// glTF 2.0, "Material" and the extensions; KHR_lights_punctual: an outer cone of 45 degrees.
TEST(Defaults, ofSceneAreThoseOfGltf)
{
    Material m;
    EXPECT_EQ(m.baseColor, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.emissive, glm::vec3(0));
    EXPECT_EQ(m.occlusionStrength, 1);
    EXPECT_EQ(m.normalScale, 1);
    EXPECT_FALSE(m.normalFrame);
    EXPECT_FALSE(m.greenReversed);
    EXPECT_TRUE(m.alphaMode == AlphaMode::opaque);
    EXPECT_EQ(m.alphaCutoff, 0.5f);
    EXPECT_FALSE(m.doubleSided);
    EXPECT_FALSE(m.unlit);
    EXPECT_EQ(m.coat.strength, 0);
    EXPECT_EQ(m.coat.roughness, 0);
    EXPECT_EQ(m.coat.normalScale, 1);
    EXPECT_EQ(m.anisotropy.strength, 0);
    EXPECT_EQ(m.anisotropy.rotation, 0);
    EXPECT_EQ(m.specular.ior, 1.5f);
    EXPECT_EQ(m.specular.strength, 1);
    EXPECT_EQ(m.specular.color, glm::vec3(1));
    EXPECT_EQ(m.sheen.color, glm::vec3(0));
    EXPECT_EQ(m.sheen.roughness, 0);
    EXPECT_EQ(m.transmission.strength, 0);
    Texture t;
    EXPECT_EQ(t.image, -1);
    EXPECT_FALSE(t.present());
    EXPECT_EQ(t.texcoord, 0);
    EXPECT_EQ(t.uRow, glm::vec3(1, 0, 0));
    EXPECT_EQ(t.vRow, glm::vec3(0, 1, 0));
    EXPECT_TRUE(t.sampler.wrapU == Wrap::repeat);
    EXPECT_TRUE(t.sampler.wrapV == Wrap::repeat);
    EXPECT_EQ(Mesh().material, 0);
    EXPECT_EQ(Instance().mesh, 0);
    EXPECT_EQ(Instance().toWorld, glm::mat4(1));
    Light l;
    EXPECT_EQ(l.color, glm::vec3(1));
    EXPECT_EQ(l.range, 0);
    EXPECT_EQ(l.innerCone, 0);
    EXPECT_NEAR(l.outerCone, 3.14159265 / 4, 1e-6);
    EXPECT_EQ(l.position, glm::vec3(0));
    EXPECT_EQ(l.direction, glm::vec3(0, -1, 0));
}

TEST(Defaults, ofViewsShowTheSceneFromTheFront)
{
    View v;
    EXPECT_EQ(v.width, 1280);
    EXPECT_EQ(v.height, 720);
    EXPECT_EQ(v.frame, Frame::cotangent);
    EXPECT_TRUE(v.output == Output::shaded);
    EXPECT_TRUE(v.shadows);
    EXPECT_EQ(v.shadowSoftness, 0);
    EXPECT_TRUE(v.normalMaps);
    EXPECT_TRUE(v.environment);
    EXPECT_TRUE(v.background);
    EXPECT_FALSE(v.linearOutput);
    EXPECT_EQ(v.exposure, 1);
    EXPECT_EQ(v.samples, 4);
    EXPECT_TRUE(v.dither);
    EXPECT_FALSE(v.specularAntialiasing);
    EXPECT_FALSE(v.pointSampled);
    EXPECT_FALSE(v.rowsUpward);
    Camera c;
    EXPECT_FALSE(c.orthographic);
    EXPECT_NEAR(c.verticalFieldOfView, 3.14159265 / 4, 1e-6); // 45 degrees, the default of every camera here
    EXPECT_EQ(c.verticalExtent, 2);
    EXPECT_EQ(c.eye, glm::vec3(0, 0, 5));
    EXPECT_EQ(c.target, glm::vec3(0));
    EXPECT_EQ(c.up, glm::vec3(0, 1, 0));
}

TEST(Defaults, ofRendersAreThoseOfTheHelp)
{
    PictureOptions o;
    EXPECT_EQ(o.samples, 4);
    EXPECT_EQ(o.time, 0);
    EXPECT_EQ(o.environmentRotation, 0);
    EXPECT_EQ(o.environmentIntensity, 1);
    EXPECT_FALSE(o.shadowSoftness);
    EXPECT_FALSE(o.exposure);
    EXPECT_FALSE(o.background);
    EXPECT_TRUE(o.ground);
    EXPECT_EQ(o.size, (PictureSize{1280, 720}));
    EXPECT_FALSE(o.noShadows);
    EXPECT_FALSE(o.noNormalMaps);
    EXPECT_FALSE(o.pointSampled);
    EXPECT_FALSE(o.specularAntialiasing);
}

TEST(Defaults, ofBakingAreOneTileOfAMap)
{
    BakeOptions b;
    EXPECT_TRUE(b.kind == BakeKind::normal);
    EXPECT_EQ(b.width, 1024);
    EXPECT_EQ(b.height, 1024);
    EXPECT_EQ(b.samples, 2);
    EXPECT_EQ(b.tile, glm::ivec2(0));
    EXPECT_TRUE(b.search == BakeSearch::first);
    EXPECT_TRUE(b.rays == BakeRays::automatic);
    EXPECT_EQ(b.extrusion, 0);
    EXPECT_EQ(b.maxDistance, 0);
    EXPECT_EQ(b.cageReach, 0);
    EXPECT_EQ(b.occlusionRays, 64);
    EXPECT_EQ(b.occluders, Occluders::matched);
    EXPECT_EQ(b.threads, 0);
    BakeModelOptions m;
    EXPECT_TRUE(m.tiles.empty());
    EXPECT_TRUE(m.types.empty());
    EXPECT_EQ(m.material, -1);
    EXPECT_TRUE(m.tangents == TangentOrigin::stored);
    EXPECT_EQ(m.cage, nullptr);
    EXPECT_FALSE(m.matchByName);
    EXPECT_FALSE(m.ownMaps);
    EXPECT_EQ(m.highFrame, Frame::mikktspace);
    EXPECT_EQ(m.padding, 0);
    EXPECT_FALSE(m.mask);
}

TEST(Defaults, ofConversionsHaveNoLimitAndKeepNothing)
{
    ConvertModelOptions c;
    EXPECT_EQ(c.bits, 0);
    EXPECT_TRUE(c.expansion == Expansion::biased);
    EXPECT_FALSE(c.keepMaps);
    EXPECT_FALSE(c.keepTangents);
    EXPECT_EQ(c.threads, 0);
    EXPECT_EQ(c.memory, 0u);
    TangentsOptions t;
    EXPECT_EQ(t.frame, Frame::mikktspace);
    EXPECT_FALSE(t.replace);
    EXPECT_FALSE(t.mappedOnly);
    EXPECT_EQ(t.threads, 0);
    LintOptions l;
    EXPECT_EQ(l.distance, 0);
    EXPECT_EQ(l.memory, 0u);
    LintLimits limits;
    EXPECT_LT(limits.degrees, 0);
    EXPECT_LT(limits.area, 0);
    EXPECT_EQ(limits.frame, "orthonormal");
}

TEST(Defaults, ofReadingLimitImagesAndGeometry)
{
    LoadLimits l;
    EXPECT_EQ(l.fileBytes, std::size_t(2) << 30);
    EXPECT_EQ(l.vertices, 100'000'000u);
    EXPECT_EQ(l.triangles, 100'000'000u);
    EXPECT_EQ(l.nodes, 1'000'000u);
    EXPECT_EQ(l.imageSide, 16384);
    EXPECT_EQ(l.imageBytes, std::size_t(640) << 20);
}

TEST(Defaults, ofMapsAreThoseOfTheHelp)
{
    maps::BlendSettings b;
    EXPECT_TRUE(b.mode == maps::BlendMode::reoriented);
    EXPECT_EQ(b.strength, 1);
    EXPECT_EQ(b.tilesX, 1);
    EXPECT_EQ(b.tilesY, 1);
    EXPECT_EQ(b.mask, nullptr);
    EXPECT_FALSE(b.dither);
    EXPECT_EQ(b.firstRow, 0);
    EXPECT_EQ(b.imageHeight, 0);
    maps::MipSettings m;
    EXPECT_FALSE(m.keepLengths);
    EXPECT_TRUE(m.model == maps::VarianceModel::lean);
    EXPECT_EQ(m.roughness, 0.3);
    maps::RecodeSettings r;
    EXPECT_EQ(r.strength, 1);
    EXPECT_FALSE(r.normalise);
    EXPECT_FALSE(r.dither);
    EXPECT_EQ(r.firstRow, 0);
    maps::FromHeightSettings f;
    EXPECT_TRUE(f.kernel == maps::Kernel::central);
    EXPECT_TRUE(f.wrap == maps::Wrap::repeat);
    EXPECT_EQ(f.scaleX, 1);
    EXPECT_EQ(f.scaleY, 1);
    EXPECT_FALSE(f.dither);
    EXPECT_FALSE(f.bordered);
    EXPECT_EQ(f.firstRow, 0);
    maps::ToHeightSettings t;
    EXPECT_TRUE(t.boundary == maps::Boundary::periodic);
    EXPECT_TRUE(t.kernel == maps::Kernel::spectral);
    EXPECT_EQ(t.aspect, 1);
}

TEST(Defaults, ofMapFilesAreThoseOfTheHelp)
{
    BlendFileOptions b;
    EXPECT_EQ(b.strength, 1);
    EXPECT_EQ(b.tilesX, 1);
    EXPECT_EQ(b.tilesY, 1);
    EXPECT_EQ(b.bits, "auto");
    EXPECT_FALSE(b.dither);
    ConvertFileOptions c;
    EXPECT_EQ(c.bits, "auto");
    EXPECT_EQ(c.compress, "none");
    EXPECT_EQ(c.strength, 1);
    EXPECT_FALSE(c.normalise);
    EXPECT_FALSE(c.dither);
    FromHeightFileOptions f;
    EXPECT_EQ(f.range, 0);
    EXPECT_EQ(f.strength, 1);
    EXPECT_EQ(f.bits, "auto");
    EXPECT_FALSE(f.dither);
    ToHeightFileOptions t;
    EXPECT_TRUE(t.boundary == maps::Boundary::periodic);
    EXPECT_EQ(t.bits, "auto");
    MipFileOptions m;
    EXPECT_EQ(m.roughness, 0.3);
    EXPECT_FALSE(m.keepLengths);
    EXPECT_EQ(m.bits, "auto");
    EXPECT_EQ(m.compress, "none");
}

TEST(Defaults, ofBatchesRunOneSingleThreadedJobForAnHour)
{
    RunOptions r;
    EXPECT_EQ(r.processes, 1u);
    EXPECT_EQ(r.threads, 1);
    EXPECT_EQ(r.seconds, 3600);
    EXPECT_EQ(r.processorSeconds, 0);
    EXPECT_EQ(r.megabytes, 0u);
    EXPECT_EQ(r.retries, 0);
    EXPECT_FALSE(r.again);
    JobOptions j;
    EXPECT_EQ(j.priority, 0);
    EXPECT_FALSE(j.megabytes || j.seconds || j.processorSeconds || j.retries);
    ChildRequest c;
    EXPECT_EQ(c.parent, 0);
    EXPECT_EQ(c.megabytes, 0u);
    EXPECT_EQ(c.processorSeconds, 0u);
}

TEST(Defaults, ofShaderTextsAreAWholeShaderOfTheOrthonormalFrame)
{
    shader_text::Choice c;
    EXPECT_TRUE(c.language == shader_text::Language::glsl);
    EXPECT_EQ(c.frame, Frame::orthonormal);
    EXPECT_FALSE(c.form);
    EXPECT_EQ(c.uvSets, 1);
    EXPECT_TRUE(c.stage == shader_text::Stage::all);
    EXPECT_FALSE(c.callerDifferences);
    EXPECT_FALSE(c.functionsOnly);
    EXPECT_FALSE(c.twoSided);
    figures::FiguresOptions f;
    EXPECT_EQ(f.width, 480);
    EXPECT_EQ(f.height, 360);
    EXPECT_EQ(f.threads, 0);
}

} // namespace
} // namespace cotan
