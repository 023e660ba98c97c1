// A model at a time of an animation, compared with the formulas of glTF 2.0, section 3.11 and appendix C.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "cotan/gltf.hpp"
#include "gltf_maker.hpp"

namespace {

using namespace cotan;
using namespace cotan::test;

struct Track {
    std::string path;
    std::vector<float> times, values;
    std::string type;
    std::string interpolation = "LINEAR";
};

// The square, whose node is animated by the tracks.
Gltf animated(const std::vector<Track>& tracks)
{
    Gltf g = square();
    json animation = {{"name", "go"}, {"channels", json::array()}, {"samplers", json::array()}};
    for (const Track& t : tracks) {
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size()}, {"target", {{"node", 0}, {"path", t.path}}}});
        animation["samplers"].push_back({{"input", g.floats(t.times, "SCALAR")},
                                         {"output", g.floats(t.values, t.type)},
                                         {"interpolation", t.interpolation}});
    }
    g.add("animations", {{"name", "rest"}, {"channels", json::array()}, {"samplers", json::array()}});
    g.add("animations", animation);
    return g;
}

LoadLimits at(double seconds, const std::string& animation = "go")
{
    LoadLimits limits;
    limits.pose = {animation, seconds};
    return limits;
}

// Where the node moves a point at a time.
glm::vec3 movedPoint(const Gltf& g, double seconds, glm::vec3 p = glm::vec3(0))
{
    const auto scene = g.load(at(seconds));
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    return scene ? glm::vec3(scene->instances[0].toWorld * glm::vec4(p, 1)) : glm::vec3(NAN);
}

TEST(GltfAnimation, interpolatesLinearlyAndClampsAtTheEnds)
{
    const Gltf g = animated({{"translation", {1, 3}, {0, 0, 0, 4, 8, -2}, "VEC3"}});
    expectNear(movedPoint(g, 0), {0, 0, 0});
    expectNear(movedPoint(g, 1), {0, 0, 0});
    expectNear(movedPoint(g, 1.5), {1, 2, -0.5f});
    expectNear(movedPoint(g, 3), {4, 8, -2});
    expectNear(movedPoint(g, 100), {4, 8, -2});
    const auto rest = g.load(); // the pose stored in the file
    ASSERT_TRUE(rest);
    expectNear(glm::vec3(rest->instances[0].toWorld[3]), {0, 0, 0});
}

TEST(GltfAnimation, stepsAtKeys)
{
    const Gltf g = animated({{"translation", {0, 1, 2}, {1, 0, 0, 2, 0, 0, 3, 0, 0}, "VEC3", "STEP"}});
    expectNear(movedPoint(g, 0.99), {1, 0, 0});
    expectNear(movedPoint(g, 1), {2, 0, 0});
    expectNear(movedPoint(g, 1.99), {2, 0, 0});
}

// The spline through values and slopes of a cubic at two keys is that cubic: x = s^3 - 2s + 1, its derivative 3s^2 - 2.
TEST(GltfAnimation, splineIsTheCubicWithItsSlopes)
{
    const auto x = [](float s) { return s * s * s - 2 * s + 1; };
    const auto slope = [](float s) { return 3 * s * s - 2; };
    std::vector<float> values;
    for (const float s : {0.5f, 2.5f})
        for (const float part : {slope(s), x(s), slope(s)}) // in-tangent, value, out-tangent
            values.insert(values.end(), {part, 2 * part, 0});
    // Slopes into the first key and out of the last must be ignored.
    values[0] = values[15] = 77;
    const Gltf g = animated({{"translation", {0.5f, 2.5f}, values, "VEC3", "CUBICSPLINE"}});
    for (const float s : {0.5f, 0.9f, 1.5f, 2.2f, 2.5f})
        EXPECT_LT(glm::length(movedPoint(g, double(s)) - glm::vec3(x(s), 2 * x(s), 0)), 1e-5f) << s;
}

