// Stored tangents beside a texture transform (KHR_texture_transform): models are lit as if their uv had been
// transformed beforehand, with their tangents or without.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat2x2.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "cotan/render.hpp"
#include "gltf/json/lookup.hpp"
#include "run_tool.hpp"
#include "scene/geometry.hpp"

namespace cotan::test {
namespace {

struct Transform {
    glm::dvec2 u{1, 0}, v{0, 1}; // rows
    double determinant() const { return u.x * v.y - u.y * v.x; }
};

struct Random {
    std::mt19937 engine{20261128};
    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

// Scale, then rotation, as KHR_texture_transform composes them; also shears for the function alone.
Transform randomTransform(Random& random, bool sheared)
{
    const double angle = random(-3.1, 3.1), c = std::cos(angle), s = std::sin(angle);
    const double x = random(0.3, 3) * (random(0, 1) < 0.5 ? -1 : 1), y = random(0.3, 3) * (random(0, 1) < 0.5 ? -1 : 1);
    const double shear = sheared ? random(-1, 1) : 0;
    return {{c * x, c * x * shear + s * y}, {-s * x, -s * x * shear + c * y}};
}

// A flat patch in space: dP/du and dP/dv are constant.
struct Patch {
    Mesh mesh;
    glm::dvec3 alongU{0}, alongV{0};
};

Patch randomPatch(Random& random)
{
    const auto direction = [&] { return glm::normalize(glm::dvec3(random(-1, 1), random(-1, 1), random(-1, 1))); };
    Patch patch;
    const glm::dvec3 n = direction(), across = glm::normalize(glm::cross(n, direction()));
    const glm::dvec3 up = glm::cross(n, across);
    patch.alongU = random(0.5, 2) * across + random(-0.8, 0.8) * up;
    patch.alongV = random(-0.8, 0.8) * across + (random(0, 1) < 0.5 ? -1 : 1) * random(0.9, 2) * up;
    const double sign = glm::dot(glm::cross(patch.alongU, patch.alongV), n) < 0 ? 1 : -1; // v runs down
    for (int i = 0; i < 9; ++i) {
        const glm::dvec2 uv(i % 3, i / 3);
        patch.mesh.positions.emplace_back(patch.alongU * uv.x + patch.alongV * uv.y);
        patch.mesh.normals.emplace_back(n);
        patch.mesh.texcoords[0].emplace_back(uv);
        patch.mesh.tangents.emplace_back(glm::vec3(glm::normalize(patch.alongU)), float(sign));
    }
    for (const std::uint32_t i : {0u, 1u, 3u, 4u}) { // counter-clockwise, seen from where the normal points
        const std::uint32_t b = sign < 0 ? i + 1 : i + 3, c = sign < 0 ? i + 3 : i + 1;
        patch.mesh.indices.insert(patch.mesh.indices.end(), {i, b, c, i + 4, c, b});
    }
    return patch;
}

MeshView viewOf(const Mesh& mesh) { return {mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices}; }

double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

constexpr double kFloat = 2e-4; // degrees: rounding of float positions and tangents, up to ten times by stretched uv

TEST(TransformTangents, pointAlongTheTransformedUv)
{
    Random random;
    for (int i = 0; i < 500; ++i) {
        Patch patch = randomPatch(random);
        const Transform t = i == 0 ? Transform{} : randomTransform(random, i % 2 == 0);
        const float before = patch.mesh.tangents[0].w;
        transformTangents(patch.mesh.tangents, viewOf(patch.mesh), t.u, t.v);
        // dP/du' by the inverse of the transform's matrix.
        const glm::dmat2 inverse = glm::inverse(glm::dmat2(t.u.x, t.v.x, t.u.y, t.v.y));
        const glm::dvec3 expected = patch.alongU * inverse[0][0] + patch.alongV * inverse[0][1];
        for (const glm::vec4& tangent : patch.mesh.tangents) {
            EXPECT_LT(degreesBetween(glm::dvec3(tangent), expected), kFloat) << i;
            EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1, 1e-5) << i;
            EXPECT_EQ(tangent.w, t.determinant() < 0 ? -before : before) << i;
        }
    }
}

TEST(TransformTangents, areUndoneByTheInverseTransform)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        Patch patch = randomPatch(random);
        for (glm::vec4& tangent : patch.mesh.tangents) // also if they do not run along u, and have another w
            tangent = glm::vec4(
                glm::normalize(glm::vec3(tangent) + glm::cross(patch.mesh.normals[0], glm::vec3(tangent))), -tangent.w);
        const auto given = patch.mesh.tangents;
        const Transform t = randomTransform(random, true);
        transformTangents(patch.mesh.tangents, viewOf(patch.mesh), t.u, t.v);
        for (glm::vec2& uv : patch.mesh.texcoords[0])
            uv = glm::vec2(glm::dot(t.u, glm::dvec2(uv)), glm::dot(t.v, glm::dvec2(uv)));
        const double d = t.determinant();
        transformTangents(patch.mesh.tangents, viewOf(patch.mesh), glm::dvec2(t.v.y, -t.u.y) / d,
                          glm::dvec2(-t.v.x, t.u.x) / d);
        for (std::size_t k = 0; k < given.size(); ++k) {
            EXPECT_LT(degreesBetween(glm::dvec3(given[k]), glm::dvec3(patch.mesh.tangents[k])), kFloat) << i;
            EXPECT_EQ(given[k].w, patch.mesh.tangents[k].w) << i;
        }
    }
}

