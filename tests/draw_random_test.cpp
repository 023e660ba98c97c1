// Random scenes with all features of materials, lights and cameras, drawn by both renderers. The two share no code
// except the portable text, which one runs as C++ and the other as SPIR-V.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {
namespace {

class Dice {
public:
    explicit Dice(std::uint32_t seed) : bits_(seed) {}
    int below(int end) { return int(bits_() % std::uint32_t(end)); }
    bool heads() { return below(2) == 0; }
    float from(float low, float high) { return low + (high - low) * float(bits_() % 65536u) / 65535.0f; }
    glm::vec3 three(float low, float high)
    {
        const float x = from(low, high), y = from(low, high), z = from(low, high);
        return {x, y, z};
    }

private:
    std::mt19937 bits_;
};

// Bytes that vary only a little between texels in every channel, so that filters meet no sharp edges.
Image randomImage(Dice& dice, bool normals)
{
    Image image = makeImage(3 + dice.below(6), 3 + dice.below(6), PixelType::unorm8, "random");
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            image.bytes8()[4 * i + c] = std::uint8_t(normals && c == 2 ? 230 : 100 + dice.below(normals ? 56 : 120));
    return image;
}

Texture randomTexture(Dice& dice, Scene& scene, bool normals = false)
{
    Texture texture;
    if (dice.below(3) == 0)
        return texture;
    texture.image = int(scene.images.size());
    scene.images.push_back(randomImage(dice, normals));
    texture.texcoord = dice.below(2);
    texture.sampler = {Wrap(dice.below(3)), Wrap(dice.below(3)), Filter::linear, Filter::linear, MipFilter::linear};
    const float a = dice.from(-1, 1), s = dice.from(0.6f, 1.4f), t = dice.from(0.6f, 1.4f);
    texture.uRow = {s * std::cos(a), t * std::sin(a), dice.from(0, 1)};
    texture.vRow = {-s * std::sin(a), t * std::cos(a), dice.from(0, 1)};
    return texture;
}

Material randomMaterial(Dice& dice, Scene& scene)
{
    Material m;
    m.baseColor = glm::vec4(dice.three(0.3f, 1), 1);
    m.metallic = dice.heads() ? 0.0f : dice.from(0, 1);
    m.roughness = dice.from(0.3f, 1);
    m.emissive = dice.heads() ? glm::vec3(0) : dice.three(0, 0.3f);
    m.occlusionStrength = dice.from(0, 1);
    m.normalScale = dice.from(0.5f, 1.5f);
    m.baseColorMap = randomTexture(dice, scene);
    m.metallicRoughnessMap = randomTexture(dice, scene);
    m.normalMap = randomTexture(dice, scene, /*normals*/ true);
    m.occlusionMap = randomTexture(dice, scene);
    m.emissiveMap = randomTexture(dice, scene);
    m.doubleSided = true;
    m.unlit = dice.below(8) == 0;
    if (dice.below(3) == 0) {
        m.coat.strength = dice.from(0.3f, 1);
        m.coat.roughness = dice.from(0.3f, 0.8f);
        m.coat.normalScale = dice.from(0.5f, 1.5f);
        m.coat.map = randomTexture(dice, scene);
        m.coat.roughnessMap = randomTexture(dice, scene);
        m.coat.normalMap = randomTexture(dice, scene, /*normals*/ true);
    }
    if (dice.below(3) == 0) {
        m.anisotropy.strength = dice.from(0.2f, 0.9f);
        m.anisotropy.rotation = dice.from(-2, 2);
        m.anisotropy.map = randomTexture(dice, scene);
    }
    if (dice.below(3) == 0) {
        m.specular.ior = dice.from(1.1f, 2);
        m.specular.strength = dice.from(0.2f, 1);
        m.specular.color = dice.three(0.3f, 1);
        m.specular.map = randomTexture(dice, scene);
        m.specular.colorMap = randomTexture(dice, scene);
    }
    if (dice.below(3) == 0) {
        m.sheen.color = dice.three(0.2f, 1);
        m.sheen.roughness = dice.from(0.3f, 1);
        m.sheen.colorMap = randomTexture(dice, scene);
        m.sheen.roughnessMap = randomTexture(dice, scene);
    }
    if (dice.below(2) == 0) {
        m.heightMap.map = randomTexture(dice, scene);
        m.heightMap.depth = dice.from(0.02f, 0.1f);
    }
    return m;
}

// A ball in front of a wall; both have vertex colours and a second, different set of uv.
Scene randomScene(Dice& dice)
{
    Scene scene;
    scene.meshes = {makeSphere(1, 24), makePlane(7, 4, 2)};
    for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
        Mesh& mesh = scene.meshes[k];
        mesh.material = int(k);
        const float shear = dice.from(-1, 1);
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            const glm::vec2 uv = mesh.texcoords[0][i];
            mesh.texcoords[1].push_back({uv.x * 0.7f + uv.y * shear, 0.2f - uv.y * 0.8f});
            mesh.colors.push_back({0.8f + 0.2f * std::sin(4 * uv.x), 0.7f + 0.1f * uv.y, 0.9f, 1});
        }
        scene.materials.push_back(randomMaterial(dice, scene));
    }
    const glm::mat4 rotation = glm::rotate(glm::mat4(1), dice.from(-2, 2), glm::vec3(0.3f, 1, 0.2f));
    const float mirrored = dice.heads() ? -1.0f : 1.0f;
    scene.instances = {
        {"ball", 0, glm::scale(rotation, glm::vec3(mirrored * dice.from(0.8f, 1.2f), dice.from(0.8f, 1.2f), 1))},
        {"wall", 1, glm::translate(glm::rotate(glm::mat4(1), 1.4f, glm::vec3(1, 0, 0)), {0.3f, -1.6f, 0.2f})}};
    return scene;
}

