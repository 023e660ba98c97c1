// Serialization between processes; received bytes are not trusted.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "cotan/scene.hpp"
#include "files/sandbox/request.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "scene/scene_check.hpp"

namespace cotan {
namespace {

using Bytes = std::vector<std::byte>;

template<class F> Bytes written(F exchange)
{
    Bytes bytes;
    WireOut out([&](std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
        return true;
    });
    exchange(out);
    EXPECT_TRUE(out.flush());
    return bytes;
}

Bytes bytesOf(const Scene& scene)
{
    return written([&](WireOut& out) { exchangeScene(out, scene); });
}

// Delivers `bytes` from offset `at`, at most `piece` bytes per call.
WireIn arriving(const Bytes& bytes, std::size_t& at, std::size_t piece, std::uint64_t limit = 1 << 26)
{
    return WireIn(
        [&bytes, &at, piece](std::span<std::byte> to) {
            const std::size_t n = std::min({to.size(), piece, bytes.size() - at});
            std::copy_n(bytes.begin() + std::ptrdiff_t(at), n, to.begin());
            at += n;
            return n;
        },
        limit);
}

// A scene in which no field has its default value.
Scene everything()
{
    Scene scene;
    scene.name = "all";
    scene.images.push_back(makeImage(3, 2, PixelType::unorm16, "picture"));
    for (std::size_t i = 0; i < scene.images[0].data.size(); ++i)
        scene.images[0].data[i] = std::byte(i);
    scene.images[0].frame = "smooth";
    Material& m = scene.materials.emplace_back();
    m.name = "material";
    m.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
    m.metallic = 0.5f, m.roughness = 0.6f, m.emissive = {0.7f, 0.8f, 0.9f}, m.occlusionStrength = 0.11f;
    m.normalScale = -2,
    m.normalFormat = {MapKind::objectSpace, Expansion::biased, Channels::stereographic, false, VDirection::up};
    m.normalMap = {
        0, 1, {Wrap::mirror, Wrap::clamp, Filter::nearest, Filter::linear, MipFilter::nearest}, {1, 2, 3}, {4, 5, 6}};
    m.alphaMode = AlphaMode::mask, m.alphaCutoff = 0.3f, m.doubleSided = true, m.unlit = true, m.tangentsFor = "X";
    m.coat.strength = 0.1f, m.coat.roughness = 0.2f, m.coat.normalScale = 0.3f, m.coat.map = m.normalMap;
    m.coat.roughnessMap.texcoord = 1, m.coat.normalMap.uRow = {7, 8, 9};
    m.anisotropy.strength = 0.4f, m.anisotropy.rotation = 0.5f, m.anisotropy.map = m.normalMap;
    m.specular.ior = 1.1f, m.specular.strength = 0.6f, m.specular.color = {0.7f, 0.8f, 0.9f};
    m.specular.map.vRow = {1, 1, 2}, m.specular.colorMap = m.normalMap;
    m.sheen.color = {0.3f, 0.2f, 0.1f}, m.sheen.roughness = 0.9f, m.sheen.colorMap.texcoord = 1;
    m.sheen.roughnessMap = m.normalMap;
    m.transmission.strength = 0.35f, m.transmission.map.uRow = {3, 1, 4};
    m.heightMap = {m.normalMap, 0.06f};
    Mesh mesh = makePlane(2, 2, 3);
    mesh.name = "mesh";
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, -1));
    mesh.colors.assign(mesh.vertexCount(), glm::vec4(0.5f));
    mesh.texcoords[1] = mesh.texcoords[0];
    mesh.cotangentsU.assign(mesh.vertexCount(), glm::vec3(1, 2, 3));
    mesh.cotangentsV.assign(mesh.vertexCount(), glm::vec3(4, 5, 6));
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"instance", 0, glm::mat4(2)});
    scene.lights.push_back({LightKind::spot, {1, 2, 3}, 4, {5, 6, 7}, {0, 0, 1}, 8, 0.1f, 0.2f});
    scene.cameras.push_back({"camera", true, 0.3f, 4, {1, 2, 3}, {4, 5, 6}, {0, 0, 1}});
    scene.warnings = {"one", "", "three"};
    return scene;
}