TEST(TransformTangents, degenerateInputTurnsNothing)
{
    Random random;
    const Patch patch = randomPatch(random);
    const auto turned = [&](const Mesh& mesh, glm::dvec2 u, glm::dvec2 v) {
        auto tangents = patch.mesh.tangents;
        transformTangents(tangents, viewOf(mesh), u, v);
        return tangents;
    };
    const double nan = std::nan("");
    EXPECT_EQ(turned(patch.mesh, {1, 1}, {1, 1}), patch.mesh.tangents); // no area
    EXPECT_EQ(turned(patch.mesh, {0, 0}, {0, 0}), patch.mesh.tangents);
    EXPECT_EQ(turned(patch.mesh, {nan, 0}, {0, 1}), patch.mesh.tangents);
    Mesh point = patch.mesh;
    point.texcoords[0].assign(9, {0.5f, 0.5f});
    EXPECT_EQ(turned(point, {0, 1}, {-1, 0}), patch.mesh.tangents);
    Mesh flat = patch.mesh;
    flat.positions.assign(9, {1, 2, 3});
    EXPECT_EQ(turned(flat, {0, 1}, {-1, 0}), patch.mesh.tangents);
    Mesh bare = patch.mesh;
    bare.normals.clear();
    EXPECT_EQ(turned(bare, {0, 1}, {-1, 0}), patch.mesh.tangents);
}

// ---- files ------------------------------------------------------------------------------------

