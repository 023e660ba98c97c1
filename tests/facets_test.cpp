// Normal mapping by rays: the fraction of uniform white light that is reflected, and reciprocity of light and eye.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/view.hpp"
#include "reference_scene.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;

struct Sheet {
    float tilt = 0;    // degrees by which the map tilts the normal
    float azimuth = 0; // degrees: towards the eye, across, away
    float view = 0;    // degrees from the surface's normal to the eye
    float metallic = 0;
    float roughness = 1;
};

// A direction at the angle `fromNormal` from the sheet's normal, rotated about it by `azimuth`; 0 is the eye's side.
glm::vec3 direction(float fromNormal, float azimuth)
{
    const float a = glm::radians(fromNormal), t = glm::radians(azimuth);
    return {std::sin(a) * std::cos(t), std::sin(a) * std::sin(t), std::cos(a)};
}

Scene sheetScene(const Sheet& sheet)
{
    Scene scene = sceneOf(meshOf(kSquare));
    Material& material = scene.materials[0];
    material.baseColor = glm::vec4(1);
    material.metallic = sheet.metallic;
    material.roughness = sheet.roughness;
    Image map = makeImage(1, 1, PixelType::float32);
    const glm::vec3 n = direction(sheet.tilt, sheet.azimuth);
    for (int c = 0; c < 3; ++c)
        map.floats()[c] = n[c] * 0.5f + 0.5f;
    map.floats()[3] = 1;
    scene.images.push_back(std::move(map));
    material.normalMap.image = 0;
    material.normalFormat.expansion = Expansion::biased;
    return scene;
}

View towards(glm::vec3 eye, NormalMapping mapping)
{
    View view = viewOf(Output::shaded);
    view.width = view.height = 20;
    view.samples = 1;
    view.linearOutput = true;
    view.background = view.shadows = view.environment = false;
    view.camera.eye = eye * 4.0f;
    view.camera.target = {0, 0, 0};
    view.camera.orthographic = true;
    view.camera.verticalExtent = 0.2f;
    view.normalMapping = mapping;
    return view;
}

double meanOf(const Scene& scene, const View& view)
{
    double sum = 0;
    const int count = forCovered(rendered(scene, view, 1), [&](int, int, glm::vec4 value) { sum += double(value.y); });
    EXPECT_GT(count, 0);
    return sum / count;
}

double furnace(const Sheet& sheet, NormalMapping mapping)
{
    static const auto white =
        std::make_shared<const EnvironmentMap>(makeEnvironment([](glm::vec3) { return glm::vec3(1); }, 1));
    View view = towards(direction(sheet.view, 0), mapping);
    view.environment = true;
    view.environmentMap = white;
    return meanOf(sheetScene(sheet), view);
}

// The reflected fraction of white light over all tilts and views in which the perturbed normal faces the eye.
struct Left {
    double minimum = 2, maximum = 0, mean = 0;
};
Left leftOf(NormalMapping mapping, float metallic, float roughness)
{
    Left left;
    int cases = 0;
    for (const float tilt : {0.0f, 35.0f, 70.0f})
        for (const float azimuth : {0.0f, 90.0f, 180.0f})
            for (const float view : {0.0f, 40.0f, 75.0f}) {
                const bool classic = mapping == NormalMapping::rays || mapping == NormalMapping::shadowed;
                if (classic && glm::dot(direction(tilt, azimuth), direction(view, 0)) < 0.1f)
                    continue;
                const double all = furnace({tilt, azimuth, view, metallic, roughness}, mapping);
                left = {std::min(left.minimum, all), std::max(left.maximum, all), left.mean + all};
                ++cases;
            }
    left.mean /= cases;
    const std::string name = "mapping_" + std::to_string(int(mapping)) + "_metallic_" + std::to_string(int(metallic))
        + "_roughness_" + std::to_string(int(100 * roughness));
    ::testing::Test::RecordProperty( // least, mean, most
        name, std::to_string(left.minimum) + " " + std::to_string(left.mean) + " " + std::to_string(left.maximum));
    return left;
}

// 25600 walks each: their noise is 0.3 % at most.
TEST(Facets, keepAllLightInAWhiteFurnaceUnlikeClassicNormalMapping)
{
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.15f, 0.5f, 1.0f}) {
            for (const NormalMapping mapping : {NormalMapping::facets, NormalMapping::mirrorFacet}) {
                const Left left = leftOf(mapping, metallic, roughness);
                EXPECT_GT(left.minimum, 0.99) << int(mapping) << " " << metallic << " " << roughness;
                EXPECT_LT(left.maximum, 1.01) << int(mapping) << " " << metallic << " " << roughness;
            }
            const Left rays = leftOf(NormalMapping::rays, metallic, roughness);
            EXPECT_LT(rays.mean, 0.9) << metallic << " " << roughness;
            EXPECT_LT(rays.minimum, 0.8) << metallic << " " << roughness;
            EXPECT_LT(leftOf(NormalMapping::shadowed, metallic, roughness).mean, rays.mean - 0.02);
        }
}

// Radiance under a light that gives the unperturbed sheet an irradiance of 1.
double reflected(const Sheet& sheet, glm::vec3 eye, glm::vec3 toLight, NormalMapping mapping)
{
    View view = towards(eye, mapping);
    view.width = view.height = 20;
    Light light;
    light.kind = LightKind::directional;
    light.direction = -toLight;
    light.intensity = 1 / toLight.z;
    view.lights = {light};
    return meanOf(sheetScene(sheet), view);
}

TEST(Facets, areReciprocalUnlikeClassicNormalMapping)
{
    const glm::vec3 a = direction(65, 0), b = direction(30, 140);
    for (const float metallic : {0.0f, 1.0f})
        for (const float azimuth : {0.0f, 80.0f, 180.0f}) {
            const Sheet sheet{45, azimuth, 0, metallic, 0.7f};
            for (const NormalMapping mapping : {NormalMapping::facets, NormalMapping::mirrorFacet}) {
                const double there = reflected(sheet, a, b, mapping), back = reflected(sheet, b, a, mapping);
                EXPECT_NEAR(there, back, 0.01 * std::max(there, back)) << metallic << " " << azimuth;
            }
        }
    const Sheet towardsEye{45, 0, 0, 1, 0.7f};
    EXPECT_GT(reflected(towardsEye, b, a, NormalMapping::rays), 3 * reflected(towardsEye, a, b, NormalMapping::rays));
}

} // namespace
} // namespace cotan
