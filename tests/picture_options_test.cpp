// Words of `render` and `compare` as sizes, cameras and views; both sides of every limit.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "bake/report_words.hpp"
#include "common.hpp"
#include "cotan/picture.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "parse.hpp"
#include "picture.hpp"

namespace cotan::app {
namespace {

TEST(PictureWords, sizesReachFromOneTo16384OnEachSide)
{
    EXPECT_EQ(*parseSize("1x16384"), std::pair(1, 16384));
    EXPECT_EQ(*parseSize("16384x1"), std::pair(16384, 1));
    EXPECT_EQ(*parseSize("512"), std::pair(512, 512));
    for (const char* wrong : {"0x5", "5x0", "16385x5", "5x16385", "-1x5", "0", "16385", "", "5x", "x5", "5x5x5",
                              "5.5x5", " 5x5", "99999999999x5"})
        EXPECT_FALSE(parseSize(wrong)) << wrong;
}

TEST(PictureWords, picturesHaveSizesByNameAndMapsDoNot)
{
    EXPECT_EQ(*parsePictureSize("1080p"), std::pair(1920, 1080));
    EXPECT_EQ(*parsePictureSize("square"), std::pair(1024, 1024));
    EXPECT_EQ(*parsePictureSize("640x480"), std::pair(640, 480));
    EXPECT_FALSE(parsePictureSize("1080q"));
    EXPECT_FALSE(parseSize("1080p"));
    for (const std::string& word : sizePresetWords())
        EXPECT_TRUE(parsePictureSize(word)) << word;
}

TEST(PictureWords, camerasHaveTheNamesOfSides)
{
    const Scene scene = builtinScene();
    const auto from = [&](const char* words) {
        const auto camera = cameraFromWords(words, scene, 10, 10);
        return camera ? glm::normalize(camera->eye - camera->target) : glm::vec3(0);
    };
    EXPECT_LT(glm::distance(from("left"), {-1, 0, 0}), 1e-5f);
    EXPECT_LT(glm::distance(from("right"), {1, 0, 0}), 1e-5f);
    EXPECT_LT(glm::distance(from("top"), {0, 1, 0}), 1e-5f);
    EXPECT_LT(glm::distance(from("bottom"), {0, -1, 0}), 1e-5f);
    EXPECT_LT(glm::distance(from("back"), {0, 0, -1}), 1e-5f);
    EXPECT_LT(glm::distance(from("orbit:-90,0"), from("left")), 1e-5f);
    for (const char* wrong :
         {"Left", "orbit", "orbit:", "orbit:1", "orbit:1,2,3", "orbit:1,nan", "orbit:1,90.1", "side"})
        EXPECT_FALSE(cameraFromWords(wrong, scene, 10, 10)) << wrong;
}

TEST(PictureWords, camerasAreNumberedFromNoughtToTheLast)
{
    Scene scene = builtinScene();
    scene.cameras.resize(2);
    scene.cameras[0].eye = {1, 2, 3};
    scene.cameras[1].eye = {4, 5, 6};
    EXPECT_EQ(cameraFromWords("0", scene, 10, 10)->eye, glm::vec3(1, 2, 3));
    EXPECT_EQ(cameraFromWords("1", scene, 10, 10)->eye, glm::vec3(4, 5, 6));
    EXPECT_FALSE(cameraFromWords("2", scene, 10, 10));
    EXPECT_FALSE(cameraFromWords("-1", scene, 10, 10));
}

TEST(PictureWords, aCameraLooksFromAndToWithAnUpThatIsNotItsDirection)
{
    const Scene scene;
    const auto level = cameraFromWords("1,2,3,4,2,8", scene, 10, 10);
    EXPECT_EQ(level->eye, glm::vec3(1, 2, 3));
    EXPECT_EQ(level->target, glm::vec3(4, 2, 8));
    EXPECT_EQ(level->up, glm::vec3(0, 1, 0));
    for (const char* straight : {"0,5,0,0,-1,0", "0,-5,0,0,1,0"})
        EXPECT_GT(glm::length(glm::cross(cameraFromWords(straight, scene, 10, 10)->up, glm::vec3(0, 1, 0))), 0.5f)
            << straight;
    EXPECT_FALSE(cameraFromWords("1,2,3,1,2,3", scene, 10, 10)); // nowhere to look
    EXPECT_FALSE(cameraFromWords("1,2,3,4,5", scene, 10, 10));
    EXPECT_FALSE(cameraFromWords("1,2,3,4,5,nan", scene, 10, 10));
}

CommonOptions quiet()
{
    CommonOptions common;
    common.quiet = true;
    return common;
}

TEST(PictureWords, rowsRunTheWayThatWasAskedFor)
{
    PictureOptions options;
    EXPECT_FALSE(loadPicture(options, quiet(), {Frame::cotangent})->view.rowsUpward);
    options.rows = "up";
    EXPECT_TRUE(loadPicture(options, quiet(), {Frame::cotangent})->view.rowsUpward);
}

TEST(PictureWords, lightsOfTheSceneAreTakenWhereItHasSome)
{
    const auto picture = loadPicture({}, quiet(), {Frame::cotangent});
    ASSERT_TRUE(picture);
    ASSERT_FALSE(picture->scene.lights.empty());
    ASSERT_EQ(picture->view.lights.size(), picture->scene.lights.size());
    for (std::size_t i = 0; i < picture->view.lights.size(); ++i) {
        EXPECT_EQ(picture->view.lights[i].direction, picture->scene.lights[i].direction);
        EXPECT_EQ(picture->view.lights[i].intensity, picture->scene.lights[i].intensity);
    }
}

TEST(PictureWords, picturesAreOfAStudioUnlessTheyAreToldOtherwise)
{
    PictureOptions options;
    const auto picture = loadPicture(options, quiet(), {Frame::cotangent});
    ASSERT_TRUE(picture);
    EXPECT_TRUE(picture->view.environmentMap && picture->meter);
    EXPECT_EQ(picture->view.backdrop, Backdrop::paper);
    EXPECT_EQ(picture->view.toneMapping, ToneMapping::neutral);
    EXPECT_NEAR(picture->view.shadowSoftness, 0.0875f, 1e-4f); // tan 5 degrees

    options.environment = "overcast";
    EXPECT_EQ(loadPicture(options, quiet(), {Frame::cotangent})->view.backdrop, Backdrop::blurred);

    // A sky in clouds casts no shadow; a low sun casts a long one, with edges.
    Scene ball;
    EXPECT_TRUE(lightsOf(options, ball).empty());
    options.environment = "evening";
    const auto sun = lightsOf(options, ball);
    ASSERT_EQ(sun.size(), 1u);
    EXPECT_GT(-sun[0].direction.y, 0.174f); // 10 degrees: lower lamps throw none on the ground
    EXPECT_LT(-sun[0].direction.y, 0.5f);
    PictureOptions turned = options;
    turned.environmentRotation = 90; // counter-clockwise from above: z becomes x
    EXPECT_NEAR(lightsOf(turned, ball)[0].direction.x, sun[0].direction.z, 1e-6f);
    EXPECT_NEAR(loadPicture(options, quiet(), {Frame::cotangent})->view.shadowSoftness, 0.0262f, 1e-4f); // 1.5 degrees

    options.environment = "none";
    options.exposure = "1.5";
    options.shadowSoftness = 0;
    const auto plain = loadPicture(options, quiet(), {Frame::cotangent});
    ASSERT_TRUE(plain);
    EXPECT_FALSE(plain->view.environmentMap || plain->meter);
    EXPECT_EQ(plain->view.backdrop, Backdrop::gradient);
    EXPECT_EQ(plain->view.exposure, 1.5f);
    EXPECT_EQ(plain->view.shadowSoftness, 0);

    // What shows no light is spared making it.
    PictureOptions normals;
    normals.use = PictureUse::data;
    const auto data = loadPicture(normals, quiet(), {Frame::cotangent});
    ASSERT_TRUE(data);
    EXPECT_FALSE(data->view.environmentMap || data->meter);
}

TEST(PictureWords, exposureIsAutoOrAPositiveNumber)
{
    for (const auto& [text, good] : {std::pair("0.001", true),
                                     {"auto", true},
                                     {"automatic", false},
                                     {"1e6", true},
                                     {"0", false},
                                     {"-1", false},
                                     {"nan", false},
                                     {"1e7", false},
                                     {"2x", false}}) {
        Arguments tool("tool", "", "");
        PictureOptions options;
        addPictureOptions(tool, options);
        tool.does([] { return Done{}; });
        const Status done = tool.run({"--exposure", text}, {});
        EXPECT_EQ(bool(done), good) << text;
        EXPECT_TRUE(done || done.error().kind == ErrorKind::usage) << text;
    }
}

TEST(Counted, oneIsOneAndAllElseAreMany)
{
    EXPECT_EQ(counted(1, "map"), "1 map");
    EXPECT_EQ(counted(0, "map"), "0 maps");
    EXPECT_EQ(counted(2, "map"), "2 maps");
}

} // namespace
} // namespace cotan::app
