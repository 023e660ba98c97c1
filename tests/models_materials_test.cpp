// Material extensions on both renderers and on the models that use them.
#include "tilted_quad.hpp"

#include <algorithm>
#include <iostream>

#include "cotan/view.hpp"
#include "scene/geometry.hpp"

namespace cotan {
namespace {

using namespace test;

// Alpha of the cat's coat and of its first material is 1 almost everywhere; the difference allows for the other texels.
TEST(Shadows, nearlyOpaqueBlendingCastsTheShadowOfAnOpaqueSurface)
{
    COTAN_NEEDS_DATA("models/SketchfabCat/scene.gltf");
    Scene scene = loadModel("models/SketchfabCat/scene.gltf");
    View view;
    view.width = view.height = 400;
    view.camera = frontCamera(scene, 400, 400);
    view.backdrop = Backdrop::paper;
    view.shadowSoftness = 0.0875f;
    view.lights.resize(1);
    view.lights[0].direction = glm::normalize(glm::vec3(0.62f, -0.9f, -0.7f));
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        std::vector<Image> images;
        for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::blend}) {
            for (Material& material : scene.materials)
                material.alphaMode = mode;
            View drawn = view;
            auto ground = makeGround(scene, view);
            ASSERT_TRUE(ground);
            drawn.ground = std::make_shared<const GroundMap>(std::move(*ground));
            ASSERT_TRUE(renderer->load(scene));
            images.push_back(drawWith(*renderer, drawn));
        }
        double sum = 0;
        for (std::size_t i = 0; i < images[0].data.size(); ++i)
            sum += std::abs(int(images[0].bytes8()[i]) - int(images[1].bytes8()[i]));
        // In steps of 255: 7 without the coat's shadow. The rest comes from decals, fur and buttons, which are not
        // opaque.
        EXPECT_LT(sum / double(images[0].pixelCount() * 3), 1) << device;
    }
}

TEST(Coat, normalMapIsReadLikeThatOfTheSurface)
{
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        for (const FrameInfo& frame : frames())
            for (const bool transformed : {false, true}) {
                Texture map;
                map.image = 0;
                if (transformed) { // by 90 degrees, and stretched
                    map.uRow = {0, 1.5f, 0};
                    map.vRow = {-1, 0, 1};
                }
                // A black dielectric reflects by its highlight alone, like a coat.
                Scene own = tiltedQuad();
                Material& black = own.materials[0];
                black.baseColor = {0, 0, 0, 1};
                black.metallic = 0;
                black.roughness = 0.5f;
                black.normalMap = map;
                // A black metal reflects nothing except at grazing angles. Its own map has another tilt.
                Scene coated = tiltedQuad();
                Material& metal = coated.materials[0];
                metal.baseColor = {0, 0, 0, 1};
                metal.metallic = 1;
                metal.coat.strength = 1;
                metal.coat.roughness = 0.5f;
                metal.coat.normalMap = map;
                deriveVertexFrames(own, frame.frame, TangentOrigin::stored);
                deriveVertexFrames(coated, frame.frame, TangentOrigin::stored);
                // Tangents are generated for the surface's own map.
                const bool stored = readsTangents(frame.frame) && transformed;
                View view = quadView(frame.frame);
                ASSERT_TRUE(renderer->load(own));
                const Image expected = drawWith(*renderer, view);
                ASSERT_TRUE(renderer->load(coated));
                const Image found = drawWith(*renderer, view);
                const double a = redAt(expected, 12, 17), b = redAt(found, 12, 17);
                EXPECT_GT(a, 0.001) << device << ", " << frame.name;
                if (!stored) {
                    EXPECT_NEAR(b / a, 1, 2e-3) << device << ", " << frame.name << ", " << transformed;
                }
                if (frame.frame != Frame::cotangent)
                    continue;
                // Without the coat's map the highlight moves.
                coated.materials[0].coat.normalMap = {};
                ASSERT_TRUE(renderer->load(coated));
                EXPECT_GT(std::abs(redAt(drawWith(*renderer, view), 12, 17) / a - 1), 0.05) << device << frame.name;
            }
    }
}

TEST(Coat, attenuatesEmission)
{
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        Scene scene = tiltedQuad();
        scene.materials[0].emissive = {0.5f, 0.5f, 0.5f};
        scene.materials[0].coat.strength = 0.5f;
        View view = quadView(Frame::cotangent);
        view.lights.clear();
        ASSERT_TRUE(renderer->load(scene));
        EXPECT_NEAR(redAt(drawWith(*renderer, view), 12, 17), 0.5 * (1 - 0.5 * 0.04), 1e-5) << device;
    }
}