TEST(Wire, scenesArriveUnchangedInPiecesOfAnySize)
{
    const Scene scene = everything();
    const Bytes bytes = bytesOf(scene);
    for (const std::size_t piece : {std::size_t(1), std::size_t(7), std::size_t(1000), std::size_t(1) << 30}) {
        std::size_t at = 0;
        WireIn in = arriving(bytes, at, piece);
        Scene back;
        exchangeScene(in, back);
        ASSERT_TRUE(in.good());
        EXPECT_EQ(bytesOf(back), bytes);
        EXPECT_EQ(back.materials[0].normalMap.sampler.wrapV, Wrap::clamp);
        EXPECT_EQ(back.meshes[0].positions, scene.meshes[0].positions);
        EXPECT_EQ(back.images[0].frame, "smooth");
        EXPECT_EQ(back.cameras[0].target, glm::vec3(4, 5, 6));
        EXPECT_TRUE(checkScene(back, "f"));
    }
}

// Values are compared: a field that neither side exchanges would still give equal bytes.
TEST(Wire, everyFieldOfALightAndACameraArrives)
{
    const Bytes bytes = bytesOf(everything());
    std::size_t at = 0;
    WireIn in = arriving(bytes, at, 100);
    Scene back;
    exchangeScene(in, back);
    ASSERT_TRUE(in.good());
    const Light& light = back.lights.at(0);
    EXPECT_EQ(light.kind, LightKind::spot);
    EXPECT_EQ(light.color, glm::vec3(1, 2, 3));
    EXPECT_EQ(light.intensity, 4);
    EXPECT_EQ(light.position, glm::vec3(5, 6, 7));
    EXPECT_EQ(light.direction, glm::vec3(0, 0, 1));
    EXPECT_EQ(light.range, 8);
    EXPECT_EQ(light.innerCone, 0.1f);
    EXPECT_EQ(light.outerCone, 0.2f);
    const Camera& camera = back.cameras.at(0);
    EXPECT_EQ(camera.name, "camera");
    EXPECT_TRUE(camera.orthographic);
    EXPECT_EQ(camera.verticalFieldOfView, 0.3f);
    EXPECT_EQ(camera.verticalExtent, 4);
    EXPECT_EQ(camera.eye, glm::vec3(1, 2, 3));
    EXPECT_EQ(camera.target, glm::vec3(4, 5, 6));
    EXPECT_EQ(camera.up, glm::vec3(0, 0, 1));
}

// Every texture and number of a material has a distinct value.
TEST(Wire, everyTextureAndNumberOfAMaterialArrives)
{
    Scene scene = everything();
    const auto texturesOf = [](Material& m) {
        return std::array{&m.baseColorMap,       &m.metallicRoughnessMap, &m.normalMap,
                          &m.occlusionMap,       &m.emissiveMap,          &m.coat.map,
                          &m.coat.roughnessMap,  &m.coat.normalMap,       &m.anisotropy.map,
                          &m.specular.map,       &m.specular.colorMap,    &m.sheen.colorMap,
                          &m.sheen.roughnessMap, &m.transmission.map,     &m.heightMap.map};
    };
    const auto numbersOf = [](Material& m) {
        return std::array{&m.baseColor.x,
                          &m.baseColor.y,
                          &m.baseColor.z,
                          &m.baseColor.w,
                          &m.metallic,
                          &m.roughness,
                          &m.emissive.x,
                          &m.emissive.y,
                          &m.emissive.z,
                          &m.occlusionStrength,
                          &m.normalScale,
                          &m.alphaCutoff,
                          &m.coat.strength,
                          &m.coat.roughness,
                          &m.coat.normalScale,
                          &m.anisotropy.strength,
                          &m.anisotropy.rotation,
                          &m.specular.ior,
                          &m.specular.strength,
                          &m.specular.color.x,
                          &m.specular.color.y,
                          &m.specular.color.z,
                          &m.sheen.color.x,
                          &m.sheen.color.y,
                          &m.sheen.color.z,
                          &m.sheen.roughness,
                          &m.transmission.strength,
                          &m.heightMap.depth};
    };
    Material& m = scene.materials[0];
    int number = 1;
    for (Texture* t : texturesOf(m)) {
        *t = {0, number % 2, {}, {float(number), 2, 3}, {4, float(number), 6}};
        t->sampler.wrapU = number % 3 ? Wrap::mirror : Wrap::clamp;
        ++number;
    }
    for (float* x : numbersOf(m))
        *x = float(number++);
    m.coat.normalFormat = {MapKind::tangentSpace, Expansion::exact16, Channels::slope, true, VDirection::up};
    const Bytes bytes = bytesOf(scene);
    std::size_t at = 0;
    WireIn in = arriving(bytes, at, 100);
    Scene back;
    exchangeScene(in, back);
    ASSERT_TRUE(in.good());
    Material& b = back.materials.at(0);
    for (std::size_t i = 0; i < texturesOf(m).size(); ++i) {
        const Texture &sent = *texturesOf(m)[i], &found = *texturesOf(b)[i];
        EXPECT_EQ(found.image, 0) << i;
        EXPECT_EQ(found.texcoord, sent.texcoord) << i;
        EXPECT_EQ(found.sampler.wrapU, sent.sampler.wrapU) << i;
        EXPECT_EQ(found.uRow, sent.uRow) << i;
        EXPECT_EQ(found.vRow, sent.vRow) << i;
    }
    for (std::size_t i = 0; i < numbersOf(m).size(); ++i)
        EXPECT_EQ(*numbersOf(b)[i], *numbersOf(m)[i]) << i;
    EXPECT_EQ(b.coat.normalFormat, m.coat.normalFormat);
    EXPECT_EQ(b.normalFormat, m.normalFormat);
    EXPECT_EQ(b.name, "material");
    EXPECT_EQ(b.tangentsFor, "X");
    EXPECT_EQ(b.alphaMode, AlphaMode::mask);
    EXPECT_TRUE(b.doubleSided && b.unlit);
}