View randomView(Dice& dice, Output output)
{
    View view;
    view.width = 44;
    view.height = 36;
    view.output = output;
    view.linearOutput = true;
    view.camera.eye = glm::vec3(dice.from(-1.5f, 1.5f), dice.from(-0.5f, 1.5f), 5);
    view.camera.target = dice.three(-0.2f, 0.2f);
    view.camera.orthographic = dice.heads();
    view.camera.verticalExtent = dice.from(2, 4);
    view.camera.verticalFieldOfView = dice.from(0.5f, 0.9f);
    view.frame = Frame(dice.below(kFrameCount));
    view.shading = dice.below(4) == 0 ? Shading::blinnPhong : Shading::pbr;
    view.environment = dice.below(4) != 0;
    view.exposure = dice.from(0.5f, 2);
    view.samples = dice.heads() ? 1 : 4;
    view.rowsUpward = dice.heads();
    view.shadows = false; // shadow edges are sharp; other tests cover them
    const glm::vec3 towards = glm::normalize(glm::vec3(dice.from(-1, 1), dice.from(-1, 1), -1.5f));
    view.lights.push_back({LightKind::directional, dice.three(0.3f, 1), dice.from(0.5f, 2), {}, towards, 0, 0, 0});
    view.lights.push_back({LightKind::point,
                           dice.three(0.3f, 1),
                           dice.from(2, 8),
                           {2, dice.from(-2, 2), 3},
                           {0, -1, 0},
                           dice.heads() ? 0.0f : 9.0f,
                           0,
                           0});
    const glm::vec3 lamp(dice.from(-2, 2), 1, 4);
    view.lights.push_back({LightKind::spot, dice.three(0.3f, 1), dice.from(5, 20), lamp, glm::normalize(-lamp),
                           dice.heads() ? 0.0f : 9.0f, 0.1f, 0.5f});
    return view;
}

// The fraction of pixels that differ by more than edges, filters with 8 fractional bits and rounding explain, and the
// mean difference of all other pixels.
struct Difference {
    double fraction = 0, mean = 0;
};