TEST(Anisotropy, highlightFollowsTheDirectionOnBothRenderers)
{
    // View and light straight ahead, normal tilted along u: stretched along u, the highlight is brighter there than
    // across.
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        Scene scene = tiltedQuad();
        for (glm::vec2& uv : scene.meshes[0].texcoords[0])
            uv.x = 1 - uv.x; // not mirrored
        Material& m = scene.materials[0];
        m.roughness = 0.3f;
        m.anisotropy.strength = 0.9f;
        View view = quadView(Frame::cotangent);
        const auto lit = [&](float rotation, glm::vec3 direction) {
            m.anisotropy.rotation = rotation;
            view.lights[0].direction = glm::normalize(direction);
            EXPECT_TRUE(renderer->load(scene));
            return redAt(drawWith(*renderer, view), 12, 17);
        };
        // dp/du is along x: u does not grow along (0.1, 0.4).
        const glm::vec3 along(-0.8f, 0, -1), across(0, -0.8f, -1), slant(-0.57f, -0.57f, -1);
        EXPECT_GT(lit(0, along), 5 * lit(0, across)) << device;
        EXPECT_GT(lit(1.5708f, across), 5 * lit(1.5708f, along)) << device;
        // From +u towards -v, which is up: 45 degrees point to the upper right.
        const glm::vec3 other(-0.57f, 0.57f, -1);
        EXPECT_GT(lit(0.7854f, slant), 5 * lit(0.7854f, other)) << device;
    }
}

// Two uv sets: the second is turned by 90 degrees against the first, and mirrored. What a map on the second set draws
// must equal what a map on the first draws on a quad that has the second's uv there.
glm::vec2 otherUv(glm::vec2 uv) { return {uv.y * 1.5f, uv.x}; }

Texture onSet(int set)
{
    Texture map;
    map.image = 0;
    map.texcoord = set;
    return map;
}

// The quad with both sets, or with the second one as its first; its map has direction +u and full strength.
Scene twoSets(bool swapped)
{
    Scene scene = tiltedQuad();
    Mesh& mesh = scene.meshes[0];
    for (const glm::vec2 uv : mesh.texcoords[0])
        mesh.texcoords[1].push_back(otherUv(uv));
    if (swapped)
        std::swap(mesh.texcoords[0], mesh.texcoords[1]);
    scene.images.push_back(scene.images[0]);
    const int texel[] = {255, 128, 255, 255};
    for (int c = 0; c < 4; ++c)
        scene.images[1].bytes8()[c] = std::uint8_t(texel[c]);
    scene.materials[0].roughness = 0.3f;
    return scene;
}

TEST(TwoUvSets, groovesFollowTheNormalMapsUvAndTheirOwnWithoutOne)
{
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        for (const FrameInfo& frame : frames()) {
            // grooves, normal: uv set of each map, or none
            const auto drawn = [&](bool swapped, int grooves, int normal, bool transformed) {
                Scene scene = twoSets(swapped);
                Material& m = scene.materials[0];
                m.anisotropy.strength = 0.9f;
                m.anisotropy.map = onSet(grooves);
                m.anisotropy.map.image = 1;
                if (transformed) { // as otherUv
                    m.anisotropy.map.uRow = {0, 1.5f, 0};
                    m.anisotropy.map.vRow = {1, 0, 0};
                }
                if (normal >= 0)
                    m.normalMap = onSet(normal);
                if (normal >= 0 && transformed) {
                    m.normalMap.uRow = m.anisotropy.map.uRow;
                    m.normalMap.vRow = m.anisotropy.map.vRow;
                }
                deriveVertexFrames(scene, frame.frame, TangentOrigin::stored);
                EXPECT_TRUE(renderer->load(scene));
                return redAt(drawWith(*renderer, quadView(frame.frame)), 12, 17);
            };
            const double first = drawn(false, 0, -1, false), second = drawn(true, 0, -1, false);
            EXPECT_GT(std::abs(first / second - 1), 0.05) << "the sets differ, " << frame.name;
            EXPECT_NEAR(drawn(false, 1, -1, false) / second, 1, 2e-3) << device << ", " << frame.name;
            EXPECT_NEAR(drawn(false, 0, -1, true) / second, 1, 2e-3) << device << ", " << frame.name;
            // As in Khronos' CompareAnisotropy: grooves in the space of a normal map with a transform.
            EXPECT_NEAR(drawn(false, 0, 0, true) / drawn(true, 0, 0, false), 1, 2e-3) << device << ", " << frame.name;
            // glTF: without TANGENT the normal map's uv define the only tangent space.
            EXPECT_NEAR(drawn(false, 1, 0, false) / drawn(false, 0, 0, false), 1, 1e-6) << device << ", " << frame.name;
        }
    }
}