TEST(Wire, errorsKeepTheirKindAndMemoryFlag)
{
    for (const Error& error : {memoryError("a.png: too large"), unavailableError("not here")}) {
        const Bytes bytes = written([&](WireOut& out) { exchangeError(out, error); });
        std::size_t at = 0;
        WireIn in = arriving(bytes, at, 3);
        Error back;
        exchangeError(in, back);
        ASSERT_TRUE(in.good());
        EXPECT_EQ(at, bytes.size());
        EXPECT_EQ(back.kind, error.kind);
        EXPECT_EQ(back.message, error.message);
        EXPECT_EQ(back.memory, error.memory);
    }
}

TEST(Wire, largeArraysArriveWhole)
{
    std::vector<std::uint32_t> numbers(9'000'000), back; // more than one step of the growing allocation
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = std::uint32_t(i * 2654435761u);
    const Bytes bytes = written([&](WireOut& out) { out.array(numbers); });
    std::size_t at = 0;
    WireIn in = arriving(bytes, at, 100'000);
    in.array(back);
    EXPECT_TRUE(in.good());
    EXPECT_EQ(back, numbers);
}

TEST(Wire, falseCountsAllocateAtMost17MiB)
{
    for (const std::uint64_t count :
         {std::uint64_t(1) << 40, std::uint64_t(1) << 62, ~std::uint64_t(0), std::uint64_t(6'000'000)}) {
        const Bytes bytes = written([&](WireOut& out) { out.number(count); });
        std::vector<glm::vec3> values;
        std::vector<std::string> list;
        std::string text;
        std::size_t at = 0;
        WireIn array = arriving(bytes, at, 100);
        array.array(values);
        EXPECT_FALSE(array.good());
        EXPECT_LE(values.capacity() * sizeof(glm::vec3), std::size_t(17) << 20);
        at = 0;
        WireIn word = arriving(bytes, at, 100);
        word.array(text);
        EXPECT_FALSE(word.good());
        EXPECT_LE(text.capacity(), std::size_t(17) << 20);
        at = 0;
        WireIn items = arriving(bytes, at, 100);
        items.list(list, [](WireIn& in, std::string& s) { in.array(s); });
        EXPECT_FALSE(items.good());
        EXPECT_LE(list.size(), 1u);
    }
}

TEST(Wire, flagsAndChoicesOutOfRangeAreRefused)
{
    const Bytes three = written([](WireOut& out) { out.number(std::uint8_t(3)); });
    std::size_t at = 0;
    WireIn flag = arriving(three, at, 1);
    bool yes = false;
    flag.flag(yes);
    EXPECT_FALSE(flag.good());
    EXPECT_FALSE(flag.ended());
    at = 0;
    WireIn choice = arriving(three, at, 1);
    Wrap wrap = Wrap::repeat;
    choice.choice(wrap, Wrap::clamp);
    EXPECT_FALSE(choice.good());
    EXPECT_EQ(wrap, Wrap::repeat);
}

TEST(Wire, moreThanTheLimitIsRefused)
{
    const Bytes bytes = written([](WireOut& out) { out.array(std::vector<float>(1000)); });
    for (const std::uint64_t limit : {std::uint64_t(4007), std::uint64_t(4008)}) {
        std::size_t at = 0;
        WireIn in = arriving(bytes, at, 64, limit);
        std::vector<float> values;
        in.array(values);
        EXPECT_EQ(in.good(), limit == 4008);
    }
}

// Each fault breaks one rule for scenes.
TEST(SceneCheck, findsInvalidIndicesSizesAndNumbers)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    const std::pair<void (*)(Scene&, float), std::string> faults[] = {
        {[](Scene& s, float) { s.images[0].data.pop_back(); }, "image 0: expected the bytes of 3 x 2 pixels, found 47"},
        {[](Scene& s, float) { s.images[0].height = -2; }, "image 0: expected the bytes"},
        {[](Scene& s, float) { s.images[0].width = 0, s.images[0].data.clear(); }, "image 0: expected the bytes"},
        {[](Scene& s, float) { s.images[0].width = s.images[0].height = 1 << 30; }, "image 0: expected the bytes"},
        {[](Scene& s, float) { s.materials[0].normalMap.image = 1; },
         "material 0: normal map: expected an image below 1, found 1"},
        {[](Scene& s, float) { s.materials[0].emissiveMap.image = -2; }, "emission: expected an image"},
        {[](Scene& s, float) { s.materials[0].occlusionMap.texcoord = 2; }, "uv set 0 or 1, found 2"},
        {[](Scene& s, float x) { s.materials[0].baseColorMap.vRow.z = x; }, "base colour: expected a finite transform"},
        {[](Scene& s, float x) { s.materials[0].baseColor.w = x; }, "material 0: expected finite factors"},
        {[](Scene& s, float x) { s.materials[0].alphaCutoff = x; }, "material 0: expected finite factors"},
        {[](Scene& s, float x) { s.materials[0].normalScale = x; }, "material 0: expected finite factors"},
        {[](Scene& s, float) { s.materials[0].normalFormat.expansion = Expansion(4); }, "expected a normal encoding"},
        {[](Scene& s, float) { s.materials[0].normalFormat.channels = Channels(-1); }, "expected a normal encoding"},
        {[](Scene& s, float) { s.meshes[0].material = 1; }, "mesh 0: expected a material below 1, found 1"},
        {[](Scene& s, float) { s.meshes[0].material = -1; }, "expected a material below 1, found -1"},
        {[](Scene& s, float) { s.meshes[0].indices[5] = 9; }, "triangle 1: expected an index below 9, found 9"},
        {[](Scene& s, float) { s.meshes[0].indices.pop_back(); }, "three indices per triangle"},
        {[](Scene& s, float) { s.meshes[0].normals.clear(); }, "normals: expected 9 entries"},
        {[](Scene& s, float) { s.meshes[0].tangents.pop_back(); },
         "tangent: expected 9 entries, one per vertex, found 8"},
        {[](Scene& s, float) { s.meshes[0].texcoords[1].emplace_back(0); }, "uv set 1: expected 9 entries"},
        {[](Scene& s, float) { s.meshes[0].colors.resize(1); }, "colour: expected 9 entries"},
        {[](Scene& s, float) { s.meshes[0].cotangentsV.resize(1); }, "cotangent v: expected 9 entries"},
        {[](Scene& s, float x) { s.meshes[0].positions[8].y = x; }, "position 8: expected finite numbers"},
        {[](Scene& s, float x) { s.meshes[0].texcoords[0][3].y = x; }, "uv set 0 3: expected finite numbers"},
        {[](Scene& s, float) { s.instances[0].mesh = 1; }, "instance 0: expected a mesh below 1, found 1"},
        {[](Scene& s, float x) { s.instances[0].toWorld[3][1] = x; }, "instance 0: expected a finite transform"},
        {[](Scene& s, float x) { s.lights[0].outerCone = x; }, "light 0: expected finite numbers"},
        {[](Scene& s, float x) { s.cameras[0].up.x = x; }, "camera 0: expected finite numbers"},
    };
    ASSERT_TRUE(checkScene(everything(), "f"));
    for (const auto& [fault, expected] : faults) {
        for (const float value : {nan, -infinite}) {
            Scene scene = everything();
            fault(scene, value);
            const Status found = checkScene(scene, "f.obj");
            ASSERT_FALSE(found) << expected;
            EXPECT_TRUE(found.error().message.starts_with("f.obj: "));
            EXPECT_NE(found.error().message.find(expected), std::string::npos) << found.error().message;
        }
    }
}

