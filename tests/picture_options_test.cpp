// Option words of `render` and `compare` for sizes, cameras and views, on both sides of every limit.
#include <gtest/gtest.h>

#include <numbers>

#include <glm/geometric.hpp>

#include "common.hpp"
#include "cotan/picture.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "parse.hpp"
#include "picture.hpp"
#include "picture/option_table.hpp"

namespace cotan::app {
namespace {

TEST(PictureOptionValues, sizesReachFromOneTo16384OnEachSide)
{
    EXPECT_EQ(*parseSize("1x16384"), (PictureSize{1, 16384}));
    EXPECT_EQ(*parseSize("16384x1"), (PictureSize{16384, 1}));
    EXPECT_EQ(*parseSize("512"), (PictureSize{512, 512}));
    for (const char* wrong : {"0x5", "5x0", "16385x5", "5x16385", "-1x5", "0", "16385", "", "5x", "x5", "5x5x5",
                              "5.5x5", " 5x5", "99999999999x5"})
        EXPECT_FALSE(parseSize(wrong)) << wrong;
}

TEST(PictureOptionValues, namedSizesAreForRendersOnly)
{
    EXPECT_EQ(*parsePictureSize("1080p"), (PictureSize{1920, 1080}));
    EXPECT_EQ(*parsePictureSize("square"), (PictureSize{1024, 1024}));
    EXPECT_EQ(*parsePictureSize("640x480"), (PictureSize{640, 480}));
    EXPECT_FALSE(parsePictureSize("1080q"));
    EXPECT_FALSE(parseSize("1080p"));
    for (const std::string& word : sizePresetWords())
        EXPECT_TRUE(parsePictureSize(word)) << word;
}

TEST(PictureOptionValues, camerasAreNamedAfterSides)
{
    const Scene scene = builtinScene();
    const auto from = [&](const char* words) {
        const auto camera = parseCamera(words, scene, 10, 10);
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
        EXPECT_FALSE(parseCamera(wrong, scene, 10, 10)) << wrong;
}

// Eye, target and lens: degrees, or the height that an orthographic camera covers.
TEST(PictureOptionValues, fieldOfViewAndHeightAreChecked)
{
    const Scene scene = builtinScene();
    const auto with = [&](const std::string& lens) { return parseCamera("1,2,4,0,0.2,0," + lens, scene, 10, 10); };
    for (const char* lens : {"0.01", "1", "179.99", "h0.01", "h1000"})
        EXPECT_TRUE(with(lens)) << lens;
    for (const char* lens : {"0", "-1", "180", "180.5", "nan", "h0", "h-1", "hinf", ""})
        EXPECT_FALSE(with(lens)) << lens;
    EXPECT_NEAR(with("30")->verticalFieldOfView, std::numbers::pi / 6, 1e-6);
    EXPECT_EQ(with("h3")->verticalExtent, 3.0f);
    EXPECT_TRUE(with("h3")->orthographic);
    EXPECT_FALSE(with("30")->orthographic);
}

TEST(PictureOptionValues, camerasAreNumberedFromZero)
{
    Scene scene = builtinScene();
    scene.cameras.resize(2);
    scene.cameras[0].eye = {1, 2, 3};
    scene.cameras[1].eye = {4, 5, 6};
    EXPECT_EQ(parseCamera("0", scene, 10, 10)->eye, glm::vec3(1, 2, 3));
    EXPECT_EQ(parseCamera("1", scene, 10, 10)->eye, glm::vec3(4, 5, 6));
    EXPECT_FALSE(parseCamera("2", scene, 10, 10));
    EXPECT_FALSE(parseCamera("-1", scene, 10, 10));
}

TEST(PictureOptionValues, cameraUpIsNeverTheViewDirection)
{
    const Scene scene;
    const auto level = parseCamera("1,2,3,4,2,8", scene, 10, 10);
    EXPECT_EQ(level->eye, glm::vec3(1, 2, 3));
    EXPECT_EQ(level->target, glm::vec3(4, 2, 8));
    EXPECT_EQ(level->up, glm::vec3(0, 1, 0));
    for (const char* straight : {"0,5,0,0,-1,0", "0,-5,0,0,1,0"})
        EXPECT_GT(glm::length(glm::cross(parseCamera(straight, scene, 10, 10)->up, glm::vec3(0, 1, 0))), 0.5f)
            << straight;
    EXPECT_FALSE(parseCamera("1,2,3,1,2,3", scene, 10, 10)); // eye and target are equal
    EXPECT_FALSE(parseCamera("1,2,3,4,5", scene, 10, 10));
    EXPECT_FALSE(parseCamera("1,2,3,4,5,nan", scene, 10, 10));
}

CommonOptions quiet()
{
    CommonOptions common;
    common.quiet = true;
    return common;
}

TEST(PictureOptionValues, lightsOfTheSceneAreUsed)
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

TEST(PictureOptionValues, studioIsTheDefaultEnvironment)
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

    // An overcast sky casts no shadow; a low sun casts a long one with sharp edges.
    Scene ball;
    EXPECT_TRUE(lightsOf(options, ball).empty());
    options.environment = "evening";
    const auto sun = lightsOf(options, ball);
    ASSERT_EQ(sun.size(), 1u);
    EXPECT_GT(-sun[0].direction.y, 0.174f); // 10 degrees: lower lamps cast no shadow on the ground
    EXPECT_LT(-sun[0].direction.y, 0.5f);
    PictureOptions rotated = options;
    rotated.environmentRotation = 90; // counter-clockwise from above: z becomes x
    EXPECT_NEAR(lightsOf(rotated, ball)[0].direction.x, sun[0].direction.z, 1e-6f);
    EXPECT_NEAR(loadPicture(options, quiet(), {Frame::cotangent})->view.shadowSoftness, 0.0262f, 1e-4f); // 1.5 degrees

    options.environment = "none";
    options.exposure = 1.5f;
    options.shadowSoftness = 0;
    const auto plain = loadPicture(options, quiet(), {Frame::cotangent});
    ASSERT_TRUE(plain);
    EXPECT_FALSE(plain->view.environmentMap || plain->meter);
    EXPECT_EQ(plain->view.backdrop, Backdrop::gradient);
    EXPECT_EQ(plain->view.exposure, 1.5f);
    EXPECT_EQ(plain->view.shadowSoftness, 0);

    // Unlit images do not prepare an environment or a meter.
    PictureOptions normals;
    normals.use = PictureUse::data;
    const auto data = loadPicture(normals, quiet(), {Frame::cotangent});
    ASSERT_TRUE(data);
    EXPECT_FALSE(data->view.environmentMap || data->meter);
}

// ---- words and values --------------------------------------------------------------------------------

struct WordRow {
    const char *option, *word;
    bool (*holds)(const PictureOptions&);
};
using Options = PictureOptions;
constexpr WordRow kWordRows[] = {
    {"--up", "y", [](const Options& o) { return o.up == Up::y; }},
    {"--up", "z", [](const Options& o) { return o.up == Up::z; }},
    {"--edges", "none", [](const Options& o) { return o.edges == Edges::none; }},
    {"--edges", "triangles", [](const Options& o) { return o.edges == Edges::triangles; }},
    {"--edges", "seams", [](const Options& o) { return o.edges == Edges::seams; }},
    {"--edges", "all", [](const Options& o) { return o.edges == Edges::all; }},
    {"--shading", "pbr", [](const Options& o) { return o.shading == Shading::pbr; }},
    {"--shading", "blinn-phong", [](const Options& o) { return o.shading == Shading::blinnPhong; }},
    {"--tangents", "stored", [](const Options& o) { return o.tangents == TangentOrigin::stored; }},
    {"--tangents", "generated", [](const Options& o) { return o.tangents == TangentOrigin::generated; }},
    {"--tone-mapping", "none", [](const Options& o) { return o.toneMapping == ToneMapping::none; }},
    {"--tone-mapping", "neutral", [](const Options& o) { return o.toneMapping == ToneMapping::neutral; }},
    {"--tone-mapping", "aces", [](const Options& o) { return o.toneMapping == ToneMapping::aces; }},
    {"--tone-mapping", "agx", [](const Options& o) { return o.toneMapping == ToneMapping::agx; }},
    {"--background", "paper", [](const Options& o) { return o.background == Background::paper; }},
    {"--background", "blur", [](const Options& o) { return o.background == Background::blurred; }},
    {"--background", "environment", [](const Options& o) { return o.background == Background::sharp; }},
    {"--background", "gradient", [](const Options& o) { return o.background == Background::gradient; }},
    {"--background", "none", [](const Options& o) { return o.background == Background::none; }},
    {"--ground", "on", [](const Options& o) { return o.ground; }},
    {"--ground", "off", [](const Options& o) { return !o.ground; }},
    {"--shape", "plane", [](const Options& o) { return o.shape == "plane"; }},
    {"--shape", "teapot", [](const Options& o) { return o.shape == "teapot"; }},
    {"--samples", "16", [](const Options& o) { return o.samples == 16; }},
    {"--exposure", "auto", [](const Options& o) { return !o.exposure; }},
    {"--exposure", "0.25", [](const Options& o) { return o.exposure == 0.25f; }},
    {"--size", "640x480",
     [](const Options& o) {
         return o.size == PictureSize{640, 480};
     }},
};

// Sets one option in `options` to `word`; `usual` receives the default that its help then shows, which is that word.
Status readInto(PictureOptions& options, const std::string& option, const std::string& word, std::string* usual = {})
{
    const auto declared = [&options] {
        Arguments tool("tool", "", "");
        addPictureOptions(tool, options);
        tool.does([] { return Done{}; });
        return tool;
    };
    const Status done = declared().run({option, word}, {});
    for (const OptionHelp& help : declared().describe().options)
        if (usual && help.names.back() == option)
            *usual = help.usual;
    return done;
}

TEST(PictureOptionValues, optionValuesRoundTripThroughText)
{
    for (const WordRow& row : kWordRows) {
        PictureOptions options;
        for (const WordRow& other : kWordRows) // from any other value
            if (std::string(other.option) == row.option) {
                EXPECT_TRUE(readInto(options, other.option, other.word)) << other.word;
            }
        std::string usual;
        EXPECT_TRUE(readInto(options, row.option, row.word, &usual)) << row.option << " " << row.word;
        EXPECT_EQ(usual, row.word) << row.option;
        for (const WordRow& other : kWordRows)
            if (std::string(other.option) == row.option) {
                EXPECT_EQ(other.holds(options), &other == &row) << row.option << " " << row.word << " " << other.word;
            }
    }
    PictureOptions options;
    EXPECT_TRUE(readInto(options, "--shadow-softness", "0.5"));
    EXPECT_EQ(options.shadowSoftness, 0.5);
}

TEST(PictureOptionValues, unknownValuesAreRefusedWithTheKnownOnes)
{
    for (const auto& [option, expected] : {std::pair("--up", "y or z"),
                                           {"--edges", "none, triangles, seams or all"},
                                           {"--shading", "pbr or blinn-phong"},
                                           {"--tangents", "stored or generated"},
                                           {"--tone-mapping", "none, neutral, aces or agx"},
                                           {"--background", "paper, blur, environment, gradient or none"},
                                           {"--ground", "on or off"},
                                           {"--shape", "plane, sphere, torus or teapot"},
                                           {"--samples", "1, 4 or 16"},
                                           {"--exposure", "auto or a number above 0 and at most 1e6"},
                                           {"--shadow-softness", "a number from 0 to 60"}})
        for (const std::string wrong : {"prb", ""}) {
            PictureOptions options;
            const Status done = readInto(options, option, wrong);
            ASSERT_FALSE(done) << option;
            EXPECT_EQ(done.error().kind, ErrorKind::usage);
            EXPECT_EQ(done.error().message,
                      std::string(option) + ": expected " + expected + "; found '" + wrong + "' (see tool --help)");
        }
}

TEST(PictureOptionValues, invalidSizesAreRefused)
{
    PictureOptions options;
    const Status done = readInto(options, "--size", "640x");
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, ErrorKind::usage);
    EXPECT_EQ(done.error().message,
              "--size: expected WxH, or one number for both, each from 1 to 16384, or thumbnail, 720p, 1080p, 1440p, "
              "2160p, square; found '640x' (see tool --help)");
    EXPECT_EQ(options.size, (PictureSize{1280, 720}));
    for (const PictureSize size : {PictureSize{0, 1}, {1, 0}, {16385, 1}, {1, 16385}, {-1, 5}}) {
        PictureOptions wrong;
        wrong.size = size;
        const auto picture = openPicture(wrong, 1, {Frame::cotangent});
        ASSERT_FALSE(picture) << size.width << " " << size.height;
        EXPECT_EQ(picture.error().kind, ErrorKind::usage);
        EXPECT_EQ(picture.error().message.find("--size: expected WxH, each from 1 to 16384; found '"), 0u);
        EXPECT_FALSE(viewOf(wrong, Scene()));
    }
}

TEST(OptionNames, fieldsBecomeOptionNamesAndMemoryIsNamedOnce)
{
    const auto named = [](const Error& error) { return withOptionNames(error).message; };
    EXPECT_EQ(named(about("options.maxDistance", usageError("expected 0"))), "--max-distance: expected 0");
    EXPECT_EQ(named(about("options.bake.frame", usageError("expected 0"))), "--bake.frame: expected 0");
    EXPECT_EQ(named(about("high.maps", usageError("expected none"))), "high.maps: expected none");
    EXPECT_EQ(named(inputError("options.glb: 5 x 5 pixels, the limit is 1 MiB")),
              "options.glb: 5 x 5 pixels, the limit is 1 MiB"); // a file of that name
    EXPECT_EQ(named(withOptionNames(memoryError("a.png: too large"))), "a.png: too large (--memory raises it)");
    EXPECT_EQ(withOptionNames(memoryError("")).kind, ErrorKind::input);
}

// A command with the options of `render` except those for files.
struct DeclaredTool {
    PictureOptions options;
    std::string frame{kAutoFrame};
    Arguments tool{"tool", "", ""};