// Two patches with a material each, whose normal maps have transforms of their own, as a document: with TANGENT for the
// stored uv; or with the uv transformed and no transform.
Scene patches(const std::vector<Patch>& made, const std::vector<Transform>& transforms, bool beforehand)
{
    Scene scene;
    scene.images = {makeReliefMap(Relief::waves, 64)};
    for (std::size_t i = 0; i < made.size(); ++i) {
        Material material;
        material.normalMap.image = 0;
        Mesh mesh = made[i].mesh;
        mesh.material = int(i);
        const Transform& t = transforms[i];
        if (beforehand) {
            mesh.tangents.clear();
            for (glm::vec2& uv : mesh.texcoords[0])
                uv = glm::vec2(glm::dot(t.u, glm::dvec2(uv)), glm::dot(t.v, glm::dvec2(uv)));
        } else {
            material.normalMap.uRow = glm::vec3(glm::vec2(t.u), 0);
            material.normalMap.vRow = glm::vec3(glm::vec2(t.v), 0);
            transformTangents(mesh.tangents, viewOf(made[i].mesh), t.u, t.v); // a scene has them like this
        }
        scene.materials.push_back(material);
        scene.instances.push_back({"patch", int(i), glm::translate(glm::mat4(1), {3.0f * float(i), 0, 0})});
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
}

GltfDocument documentOf(const Scene& scene)
{
    auto document = gltfDocumentOf(scene);
    if (!document)
        ADD_FAILURE() << document.error().message;
    return *std::move(document);
}

Image normalsOf(Scene scene, Frame frame, TangentOrigin tangents)
{
    deriveVertexFrames(scene, frame, tangents);
    View view;
    view.width = 96;
    view.height = 64;
    view.output = Output::normal;
    view.linearOutput = true;
    view.pointSampled = true;
    view.samples = 1;
    view.frame = frame;
    view.camera = *parseCamera("front", scene, view.width, view.height);
    auto renderer = openRenderer("reference", 1);
    if (!renderer || !(*renderer)->load(scene))
        ADD_FAILURE() << "no reference renderer";
    auto image = (*renderer)->draw(view);
    return image ? *image : Image{};
}

struct Difference {
    double largest = 0;
    std::size_t pixels = 0;
};

Difference between(const Image& a, const Image& b)
{
    Difference d;
    for (std::size_t i = 0; i < a.pixelCount() && a.pixelCount() == b.pixelCount(); ++i) {
        const float *p = a.floats() + 4 * i, *q = b.floats() + 4 * i;
        if (p[3] == 0 && q[3] == 0)
            continue;
        ++d.pixels;
        d.largest = std::max(d.largest, degreesBetween({p[0], p[1], p[2]}, {q[0], q[1], q[2]}));
    }
    return d;
}

class TextureTransform : public ::testing::Test {
protected:
    void SetUp() override
    {
        Random random;
        for (int i = 0; i < 2; ++i) {
            made.push_back(randomPatch(random));
            // Both patches face the camera.
            const glm::dvec3 n(made[std::size_t(i)].mesh.normals[0]);
            const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.3, 1, 0.2), n)), y = glm::cross(n, x);
            const auto facing = [&](glm::dvec3 v) {
                return glm::dvec3(glm::dot(x, v), glm::dot(y, v), glm::dot(n, v));
            };
            Patch& patch = made[std::size_t(i)];
            for (glm::vec3& p : patch.mesh.positions)
                p = glm::vec3(facing(p));
            for (glm::vec3& normal : patch.mesh.normals)
                normal = {0, 0, 1};
            for (glm::vec4& t : patch.mesh.tangents)
                t = glm::vec4(glm::vec3(facing(glm::dvec3(t))), t.w);
            transforms.push_back(randomTransform(random, false));
        }
        transforms[1] = {{1, 0}, {0, -1}}; // as in the public report
    }

    std::vector<Patch> made;
    std::vector<Transform> transforms;
    const TemporaryFolder folder;
};