TEST(GltfAnimation, rotatesEvenlyAlongTheShorterArc)
{
    // From 0 to 90 degrees about z; the second quaternion is negated, which is the same rotation.
    const float half = std::numbers::sqrt2_v<float> / 2;
    for (const float sign : {1.0f, -1.0f}) {
        const Gltf g = animated({{"rotation", {0, 3}, {0, 0, 0, 1, 0, 0, sign * half, sign * half}, "VEC4"}});
        for (const double part : {0.0, 1.0 / 3, 0.5, 1.0}) {
            const float angle = float(part * std::numbers::pi / 2);
            expectNear(movedPoint(g, 3 * part, {1, 0, 0}), {std::cos(angle), std::sin(angle), 0});
        }
    }
}

TEST(GltfAnimation, readsRotationsOfIntegers)
{
    Gltf g = animated({{"rotation", {0}, {0, 0, 0, 1}, "VEC4"}});
    const int half = g.accessor(std::vector<std::int16_t>{0, 0, 23170, 23170}, "VEC4", kShort, true);
    g.root["animations"][1]["samplers"][0]["output"] = half;
    EXPECT_LT(glm::length(movedPoint(g, 0, {1, 0, 0}) - glm::vec3(0, 1, 0)), 1e-4f); // 15 bits
    g.root["accessors"][std::size_t(half)]["normalized"] = false;
    COTAN_REFUSED(g.load(at(0)), "expected floats or normalized integers");
}

TEST(GltfAnimation, combinesTheChannelsOfANode)
{
    const float half = std::numbers::sqrt2_v<float> / 2;
    const Gltf g = animated({{"translation", {0}, {5, 6, 7}, "VEC3"},
                             {"rotation", {0}, {0, 0, half, half}, "VEC4"},
                             {"scale", {0}, {2, 3, 4}, "VEC3"}});
    expectNear(movedPoint(g, 0, {1, 1, 1}), {5 - 3, 6 + 2, 7 + 4}); // scaled, rotated by 90 degrees, moved
}