TEST(ReaderBudget, growsWithFileSizeImageSizeAndMemoryLimit)
{
    constexpr std::size_t kMegabyte = 1 << 20;
    LoadLimits limits;
    const ReaderBudget start = budgetFor(limits, 0, 0);
    EXPECT_GE(start.megabytes, 656);
    EXPECT_EQ(start.seconds, 4);
    const ReaderBudget larger = budgetFor(limits, 10 * kMegabyte, 20 * kMegabyte);
    EXPECT_DOUBLE_EQ(larger.megabytes, start.megabytes + 64 * 10 + 6 * 20);
    EXPECT_DOUBLE_EQ(larger.seconds, 4 + 4 * 10 + 0.2 * 20);
    EXPECT_EQ(budgetFor(limits, SIZE_MAX, 0).megabytes, 8192);
    EXPECT_EQ(budgetFor(limits, 0, SIZE_MAX).seconds, 3600);

    limits.imageBytes = 6000 * kMegabyte; // as option --memory sets it
    EXPECT_DOUBLE_EQ(budgetFor(limits, 0, 0).megabytes, start.megabytes + 6000 - 640);
    EXPECT_EQ(budgetFor(limits, SIZE_MAX, 0).megabytes, 12000);
    limits.imageBytes = kMegabyte; // the libraries of a reader need more than such an image
    EXPECT_EQ(budgetFor(limits, 0, 0).megabytes, start.megabytes);

    limits.sandbox.megabytes = 100, limits.sandbox.seconds = 2;
    EXPECT_EQ(budgetFor(limits, SIZE_MAX, SIZE_MAX).megabytes, 100);
    EXPECT_EQ(budgetFor(limits, SIZE_MAX, SIZE_MAX).seconds, 2);
}

