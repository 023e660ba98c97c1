// Animations of glTF beyond gltf_animation_test.cpp: channels without effect, several weights on splines, rotations of
// other than unit length, errors about damage, and repeated use of one opened model.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>

#include "cotan/gltf.hpp"
#include "gltf_maker.hpp"

namespace {

using namespace cotan::test;
using cotan::AnimatedGltf;
using cotan::LoadLimits;
using cotan::Result;
using cotan::Scene;

struct Channel {
    std::string path;
    std::vector<float> times, values;
    std::string type, interpolation = "LINEAR";
    int node = 0; // -1: no node
};

// The square and a node without a mesh. Animation 0, "still", has no channels; animation 1, "act", has these.
Gltf acting(const std::vector<Channel>& channels)
{
    Gltf g = square();
    g.add("nodes", {{"name", "bare"}});
    json act = {{"name", "act"}, {"channels", json::array()}, {"samplers", json::array()}};
    for (const Channel& c : channels) {
        json target = {{"path", c.path}};
        if (c.node >= 0)
            target["node"] = c.node;
        act["channels"].push_back({{"sampler", act["samplers"].size()}, {"target", target}});
        const int input = g.floats(c.times, "SCALAR");
        act["samplers"].push_back(
            {{"input", input}, {"output", g.floats(c.values, c.type)}, {"interpolation", c.interpolation}});
    }
    g.add("animations", {{"name", "still"}, {"channels", json::array()}, {"samplers", json::array()}});
    g.add("animations", act);
    return g;
}

Result<Scene> acted(const Gltf& g, double seconds, LoadLimits limits = {})
{
    limits.pose = {"act", seconds};
    return g.load(limits);
}

std::unique_ptr<AnimatedGltf> openedOnce(const Gltf& g, const LoadLimits& limits = {})
{
    const TemporaryFolder folder;
    auto model = AnimatedGltf::open(folder.write("model.gltf", g.text()), limits);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? std::move(*model) : nullptr;
}

constexpr float kHalf = std::numbers::sqrt2_v<float> / 2; // sine and cosine of half of 90 degrees

TEST(GltfPose, aChannelWithoutANodeIsIgnored)
{
    const Gltf g = acting({{"translation", {0}, {9, 9, 9}, "VEC3", "LINEAR", -1},
                           {"translation", {0}, {1, 2, 3}, "VEC3"},
                           {"pointer", {0}, {7, 7, 7}, "VEC3"}});
    COTAN_LOADED(scene, acted(g, 0));
    EXPECT_EQ(scene.instances.at(0).toWorld[3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(
        scene.warnings,
        std::vector<std::string>{"animations[1].channels[2]: animation of the path \"pointer\" is not supported"});
}

// A key stores all in-tangents, then all values, then all out-tangents (glTF 2.0, appendix C.5).
TEST(GltfPose, weightsOfSeveralTargetsFollowTheirOwnSplines)
{
    const auto first = [](float s) { return s * s * s - 2 * s + 1; };
    const auto second = [](float s) { return 2 * s * s - s; };
    std::vector<float> values;
    for (const float s : {0.5f, 2.5f}) {
        const float slopes[] = {3 * s * s - 2, 4 * s - 1};
        values.insert(values.end(), {slopes[0], slopes[1], first(s), second(s), slopes[0], slopes[1]});
    }
    for (const char* const interpolation : {"CUBICSPLINE", "STEP"}) {
        const bool step = interpolation == std::string("STEP");
        const std::vector<float> stepped = {first(0.5f), second(0.5f), first(2.5f), second(2.5f)};
        Gltf g = acting({{"weights", {0.5f, 2.5f}, step ? stepped : values, "SCALAR", interpolation}});
        const int up = g.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        const int aside = g.floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
        primitive(g)["targets"] = {{{"POSITION", up}}, {{"POSITION", aside}}};
        for (const float s : {0.25f, 0.5f, 0.75f, 1.5f, 2.25f, 2.5f, 3.0f}) {
            COTAN_LOADED(scene, acted(g, double(s)));
            const float at = step ? (s < 2.5f ? 0.5f : 2.5f) : std::clamp(s, 0.5f, 2.5f);
            const glm::vec3 expected = glm::vec3(1, 1, 0) + glm::vec3(second(at), 0, first(at));
            EXPECT_LT(glm::distance(scene.meshes.at(0).positions[2], expected), 1e-4f) << interpolation << s;
        }
    }
    COTAN_REFUSED(acted(acting({{"weights", {0}, {1}, "SCALAR", "LINEAR", 1}}), 0),
                  "animations[1].channels[0]: expected accessors[5] with 0 elements, found 1");
}

// A spline of quaternions leaves the unit sphere between its keys and is normalised without a warning, as appendix C.5
// requires. Keys of other lengths are normalised, too.
TEST(GltfPose, rotationsBetweenKeysAreUnit)
{
    const std::vector<float> none(4, 0.0f);
    std::vector<float> values;
    for (const auto& key : {std::vector<float>{0, 0, 0, 1}, std::vector<float>{0, 0, kHalf, kHalf}}) {
        values.insert(values.end(), none.begin(), none.end());
        values.insert(values.end(), key.begin(), key.end());
        values.insert(values.end(), none.begin(), none.end());
    }
    const auto rotationAngle = [](const Scene& scene) {
        const glm::vec4 x = scene.instances.at(0).toWorld * glm::vec4(1, 0, 0, 0);
        EXPECT_NEAR(glm::length(x), 1, 1e-6);
        return std::atan2(double(x.y), double(x.x));
    };
    const Gltf spline = acting({{"rotation", {0, 2}, values, "VEC4", "CUBICSPLINE"}});
    for (const double part : {0.25, 0.5, 0.75}) {
        COTAN_LOADED(scene, acted(spline, 2 * part));
        const double h = 3 * part * part - 2 * part * part * part, s = std::sqrt(0.5);
        EXPECT_NEAR(rotationAngle(scene), 2 * std::atan2(h * s, 1 - h + h * s), 1e-6) << part;
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    }
    const Gltf longer = acting({{"rotation", {0, 3}, {0, 0, 0, 2, 0, 0, 3 * kHalf, 3 * kHalf}, "VEC4"}});
    for (const double part : {1.0 / 3, 0.5, 0.9}) {
        COTAN_LOADED(scene, acted(longer, 3 * part));
        EXPECT_NEAR(rotationAngle(scene), part * std::numbers::pi / 2, 1e-6) << part;
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    }
    // A spline of zeros does not rotate.
    COTAN_LOADED(zero, acted(acting({{"rotation", {0, 2}, std::vector<float>(24, 0.0f), "VEC4", "CUBICSPLINE"}}), 1));
    EXPECT_EQ(zero.instances.at(0).toWorld, glm::mat4(1));
}

TEST(GltfPose, errorsNameTheDamagedChannel)
{
    // The second channel uses accessors 6 and 7; cases add accessor 8.
    const Gltf good = acting({{"scale", {0, 1}, {1, 1, 1, 2, 2, 2}, "VEC3"},
                              {"translation", {0, 1, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9}, "VEC3"}});
    ASSERT_TRUE(acted(good, 1.5));
    const auto errorOf = [&](const auto& damage) {
        Gltf g = good;
        damage(g, g.root["animations"][1]["channels"][1], g.root["animations"][1]["samplers"][1]);
        const auto scene = acted(g, 1.5);
        const std::string message = scene ? "" : scene.error().message;
        return message.substr(std::min(message.size(), message.find("model.gltf: ") + 12));
    };
    const std::string at = "animations[1].channels[1]";
    EXPECT_EQ(errorOf([](Gltf&, json& channel, json&) { channel["sampler"] = 2; }),
              at + ".sampler: expected an index below 2, the number of samplers, found 2");
    EXPECT_EQ(errorOf([](Gltf& g, json&, json& s) {
                  s["input"] = g.floats({0, 2, 1}, "SCALAR");
              }),
              at + ": expected ascending times in accessors[8], found 1 after 2");
    EXPECT_EQ(errorOf([](Gltf& g, json&, json& s) {
                  s["input"] = g.floats({0, 3, 3}, "SCALAR");
              }),
              at + ": expected ascending times in accessors[8], found 3 after 3");
    const std::string times = at + ": expected floats in accessors[8] for the key times";
    EXPECT_EQ(errorOf([](Gltf& g, json&, json& s) { s["input"] = g.floats({0, 0, 1, 1, 2, 2}, "VEC2"); }), times);
    EXPECT_EQ(errorOf([](Gltf& g, json&, json& s) {
                  s["input"] = g.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", kUShort);
              }),
              times);
    EXPECT_EQ(errorOf([](Gltf& g, json&, json& s) { s["output"] = g.floats(std::vector<float>(12, 0.0f), "VEC4"); }),
              at + ": expected accessors[8] of type VEC3, found VEC4");
    EXPECT_EQ(errorOf([](Gltf& g, json&, json& s) { s["output"] = g.floats(std::vector<float>(12, 0.0f), "VEC3"); }),
              at + ": expected accessors[8] with 3 elements, found 4");
    const auto whole = [](auto number, int type, bool normalized) {
        return [=](Gltf& g, json&, json& s) {
            s["output"] = g.accessor(std::vector<decltype(number)>(9, number), "VEC3", type, normalized);
        };
    };
    const std::string numbers = at + ": expected floats or normalized integers in accessors[8], found ";
    EXPECT_EQ(errorOf(whole(std::int16_t(1), kShort, true)), "");
    EXPECT_EQ(errorOf(whole(1.0f, kFloat, true)), "");
    EXPECT_EQ(errorOf(whole(std::int16_t(1), kShort, false)), numbers + "signed shorts");
    EXPECT_EQ(errorOf(whole(std::uint8_t(1), kUByte, false)), numbers + "bytes");
    EXPECT_EQ(errorOf(whole(std::uint32_t(1), kUInt, true)), numbers + "unsigned integers");
    EXPECT_EQ(errorOf([](Gltf& g, json&, json&) { g.root["nodes"][0]["matrix"] = json(std::vector<float>(16, 0.0f)); }),
              "animations[1].channels[0].target: the node has a matrix, which cannot be animated");
}

TEST(GltfPose, lengthIsThatOfTheLongestSampler)
{
    const auto seconds = [](const std::vector<Channel>& channels) {
        return openedOnce(acting(channels))->animations().at(1).seconds;
    };
    const Channel longer = {"translation", {0, 2.25f}, {0, 0, 0, 1, 0, 0}, "VEC3"};
    const Channel shorter = {"scale", {0.5f, 1.5f}, {1, 1, 1, 2, 2, 2}, "VEC3"};
    EXPECT_EQ(seconds({longer, shorter}), 2.25);
    EXPECT_EQ(seconds({shorter, longer}), 2.25);
    EXPECT_EQ(seconds({{"translation", {-3, -1}, {0, 0, 0, 1, 0, 0}, "VEC3"}}), 0);
}

// ---- one model, many times ------------------------------------------------------------------

// Counts for limits, and warnings, start anew at each time.
TEST(AnimatedGltf, timesDoNotAffectEachOther)
{
    Gltf g = acting({{"translation", {0, 1}, {0, 0, 0, 4, 8, -2}, "VEC3"}});
    g.add("nodes", {{"mesh", 0}, {"scale", {1, 0, 1}}});
    g.root["scenes"][0]["nodes"] = {0, 2};
    LoadLimits limits;
    limits.vertices = 4;
    limits.triangles = 2;
    limits.geometryBytes = 0;            // plus 16 times the file, about 40 times the need
    limits.pose = {"nothing of it", 77}; // the pose when opening is ignored
    const auto model = openedOnce(g, limits);
    ASSERT_TRUE(model);
    for (int i = 0; i < 300; ++i) {
        const auto scene = model->at({"act", i % 2 == 0 ? 0.5 : 0.25});
        ASSERT_TRUE(scene) << i << scene.error().message;
        EXPECT_EQ(scene->instances.at(0).toWorld[3],
                  glm::vec4(i % 2 == 0 ? 2 : 1, i % 2 == 0 ? 4 : 2, i % 2 == 0 ? -1 : -0.5f, 1));
        EXPECT_EQ(scene->warnings, std::vector<std::string>{"nodes[2]: its transform is singular (a scale of zero)"});
        EXPECT_EQ(scene->name, "model");
    }
    const auto rest = model->at({});
    ASSERT_TRUE(rest);
    EXPECT_EQ(rest->instances.at(0).toWorld, glm::mat4(1));
}

TEST(AnimatedGltf, usesGivenImagesIfTheirNumberMatches)
{
    Gltf g = acting({{"translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3"}});
    addNormalMap(g);
    const auto model = openedOnce(g);
    ASSERT_TRUE(model);
    const std::vector<cotan::Image> one(1, cotan::makeImage(5, 3, cotan::PixelType::unorm8, "own")), two(2, one[0]),
        none;
    const auto width = [&](const std::vector<cotan::Image>* images) {
        const auto scene = model->at({"act", 0}, images);
        return scene && scene->images.size() == 1 ? scene->images[0].width : 0;
    };
    EXPECT_EQ(width(&one), 5);
    EXPECT_EQ(width(&two), 2); // the file's own
    EXPECT_EQ(width(&none), 2);
    EXPECT_EQ(width(nullptr), 2);
}

// Thirty times per second plus both ends, 256 at most. With few points all are returned; images are not decoded.
TEST(AnimatedGltf, boundsIncludeAllPointsAtEvenlySpacedTimes)
{
    for (const auto& [seconds, moments] : {std::pair{0.5f, 17}, {1.0f, 32}, {8.5f, 256}, {1000.0f, 256}}) {
        Gltf g = acting({{"translation", {0, seconds}, {0, 0, 0, 4, 8, -2}, "VEC3"}});
        addNormalMap(g);
        g.add("nodes", {{"mesh", 0}, {"translation", {0, 0, 50}}}); // with an instance at rest
        g.root["scenes"][0]["nodes"] = {0, 2};
        int decoded = 0;
        LoadLimits limits;
        limits.decode = [&](std::span<const std::byte>, const std::string& name) -> Result<cotan::Image> {
            ++decoded;
            return cotan::makeImage(2, 2, cotan::PixelType::unorm8, name);
        };
        const auto model = openedOnce(g, limits);
        ASSERT_TRUE(model);
        const auto points = model->reach("act");
        ASSERT_TRUE(points) << points.error().message;
        ASSERT_EQ(points->size(), std::size_t(moments * 8)) << seconds;
        for (int i = 0; i < moments; ++i)
            for (std::size_t v = 0; v < 8; ++v) {
                const glm::vec3 corner(kSquare[3 * (v % 4)], kSquare[3 * (v % 4) + 1], 0);
                const glm::vec3 moved = glm::vec3(4, 8, -2) * (float(i) / float(moments - 1));
                EXPECT_LT(
                    glm::distance((*points)[std::size_t(i) * 8 + v], corner + (v < 4 ? moved : glm::vec3(0, 0, 50))),
                    1e-5f)
                    << i << " " << v;
            }
        EXPECT_EQ(*model->reach("1"), *points);   // by its number
        EXPECT_EQ(*model->reach("act"), *points); // already known
        EXPECT_EQ(decoded, 0);
        EXPECT_EQ(model->reach("still")->size(), 8u);
        EXPECT_EQ(model->reach("")->size(), 8u);
        const auto unknown = model->reach("2");
        ASSERT_FALSE(unknown);
        EXPECT_EQ(unknown.error().kind, cotan::ErrorKind::usage);
        EXPECT_EQ(model->at({"act", 0})->images.at(0).width, 2); // images are decoded as before
        EXPECT_EQ(decoded, 1);
    }
}

// Of more than 300,000 points, the extreme ones in directions all around.
TEST(AnimatedGltf, boundsIncludeTheExtremesOfManyPoints)
{
    constexpr int kMoments = 152; // for 5 seconds
    for (const int count : {1971, 1974}) {
        std::vector<float> positions, normals;
        for (int i = 0; i < count; ++i) { // uniformly over a sphere
            const double z = 1 - (i + 0.5) * 2 / count, side = std::sqrt(1 - z * z), angle = i * 2.399963;
            for (const double x : {side * std::cos(angle), side * std::sin(angle), z})
                positions.push_back(float(x)), normals.push_back(float(x));
        }
        Gltf g = acting({{"translation", {0, 5}, {0, 0, 0, 3, -2, 1}, "VEC3"}});
        primitive(g) = {
            {"attributes", {{"POSITION", g.floats(positions, "VEC3")}, {"NORMAL", g.floats(normals, "VEC3")}}}};
        const auto points = openedOnce(g)->reach("act");
        ASSERT_TRUE(points) << points.error().message;
        if (count * kMoments <= 300'000) {
            EXPECT_EQ(points->size(), std::size_t(count * kMoments));
            continue;
        }
        ASSERT_EQ(points->size(), std::size_t(128 * kMoments));
        for (int i = 0; i < kMoments; i += 50) {
            const glm::vec3 centre = glm::vec3(3, -2, 1) * (float(i) / (kMoments - 1));
            std::set<std::pair<float, float>> different;
            std::vector<glm::vec3> around;
            for (std::size_t k = 0; k < 128; ++k) {
                around.push_back((*points)[std::size_t(i) * 128 + k] - centre);
                EXPECT_NEAR(glm::length(around[k]), 1, 1e-5);
                different.emplace(around[k].x, around[k].y);
                if (k % 2 == 1) {
                    EXPECT_LT(glm::dot(around[k - 1], around[k]), -0.98f) << k; // opposite points
                }
            }
            EXPECT_GT(different.size(), 120u);
            for (int d = 0; d < 27; ++d) {
                const glm::vec3 along(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
                float furthest = d == 13 ? 1.0f : 0.0f; // 13 is no direction
                for (const glm::vec3& p : around)
                    furthest = d == 13 ? furthest : std::max(furthest, glm::dot(p, glm::normalize(along)));
                EXPECT_GT(furthest, 0.95f) << d;
            }
        }
    }
}

} // namespace