Difference between(const Image& a, const Image& b)
{
    Difference d;
    std::size_t others = 0;
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i) {
        double worst = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const double x = double(a.floats()[4 * i + c]), y = double(b.floats()[4 * i + c]);
            worst = std::max(worst, std::abs(x - y) / (1 + std::abs(y)));
        }
        if (worst < 0.03)
            sum += worst;
        else
            ++others;
    }
    d.fraction = double(others) / double(a.pixelCount());
    d.mean = sum / double(a.pixelCount());
    return d;
}

TEST(DrawRandom, bothRenderersAgreeOnRandomScenesWithAllFeatures)
{
    const auto device = openRenderer("auto");
    ASSERT_TRUE(device);
    if (!(*device)->note.empty())
        GTEST_SKIP() << (*device)->note;
    const auto reference = openRenderer("reference");
    ASSERT_TRUE(reference);
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        Dice dice(seed);
        Scene scene = randomScene(dice);
        View view = randomView(dice, Output::shaded);
        deriveVertexFrames(scene, view.frame, TangentOrigin::generated);
        ASSERT_TRUE((*device)->load(scene));
        ASSERT_TRUE((*reference)->load(scene));
        for (const Output output : {Output::shaded, seed % 2 != 0 ? Output::normal : Output::uv}) {
            view.output = output;
            const auto a = (*device)->draw(view), b = (*reference)->draw(view);
            ASSERT_TRUE(a) << a.error().message;
            ASSERT_TRUE(b) << b.error().message;
            const Difference d = between(*a, *b);
            EXPECT_LT(d.fraction, 0.02) << "seed " << seed << ", " << name(view.frame) << ", output " << int(output);
            EXPECT_LT(d.mean, 0.002) << "seed " << seed << ", " << name(view.frame) << ", output " << int(output);
        }
    }
}

// Drivers that render on the CPU get only the triangles that no other hides.
TEST(DrawRandom, bothRenderersAgreeWhereHundredsOfSurfacesHideEachOther)
{
    const auto device = openRenderer("auto"), reference = openRenderer("reference");
    ASSERT_TRUE(device);
    ASSERT_TRUE(reference);
    if (!(*device)->note.empty())
        GTEST_SKIP() << (*device)->note;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        Dice dice(seed);
        Scene scene;
        for (int i = 0; i < 6; ++i) { // each of three meshes in two colours
            scene.meshes.push_back(i % 3 == 0       ? makePlane(0.8f, 3, 1)
                                       : i % 3 == 1 ? makeCube(0.4f, 1)
                                                    : makeSphere(0.3f, 8));
            scene.meshes.back().material = i;
            Material& material = scene.materials.emplace_back();
            material.baseColor = glm::vec4(dice.three(0.1f, 1), 1);
            material.unlit = true;
            material.doubleSided = dice.heads();
        }
        for (int i = 0; i < 300; ++i) {
            glm::mat4 to = glm::translate(glm::mat4(1), dice.three(-1.4f, 1.4f));
            to = glm::rotate(to, dice.from(-3, 3), glm::normalize(dice.three(0.1f, 1)));
            scene.instances.push_back(
                {"", dice.below(6), glm::scale(to, glm::vec3(dice.heads() ? -1.0f : 1.0f, 1, dice.from(0.5f, 1.5f)))});
        }
        View view = randomView(dice, Output::shaded);
        view.width = 88;
        view.height = 72;
        view.samples = 4;
        view.frame = Frame::cotangent;
        ASSERT_TRUE((*device)->load(scene));
        ASSERT_TRUE((*reference)->load(scene));
        const auto a = (*device)->draw(view), b = (*reference)->draw(view);
        ASSERT_TRUE(a) << a.error().message;
        ASSERT_TRUE(b) << b.error().message;
        // A surface that is missing covers more pixels than rounding moves edges.
        EXPECT_LT(between(*a, *b).fraction, 0.002) << "seed " << seed;
    }
}

} // namespace
} // namespace cotan