TEST(GltfAnimation, morphsByTheWeightsAtEachTime)
{
    const auto withTargets = [](Gltf g) {
        const int up = g.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        const int aside = g.floats({2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3");
        primitive(g)["targets"] = {{{"POSITION", up}}, {{"POSITION", aside}}};
        return g;
    };
    const Gltf g = withTargets(animated({{"weights", {0, 2}, {0, 1, 1, 0.5f}, "SCALAR"}}));
    const auto scene = g.load(at(0.5)); // 0.25 of the first target, 0.875 of the second
    ASSERT_TRUE(scene) << scene.error().message;
    for (std::size_t v = 0; v < 4; ++v)
        expectNear(scene->meshes[0].positions[v],
                   glm::vec3(kSquare[3 * v], kSquare[3 * v + 1], kSquare[3 * v + 2]) + glm::vec3(1.75f, 0, 0.25f));
    COTAN_REFUSED(withTargets(animated({{"weights", {0, 2}, {0, 1, 1}, "SCALAR"}})).load(at(0)), "4 elements, found 3");
}

// Two joints: the second rotates by 90 degrees about x; half of the vertices and their normals follow it.
TEST(GltfAnimation, skinsFollowTheirJoints)
{
    const float half = std::numbers::sqrt2_v<float> / 2;
    Gltf g = square();
    primitive(g)["attributes"]["JOINTS_0"] =
        g.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", kUByte);
    primitive(g)["attributes"]["WEIGHTS_0"] = g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    g.add("skins", {{"joints", {1, 2}}});
    g.root["nodes"][0]["skin"] = 0;
    g.add("nodes", json::object());
    g.add("nodes", json::object());
    g.root["scenes"][0]["nodes"] = {0, 1, 2};
    g.add("animations",
          {{"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}}},
           {"samplers", {{{"input", g.floats({0}, "SCALAR")}, {"output", g.floats({half, 0, 0, half}, "VEC4")}}}}});
    const auto scene = g.load(at(0, "0"));
    ASSERT_TRUE(scene) << scene.error().message;
    const Mesh& mesh = scene->meshes[0];
    expectNear(mesh.positions[0], {0, 0, 0});
    expectNear(mesh.positions[1], {1, 0, 0});
    expectNear(mesh.positions[2], {1, 0, 1}); // y is rotated to z
    expectNear(mesh.normals[3], {0, 0, 1});
    expectNear(mesh.normals[2], {0, -1, 0});
}

TEST(GltfAnimation, isFoundByNameOrNumber)
{
    const Gltf g = animated({{"translation", {0}, {1, 2, 3}, "VEC3"}});
    for (const char* const word : {"go", "1"}) {
        const auto scene = g.load(at(0, word));
        ASSERT_TRUE(scene) << scene.error().message;
        expectNear(glm::vec3(scene->instances[0].toWorld[3]), {1, 2, 3});
    }
    for (const char* const word : {"2", "-1", "Go"}) {
        const auto none = g.load(at(0, word));
        ASSERT_FALSE(none) << word;
        EXPECT_EQ(none.error().kind, ErrorKind::usage);
        EXPECT_NE(none.error().message.find("expected one of its 2 animations by number or name (rest, go)"),
                  std::string::npos)
            << none.error().message;
    }
    const auto still = square().load(at(0));
    ASSERT_FALSE(still);
    EXPECT_NE(still.error().message.find("found none"), std::string::npos);
}

TEST(GltfAnimation, damageIsOneLineOnlyIfTheAnimationIsRequested)
{
    const std::tuple<std::string, json, const char*> cases[] = {
        {"/channels/0/sampler", 1, "channels[0].sampler: expected an index below 1"},
        {"/channels/0/target/node", 9, "target.node: expected an index below 1"},
        {"/channels/0/target/path", 3, "target.path: expected a string"},
        {"/samplers/0/input", 99, "samplers[0].input: expected an index below"},
        {"/samplers/0/input", 0, "expected floats in accessors[0] for the key times"},
        {"/samplers/0/output", 0, "expected accessors[0] with 2 elements"},
        {"/samplers/0/interpolation", "FAST", "expected one of LINEAR, STEP, CUBICSPLINE"},
        {"/samplers/0/interpolation", "CUBICSPLINE", "with 6 elements, found 2"},
        {"/channels", 3, "channels: expected an array"},
    };
    const Gltf good = animated({{"translation", {0, 1}, {1, 2, 3, 4, 5, 6}, "VEC3"}});
    ASSERT_TRUE(good.load(at(0)));
    for (const auto& [where, value, word] : cases) {
        Gltf g = good;
        g.root["animations"][1][json::json_pointer(where)] = value;
        COTAN_REFUSED(g.load(at(0)), word);
        EXPECT_TRUE(g.load()) << where;
    }
    Gltf unnamed = good; // names are searched before they are checked
    unnamed.root["animations"][1]["name"] = 5;
    COTAN_REFUSED(unnamed.load(at(0, "1")), "animations[1].name: expected a string");
    const auto unknown = unnamed.load(at(0, "go"));
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("expected one of its 2 animations"), std::string::npos)
        << unknown.error().message;
    EXPECT_TRUE(unnamed.load());
    COTAN_REFUSED(animated({{"translation", {1, 1}, {1, 2, 3, 4, 5, 6}, "VEC3"}}).load(at(0)), "expected ascending");
    Gltf fixed = good;
    fixed.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    COTAN_REFUSED(fixed.load(at(0)), "has a matrix");
    Gltf pointer = good;
    pointer.root["animations"][1]["channels"][0]["target"]["path"] = "pointer";
    const auto scene = pointer.load(at(0));
    ASSERT_TRUE(scene);
    EXPECT_TRUE(warns(*scene, "animation of the path \"pointer\" is not supported"));
}

// ---- one file, many times -----------------------------------------------------------------------

// Opens the file for reading at many times.
std::unique_ptr<AnimatedGltf> opened(const Gltf& g, const LoadLimits& limits = {})
{
    TemporaryFolder folder;
    auto model = AnimatedGltf::open(folder.write("model.gltf", g.text()), limits);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? std::move(*model) : nullptr; // the file is deleted by now
}

TEST(AnimatedGltf, equalsALoadOfTheFileAtEachTime)
{
    const Gltf g = animated({{"translation", {1, 3}, {0, 0, 0, 4, 8, -2}, "VEC3"}});
    const auto model = opened(g);
    ASSERT_TRUE(model);
    for (const double seconds : {2.0, 0.0, 1.5, 1e9, 1.0}) {
        const auto scene = model->at({"go", seconds});
        ASSERT_TRUE(scene) << scene.error().message;
        const auto read = g.load(at(seconds));
        ASSERT_TRUE(read);
        EXPECT_EQ(scene->instances[0].toWorld, read->instances[0].toWorld) << seconds;
        EXPECT_EQ(scene->meshes[0].positions, read->meshes[0].positions);
        EXPECT_EQ(scene->warnings, read->warnings);
    }
    const auto rest = model->at({});
    ASSERT_TRUE(rest);
    expectNear(glm::vec3(rest->instances[0].toWorld[3]), {0, 0, 0}); // unaffected by the previous times
    const auto unknown = model->at({"fly", 0});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::usage);
    EXPECT_TRUE(model->at({"go", 2}));
}

TEST(AnimatedGltf, lengthIsTheTimeOfTheLastKey)
{
    Gltf g = animated(
        {{"translation", {0, 1.5f}, {0, 0, 0, 1, 0, 0}, "VEC3"}, {"scale", {0.5f, 2.25f}, {1, 1, 1, 2, 2, 2}, "VEC3"}});
    const auto model = opened(g);
    ASSERT_TRUE(model);
    ASSERT_EQ(model->animations().size(), 2u);
    EXPECT_EQ(model->animations()[0].name, "rest");
    EXPECT_EQ(model->animations()[0].seconds, 0);
    EXPECT_EQ(model->animations()[1].name, "go");
    EXPECT_EQ(model->animations()[1].seconds, 2.25);
    g.root["animations"][1]["samplers"][0]["input"] = "damaged"; // reported when it is requested, not before
    const auto damaged = opened(g);
    ASSERT_TRUE(damaged);
    EXPECT_EQ(damaged->animations()[1].seconds, 0);
    EXPECT_TRUE(damaged->at({}));
    EXPECT_FALSE(damaged->at({"go", 0}));
}

// The length is read before any time is requested; it is 0 if the keys are not times.
TEST(AnimatedGltf, lengthIsZeroIfTheKeysAreNotTimes)
{
    const Gltf good = animated({{"translation", {0, 2}, {0, 0, 0, 1, 0, 0}, "VEC3"}});
    const auto secondsWith = [&](const auto& input) {
        Gltf g = good;
        g.root["animations"][1]["samplers"][0]["input"] = input(g);
        const auto model = opened(g);
        EXPECT_TRUE(model);
        EXPECT_FALSE(model->at({"go", 0}));
        return model->animations().at(1).seconds;
    };
    EXPECT_EQ(opened(good)->animations().at(1).seconds, 2);
    EXPECT_EQ(secondsWith([](Gltf& g) { return g.floats({0, 0, 0, 5, 6, 7}, "VEC3"); }), 0);
    EXPECT_EQ(secondsWith([](Gltf& g) { return g.floats({0, 0, 5, 6}, "VEC2"); }), 0);
    EXPECT_EQ(secondsWith([](Gltf& g) { return g.accessor(std::vector<std::uint16_t>{0, 9}, "SCALAR", kUShort); }), 0);
    EXPECT_EQ(secondsWith([](Gltf& g) { return g.accessor(std::vector<std::uint8_t>{0, 9}, "SCALAR", kUByte); }), 0);
}

TEST(AnimatedGltf, decodesItsImagesOnce)
{
    Gltf g = animated({{"translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3"}});
    addNormalMap(g);
    int decoded = 0;
    LoadLimits limits;
    limits.decode = [&](std::span<const std::byte>, const std::string& name) -> Result<Image> {
        ++decoded;
        Image made = makeImage(2, 2, PixelType::unorm8, name);
        made.data[0] = std::byte(77);
        return made;
    };
    const auto model = opened(g, limits);
    ASSERT_TRUE(model);
    const auto first = model->at({"go", 0});
    ASSERT_TRUE(first) << first.error().message;
    ASSERT_EQ(first->images.size(), 1u);
    EXPECT_EQ(decoded, 1);
    const auto second = model->at({"go", 0.5}, &first->images);
    ASSERT_TRUE(second);
    EXPECT_EQ(decoded, 1);
    ASSERT_EQ(second->images.size(), 1u);
    EXPECT_EQ(second->images[0].data, first->images[0].data);
}

} // namespace