TEST_F(TextureTransform, isLitAsIfTheUvHadBeenTransformedBeforehand)
{
    GltfDocument stored = documentOf(patches(made, transforms, false));
    ASSERT_TRUE(writeGltf(stored, folder.path() / "stored.glb"));
    const auto loaded = loadGltf(folder.path() / "stored.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings.front(); // nothing contradicts
    const Scene expected = patches(made, transforms, true);
    for (const Frame frame : {Frame::orthonormal, Frame::mikktspace, Frame::vertex, Frame::cotangent, Frame::smooth}) {
        const Difference d = between(normalsOf(*loaded, frame, TangentOrigin::stored),
                                     normalsOf(expected, frame, TangentOrigin::generated));
        EXPECT_GT(d.pixels, 1000u);
        EXPECT_LT(d.largest, 0.01) << name(frame); // float uv, read point by point
    }
}

TEST_F(TextureTransform, leavesTheFilesTangentsToTheStoredUv)
{
    GltfDocument stored = documentOf(patches(made, transforms, false));
    for (std::size_t i = 0; i < made.size(); ++i) { // as made above, for the uv without the transform
        const auto file = gltfGeometry(stored, i, 0, NormalSlot::surface, std::nullopt, TexcoordSpace::file);
        ASSERT_TRUE(file);
        for (const glm::vec4& t : file->tangents) {
            EXPECT_LT(degreesBetween(glm::dvec3(t), glm::dvec3(made[i].mesh.tangents[0])), kFloat);
            EXPECT_EQ(t.w, made[i].mesh.tangents[0].w);
        }
    }
    // Generated ones are for the same uv, so files written by us are read like those of other exporters.
    const auto compared = compareTangents(stored, {});
    ASSERT_TRUE(compared);
    EXPECT_EQ(verdictOf(compared->whole), TangentVerdict::equal);
    ASSERT_TRUE(giveTangents(stored, {.replace = true}));
    const auto given = gltfGeometry(stored, 1, 0, NormalSlot::surface, std::nullopt, TexcoordSpace::file);
    EXPECT_LT(degreesBetween(glm::dvec3(given->tangents[0]), glm::dvec3(made[1].mesh.tangents[0])), kFloat);
}

TEST_F(TextureTransform, changesNothingForLintAndConvert)
{
    GltfDocument stored = documentOf(patches(made, transforms, false));
    ASSERT_TRUE(writeGltf(stored, folder.path() / "stored.glb"));
    const LintReport report = lintScene(*loadGltf(folder.path() / "stored.glb"));
    ASSERT_EQ(report.primitives.size(), 2u);
    for (const PrimitiveLint& p : report.primitives) {
        EXPECT_EQ(p.stored.reversedW, 0) << p.stored.reversedW;
        EXPECT_EQ(p.stored.rotated, 0);
        EXPECT_LT(p.stored.angle.maximum, 0.01);
        const auto reading = std::ranges::find(p.readings, "stored", &Reading::name);
        ASSERT_NE(reading, p.readings.end());
        EXPECT_LT(reading->error.maximum, 0.01);
    }
    const auto kept = convertModel(stored, {.frames = {Frame::mikktspace, Frame::orthonormal}, .keepMaps = true});
    ASSERT_TRUE(kept) << kept.error().message;
    ASSERT_EQ(kept->maps.size(), 1u);
    EXPECT_FALSE(kept->maps[0].greenReversed);
    EXPECT_LT(kept->maps[0].figures.unconverted.maximum, 0.01);
}

// A coat's map with a transform of its own has a frame of its own: a flat square is lit alike with and without stored
// tangents.
TEST_F(TextureTransform, ofACoatIsItsOwn)
{
    Scene scene;
    scene.images = {makeReliefMap(Relief::waves, 64)};
    Mesh mesh = makePlane(2, 1, 1);
    mesh.tangents.assign(mesh.vertexCount(), {1, 0, 0, 1});
    scene.meshes = {mesh};
    scene.instances.push_back({"plane", 0, glm::rotate(glm::mat4(1), glm::radians(90.0f), {1, 0, 0})});
    scene.materials.emplace_back();
    scene.materials[0].coat.strength = 1;
    scene.materials[0].coat.normalMap.image = 0;
    scene.materials[0].coat.normalMap.uRow = {0, 1, 0};
    scene.materials[0].coat.normalMap.vRow = {-1, 0, 1};
    const auto drawn = [&](const std::string& device, Frame frame) {
        View view;
        view.width = view.height = 64;
        view.samples = 1;
        view.linearOutput = true;
        view.pointSampled = true;
        view.frame = frame;
        view.lights = {Light{}};
        view.lights[0].direction = glm::normalize(glm::vec3(-0.5f, -0.3f, -1));
        view.environment = view.background = view.shadows = false;
        view.camera = *parseCamera("front", scene, 64, 64);
        auto renderer = openRenderer(device, 1);
        if (!renderer)
            return Image{};
        EXPECT_TRUE((*renderer)->load(scene));
        return *(*renderer)->draw(view);
    };
    for (const char* const device : {"reference", "auto"}) {
        const Image stored = drawn(device, Frame::mikktspace), none = drawn(device, Frame::orthonormal);
        ASSERT_GT(none.pixelCount(), 0u);
        float largest = 0, brightest = 0;
        for (std::size_t i = 0; i < 4 * none.pixelCount(); ++i) {
            largest = std::max(largest, std::abs(stored.floats()[i] - none.floats()[i]));
            brightest = std::max(brightest, none.floats()[i]);
        }
        EXPECT_GT(brightest, 0.01f) << device; // the coat reflects something
        EXPECT_LT(largest, 1e-4f * std::max(brightest, 1.0f)) << device;
    }
}

} // namespace
} // namespace cotan::test
