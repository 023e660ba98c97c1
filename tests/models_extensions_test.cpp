// The maps and factors that extensions add to a material, on both renderers.
#include "tilted_quad.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cotan {
namespace {

using namespace test;

// A factor of an extension, the map that multiplies it, and a material that shows the effect.
struct MappedFactor {
    const char* name;
    void (*make)(Material&, float factor);
    Texture* (*map)(Material&);
};

const MappedFactor kMappedFactors[] = {
    {"specular", [](Material& m, float f) { m.specular.strength = f; }, [](Material& m) { return &m.specular.map; }},
    {"specular colour", [](Material& m, float f) { m.specular.color = glm::vec3(f); },
     [](Material& m) { return &m.specular.colorMap; }},
    {"sheen colour",
     [](Material& m, float f) {
         m.sheen.color = glm::vec3(f);
         m.sheen.roughness = 0.6f;
     },
     [](Material& m) { return &m.sheen.colorMap; }},
    {"sheen roughness",
     [](Material& m, float f) {
         m.sheen.color = glm::vec3(1);
         m.sheen.roughness = f;
     },
     [](Material& m) { return &m.sheen.roughnessMap; }},
    {"transmission", [](Material& m, float f) { m.transmission.strength = f; },
     [](Material& m) { return &m.transmission.map; }},
};

// The map uses uv set 1 through a transform: 1 on the right half, 0 on the left. The left must equal a render with
// factor 0, the right one with the factor alone.
TEST(MaterialExtensions, everyMapIsMultipliedByItsFactorAndUsesItsOwnUv)
{
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        for (const MappedFactor& f : kMappedFactors) {
            Scene scene = tiltedQuad();
            Mesh& mesh = scene.meshes[0];
            for (const glm::vec3& p : mesh.positions)
                mesh.texcoords[1].push_back({7, 4 * p.x}); // v grows to the right
            Image halves = makeImage(2, 1, PixelType::unorm8);
            std::fill_n(halves.bytes8() + 4, 4, std::uint8_t(255));
            scene.images[0] = halves;
            Material& m = scene.materials[0];
            m.baseColor = {0.2f, 0.3f, 0.4f, 1};
            m.metallic = 0;
            m.roughness = 0.5f;
            View view = quadView(Frame::cotangent);
            view.environment = view.background = true;
            view.pointSampled = true;
            const auto drawn = [&] {
                EXPECT_TRUE(renderer->load(scene));
                return drawWith(*renderer, view);
            };
            f.make(m, 0);
            const Image none = drawn();
            f.make(m, 0.8f);
            const Image whole = drawn();
            Texture& map = *f.map(m);
            map.image = 0;
            map.texcoord = 1;
            map.uRow = {0, 0.125f, 0.5f}; // u from v
            map.vRow = {0, 0, 0.5f};
            const Image mapped = drawn();
            for (int y = 4; y < 28; y += 5)
                for (int x = 2; x < 30; x += 3) {
                    const Image& expected = x < 16 ? none : whole;
                    for (std::size_t c = 0; c < 4; ++c) {
                        const std::size_t at = (std::size_t(y) * 32 + std::size_t(x)) * 4 + c;
                        EXPECT_NEAR(mapped.floats()[at], expected.floats()[at], 1e-5)
                            << device << ", " << f.name << " " << x << " " << y;
                    }
                }
            EXPECT_GT(std::abs(redAt(none, 12, 17) - redAt(whole, 12, 17)), 0.002) << device << ", " << f.name;
        }
    }
}

// Values that programs may set: images stay finite, and both renderers draw.
TEST(MaterialExtensions, extremeNumbersGiveFiniteImages)
{
    const float odd[] = {-1, 0, 1e30f, std::numeric_limits<float>::infinity(), std::nanf("")};
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        Scene scene = tiltedQuad();
        for (const float value : odd)
            for (int k = 0; k < 5; ++k) {
                Material m;
                m.specular.ior = k == 0 ? value : 1.5f;
                m.specular.strength = k == 1 ? value : 1.0f;
                m.specular.color = glm::vec3(k == 2 ? value : 1.0f);
                m.sheen.color = glm::vec3(k == 3 ? value : 0.0f);
                m.sheen.roughness = value;
                m.transmission.strength = k == 4 ? value : 0.0f;
                scene.materials[0] = m;
                const auto loaded = renderer->load(scene);
                if (!loaded)
                    continue; // refused with an error
                View view = quadView(Frame::cotangent);
                view.environment = true;
                const Image image = drawWith(*renderer, view);
                for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
                    ASSERT_TRUE(std::isfinite(image.floats()[i])) << device << " " << k << " " << value;
            }
    }
}

} // namespace
} // namespace cotan