// Received bytes are refused, or give a scene in which every index is valid and every number finite.
void receive(const Bytes& bytes)
{
    std::size_t at = 0;
    WireIn in = arriving(bytes, at, 4096, 1 << 20);
    Scene scene;
    exchangeScene(in, scene);
    if (!in.good() || !checkScene(scene, "f"))
        return;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes.at(std::size_t(instance.mesh));
        for (const std::uint32_t i : mesh.indices)
            EXPECT_TRUE(std::isfinite(mesh.positions.at(i).x) && std::isfinite(mesh.normals.at(i).z));
    }
}

TEST(Wire, damagedBytesAreRefusedOrGiveValidScenes)
{
    std::mt19937 random(20261122);
    const Bytes whole = bytesOf(everything());
    for (int round = 0; round < 3000; ++round) {
        Bytes bytes = whole;
        for (unsigned n = 1 + random() % 4; n > 0; --n) {
            const std::size_t at = random() % bytes.size();
            switch (random() % 4) {
            case 0: bytes[at] = std::byte(random()); break;
            case 1: bytes[at] ^= std::byte(1u << random() % 8); break;
            case 2: bytes.resize(std::max<std::size_t>(at, 1)); break;
            default: bytes.insert(bytes.begin() + std::ptrdiff_t(at), std::byte(random() % 3)); break;
            }
        }
        receive(bytes);
    }
    for (int round = 0; round < 1000; ++round) {
        Bytes bytes(random() % 400);
        for (std::byte& b : bytes)
            b = std::byte(random() % 3 ? 0 : random()); // zeros make small counts frequent
        receive(bytes);
    }
}

} // namespace
} // namespace cotan