TEST(TwoUvSets, theCoatsNormalMapFollowsItsOwn)
{
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        for (const FrameInfo& frame : frames()) {
            if (readsTangents(frame.frame))
                continue; // generated for the surface's own map
            const auto drawn = [&](bool swapped, int coat) {
                Scene scene = twoSets(swapped);
                Material& m = scene.materials[0];
                m.baseColor = {0, 0, 0, 1};
                m.coat.strength = 1;
                m.coat.roughness = 0.5f;
                m.coat.normalMap = onSet(coat);
                if (!swapped)
                    m.normalMap = onSet(0); // another frame below the coat
                deriveVertexFrames(scene, frame.frame, TangentOrigin::stored);
                EXPECT_TRUE(renderer->load(scene));
                return redAt(drawWith(*renderer, quadView(frame.frame)), 12, 17);
            };
            const double second = drawn(true, 0);
            EXPECT_GT(std::abs(drawn(false, 0) / second - 1), 0.02) << frame.name;
            EXPECT_NEAR(drawn(false, 1) / second, 1, 5e-3) << device << ", " << frame.name;
        }
    }
}

// The base colour is almost black; the visible colour is the sheen.
TEST(MaterialModels, theVelvetSofaIsBlue)
{
    COTAN_NEEDS_DATA("models/GlamVelvetSofa/GlamVelvetSofa.glb");
    const Scene scene = loadModel("models/GlamVelvetSofa/GlamVelvetSofa.glb");
    for (const char* device : {"reference", "auto"}) {
        auto renderer = rendererFor(device);
        if (!renderer)
            continue;
        View view;
        view.width = 160;
        view.height = 120;
        view.camera = fitCamera(bounds(scene), view.width, view.height);
        view.lights = defaultLights();
        view.background = false;
        view.linearOutput = true;
        view.samples = 1;
        ASSERT_TRUE(renderer->load(scene));
        const Image image = drawWith(*renderer, view);
        glm::dvec4 sum(0);
        for (std::size_t i = 0; i < image.pixelCount(); ++i)
            for (int c = 0; c < 4; ++c)
                sum[c] += double(image.floats()[4 * i + std::size_t(c)]);
        const glm::dvec3 mean = glm::dvec3(sum) / sum.w;
        std::cout << device << ": " << mean.x << " " << mean.y << " " << mean.z << "\n";
        // The fibres' colour is 0.05 0.17 0.5; at most half of it is visible from within 60 degrees.
        EXPECT_GT(mean.z, 0.05) << device;
        EXPECT_LT(mean.z, 0.5) << device;
        EXPECT_GT(mean.z, 2 * mean.y) << device;
        EXPECT_GT(mean.y, mean.x) << device;
    }
}

// Mean over all pixels of the largest channel difference between shaded images, in steps of 8 bits.
double meanStep(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i) {
        int step = 0;
        for (std::size_t c = 0; c < 3; ++c)
            step = std::max(step, std::abs(int(a.bytes8()[4 * i + c]) - int(b.bytes8()[4 * i + c])));
        sum += step;
    }
    return sum / double(a.pixelCount());
}

Image renderOf(Renderer& renderer, Scene scene, Frame frame, bool layers)
{
    for (Material& m : scene.materials)
        if (!layers) {
            m.coat.strength = m.anisotropy.strength = m.transmission.strength = 0;
            m.specular = {};
            m.sheen = {};
        }
    deriveVertexFrames(scene, frame, TangentOrigin::stored);
    View view;
    view.width = 320;
    view.height = 240;
    view.camera = fitCamera(bounds(scene), view.width, view.height);
    view.lights = defaultLights();
    view.frame = frame;
    EXPECT_TRUE(renderer.load(scene));
    return drawWith(renderer, view);
}