    DeclaredTool()
    {
        addPictureOptions(tool, options);
        addFrameOption(tool, frame);
        addShowOption(tool, options);
    }
};

// The options as its help lists them.
std::vector<OptionHelp> declaredOptions() { return DeclaredTool().tool.describe().options; }

// The command line's error for these words, without the hint at the help; empty if it accepts them.
std::string commandLineMessage(const std::vector<std::string>& words)
{
    DeclaredTool declared;
    declared.tool.does([] { return Done{}; });
    const Status done = declared.tool.run(words, {});
    const std::string message = done ? "" : done.error().message;
    return message.substr(0, message.find(" (see tool --help)"));
}

std::string libraryMessage(const std::vector<std::string>& words)
{
    PictureOptions options;
    std::string frame(kAutoFrame);
    const Status done = readPictureWords(words, options, frame);
    EXPECT_TRUE(done || done.error().kind == ErrorKind::usage);
    return done ? "" : done.error().message;
}

TEST(PictureOptionValues, removedOptionsAreUnknownWithAHint)
{
    for (const auto& [name, word, hint] :
         {std::tuple("--lighting", "world", "lights are always evaluated in world space"),
          {"--normal-mapping", "facets", "lights and the environment always meet the perturbed normal"},
          {"--rows", "up", "rows always run down"},
          {"--derivatives", "coarse", "derivatives are always fine"}}) {
        const std::string message = std::string("unknown option ") + name + ": " + hint;
        EXPECT_EQ(commandLineMessage({name, word}), message);
        EXPECT_EQ(libraryMessage({name, word}), message);
        EXPECT_EQ(libraryMessage({std::string(name) + "=" + word}), message);
    }
}

TEST(PictureOptionValues, libraryAcceptsAndRefusesLikeTheCommandLine)
{
    std::size_t options = 0;
    for (const OptionHelp& help : declaredOptions()) {
        const std::string name = help.names.back();
        if (name == "--help" || name == "--version" || name == "--list-frames" || help.positional)
            continue;
        ++options;
        if (help.value.empty()) {
            EXPECT_EQ(libraryMessage({name}), "");
            continue;
        }
        std::vector<std::string> words = {"",    "prb", "-1", "0",     "1",      "3.5",     "16",  "0x10",
                                          "nan", "1e9", "61", "65537", "100001", "640x480", "a\nb"};
        words.insert(words.end(), {help.minimum, help.maximum});
        words.insert(words.end(), help.words.begin(), help.words.end());
        for (const std::string& word : words)
            EXPECT_EQ(libraryMessage({name, word}), commandLineMessage({name, word})) << name << " " << word;
    }
    EXPECT_EQ(options, 37u);
}

TEST(PictureOptionValues, libraryReadsTheSameValues)
{
    for (const WordRow& row : kWordRows)
        for (const bool joined : {false, true}) {
            PictureOptions options;
            std::string frame;
            const std::string option = row.option, word = row.word;
            const std::vector<std::string> words =
                joined ? std::vector{option + "=" + word} : std::vector{option, word};
            EXPECT_TRUE(readPictureWords(words, options, frame)) << option << " " << word;
            EXPECT_TRUE(row.holds(options)) << option << " " << word;
        }
    PictureOptions o;
    std::string frame;
    const std::vector<std::string> words = {"--memory",
                                            "0x10",
                                            "--material=-1",
                                            "--normal-map",
                                            "n.png",
                                            "--convention=directx",
                                            "--base-color=b=c.png",
                                            "--metallic-roughness",
                                            "m.png",
                                            "--occlusion=",
                                            "--variant",
                                            "--",
                                            "--animation=2",
                                            "--time",
                                            "0.1",
                                            "--camera",
                                            "-1,2,3,0,0,0",
                                            "--device=reference",
                                            "--frame",
                                            "smooth",
                                            "--view",
                                            "uv",
                                            "--environment=evening",
                                            "--environment-rotation",
                                            "-30.5",
                                            "--environment-intensity",
                                            "0.1",
                                            "--shadow-softness=0.5",
                                            "--no-shadows",
                                            "--no-normal-maps",
                                            "--specular-antialiasing",
                                            "--point-sampled",
                                            "--",
                                            "--model"};
    ASSERT_TRUE(readPictureWords(words, o, frame));
    EXPECT_EQ(o.memory, 16);
    EXPECT_EQ(o.maps.material, -1);
    EXPECT_EQ(o.maps.normal + o.maps.convention + o.maps.baseColor, "n.pngdirectxb=c.png");
    EXPECT_EQ(o.maps.metallicRoughness + o.maps.occlusion + o.variant + o.animation, "m.png--2");
    EXPECT_EQ(o.time, 0.1);
    EXPECT_EQ(o.camera + o.device + frame + o.show, "-1,2,3,0,0,0referencesmoothuv");
    EXPECT_EQ(o.environment, "evening");
    EXPECT_EQ(o.environmentRotation, -30.5);
    EXPECT_EQ(o.environmentIntensity, 0.1f);
    EXPECT_EQ(o.shadowSoftness, 0.5);
    EXPECT_TRUE(o.noShadows && o.noNormalMaps && o.specularAntialiasing && o.pointSampled);
    EXPECT_EQ(o.model, "--model");
}

TEST(PictureOptionValues, laterValuesResetAnOption)
{
    PictureOptions o;
    o.exposure = 2.0f;
    o.ground = false;
    o.edges = Edges::all;
    std::string frame;
    const std::vector<std::string> words = {"--exposure", "auto", "--ground", "on", "--edges", "none"};
    ASSERT_TRUE(readPictureWords(words, o, frame));
    EXPECT_FALSE(o.exposure);
    EXPECT_TRUE(o.ground);
    EXPECT_EQ(o.edges, Edges::none);
}

TEST(PictureOptionValues, libraryRefusesUnknownOptions)
{
    for (const auto& [words, message] : {std::pair(std::vector<std::string>{"-o", "a.png"}, "unknown option -o"),
                                         {{"--help"}, "unknown option --help"},
                                         {{"--sizes=8"}, "unknown option --sizes"},
                                         {{"a.glb", "b.glb"}, "unexpected word 'b.glb'"},
                                         {{"a.glb", "--", "--"}, "unexpected word '--'"},
                                         {{"--size"}, "--size needs a value"},
                                         {{"--up=y", "--up", "z"}, "--up is given twice; expected once"},
                                         {{"--no-shadows=\n"}, "--no-shadows takes no value; found ' '"}})
        EXPECT_EQ(libraryMessage(words), message);
    EXPECT_EQ(libraryMessage({"-"}), ""); // a model
    EXPECT_EQ(libraryMessage({"--no-shadows", "--no-shadows"}), "");
    EXPECT_EQ(libraryMessage({}), "");
}

TEST(PictureOptionValues, exposureIsAutoOrAPositiveNumber)
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

} // namespace
} // namespace cotan::app