TEST(MaterialModels, bothRenderersDrawTheSameLayers)
{
    auto gpu = rendererFor("auto"), reference = rendererFor("reference");
    if (!gpu)
        GTEST_SKIP() << "no Vulkan device";
    for (const char* file :
         {"models/ClearCoatTest/ClearCoatTest.glb", "models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb",
          "materials/AnisotropyDiscTest.glb", "models/GlamVelvetSofa/GlamVelvetSofa.glb",
          "models/SunglassesKhronos/SunglassesKhronos.glb", "materials/AttenuationTest.glb",
          "materials/TransmissionRoughnessTest.glb"}) {
        COTAN_NEEDS_DATA(file);
        const Scene scene = loadModel(file);
        const Image plain = renderOf(*reference, scene, Frame::cotangent, false);
        const double edges = meanStep(renderOf(*gpu, scene, Frame::cotangent, false), plain);
        const Image layered = renderOf(*reference, scene, Frame::cotangent, true);
        const double mean = meanStep(renderOf(*gpu, scene, Frame::cotangent, true), layered);
        const double layers = meanStep(plain, layered);
        std::cout << file << ": " << mean << " steps of 255; without its layers " << edges << "; they change " << layers
                  << "\n";
        // Triangle edges and filtered maps differ without layers too; these models have sharper highlights.
        EXPECT_LT(mean, edges + 0.15 * layers) << file;
    }
}

// Degrees between the anisotropy direction of a derived frame and that of the file's tangents, at four points of every
// triangle whose material is anisotropic.
std::vector<float> directionDifferences(const Scene& scene, Frame derived)
{
    std::vector<float> apart;
    for (const Mesh& mesh : scene.meshes) {
        const Material& m = scene.materials[std::size_t(mesh.material)];
        if (!(m.anisotropy.strength > 0) || mesh.tangents.empty())
            continue;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](const auto& values, int corner) {
                return values[mesh.indices[i + std::size_t(corner)]];
            };
            const auto& p = mesh.positions;
            const auto& uv = mesh.texcoords[0];
            const glm::vec3 e1 = at(p, 1) - at(p, 0), e2 = at(p, 2) - at(p, 0);
            const glm::vec2 d1 = at(uv, 1) - at(uv, 0), d2 = at(uv, 2) - at(uv, 0);
            if (glm::length(glm::cross(e1, e2)) < 1e-12f || std::abs(d1.x * d2.y - d1.y * d2.x) < 1e-12f)
                continue;
            for (const glm::vec3 w :
                 {glm::vec3(1, 1, 1) / 3.0f, {0.8f, 0.1f, 0.1f}, {0.1f, 0.8f, 0.1f}, {0.1f, 0.1f, 0.8f}}) {
                const auto mixed = [&](const auto& values) {
                    return at(values, 0) * w.x + at(values, 1) * w.y + at(values, 2) * w.z;
                };
                const glm::vec3 raw = mixed(mesh.normals), n = glm::normalize(raw);
                const f32::cotan_frame own = readsCotangents(derived)
                    ? evaluateCotangents(derived, n, mixed(mesh.cotangentsU), mixed(mesh.cotangentsV))
                    : evaluate(derived, n, e1, e2, d1, d2);
                const glm::vec4 tangent = mixed(mesh.tangents);
                const f32::cotan_frame stored =
                    evaluateTangents(Frame::mikktspace, raw, glm::vec3(tangent), -tangent.w);
                const glm::vec2 along(1, 0);
                const glm::vec3 a = f32::cotan_direction_on_surface(n, own.t, own.b, along, n);
                const glm::vec3 b = f32::cotan_direction_on_surface(n, stored.t, stored.b, along, n);
                // The direction of a highlight has no sign.
                const float cosine = std::abs(glm::dot(a, b)), sine = glm::length(glm::cross(a, b));
                apart.push_back(float(std::atan2(sine, cosine) * 57.29577951308232));
            }
        }
    }
    return apart;
}

TEST(Anisotropy, derivedDirectionIsThatOfTheStoredTangents)
{
    for (const char* file :
         {"materials/AnisotropyDiscTest.glb", "models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb"}) {
        COTAN_NEEDS_DATA(file);
        for (const Frame frame : {Frame::cotangent, Frame::smooth}) {
            Scene scene = loadModel(file);
            // For files without tangents: MikkTSpace's, as an engine generates them.
            deriveVertexFrames(scene, Frame::mikktspace, TangentOrigin::stored);
            deriveVertexFrames(scene, frame, TangentOrigin::stored);
            const AngleStatistics s = angleStatistics(directionDifferences(scene, frame));
            std::cout << file << ", " << name(frame) << ": " << toText(s) << "\n";
            EXPECT_GT(s.count, 300u) << file;
            // `smooth` averages at vertices as tangents do and agrees. Per pixel, each triangle has a constant
            // direction while interpolated tangents rotate: by a few degrees on spheres of 24 segments.
            EXPECT_LT(s.maximum, frame == Frame::smooth ? 0.2 : 6) << file;
            EXPECT_LT(s.mean, frame == Frame::smooth ? 0.1 : 2.5) << file;
        }
    }
}

} // namespace
} // namespace cotan
