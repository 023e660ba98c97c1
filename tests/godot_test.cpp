// Godot 3 and Godot 4 draw the output of `cotan shader --lang godot`. Skipped without them and xvfb-run.
#include <gtest/gtest.h>

#include <algorithm>

#include <fmt/format.h>

#include "cotan/image.hpp"
#include "godot_draw.hpp"
#include "godot_parity.hpp"
#include "godot_sheet.hpp"
#include "truth/quad.hpp"

namespace cotan::test {
namespace {

using shader_text::Choice;
using shader_text::Form;
using shader_text::Language;

class Godot : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Driver, Godot, testing::Values("GLES3", "GLES2"), [](const auto& p) { return p.param; });

class Godot4 : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Driver, Godot4, testing::Values("opengl3", "vulkan"), [](const auto& p) { return p.param; });

// Maximum error in units of what one rounding of the result and of each input changes (Case::allowance).
double maxRoundings(const Case& c, const std::vector<Sample>& samples, const std::vector<glm::dvec3>& values)
{
    double maximum = 0;
    for (std::size_t s = 0; s < samples.size(); ++s)
        if (samples[s].kind == Kind::light) {
            const glm::dvec3 error = glm::abs(values[s] - c.expected(samples[s].v)),
                             allowed = c.allowance(samples[s].v);
            for (int k = 0; k < 3; ++k)
                if (error[k] != 0)
                    maximum = error[k] / allowed[k] <= maximum ? maximum : error[k] / allowed[k]; // NaN is kept
        }
    return maximum;
}

TEST_P(Godot, functionsAgreeWithTheOtherLanguages)
{
    std::vector<Case> some;
    for (Case& c : godotCases())
        some.push_back(std::move(c));
    std::vector<Sample> finite;
    for (const Sample& s : samples())
        if (s.kind != Kind::nonFinite)
            finite.push_back(s);
    const Results r = runGodotCases(some, finite, GetParam());
    for (std::size_t k = 0; k < some.size(); ++k) {
        double maximum = 0;
        if (some[k].light) {
            const double roundings = maxRoundings(some[k], finite, r.values[k]);
            fmt::print("| {:24} | {} | {:.1f} roundings |\n", some[k].name, r.language, roundings);
            // 64 as in the other languages (shader_test.cpp), 16 for reading back with exp2 and log2, and 8 for the six
            // digits to which Godot 3 shortens constants, for up to six constants per function.
            EXPECT_LT(roundings, 128) << some[k].name;
            continue;
        }
        for (std::size_t s = 0; s < finite.size(); ++s)
            if (finite[s].kind <= some[k].last) {
                const glm::dvec3 expected = some[k].expected(finite[s].v);
                const double error = cotan::degreesBetween(r.values[k][s], expected);
                maximum = error <= maximum ? maximum : error; // NaN is kept
            }
        for (std::size_t s = 0; s < finite.size(); ++s)
            if (finite[s].kind == Kind::moved && finite[s].source == some[k].moves
                && (some[k].anyScale || finite[s].scale == 1)) {
                const glm::dvec3 axes(finite[s].mirrored ? -1 : 1, 1, 1);
                const double error = cotan::degreesBetween(r.values[k][s], axes * some[k].expected(finite[s].from));
                maximum = error <= maximum ? maximum : error;
            }
        fmt::print("| {:24} | {} | {:.1e} |\n", some[k].name, r.language, maximum);
        EXPECT_LT(maximum, 1.2e-3) << some[k].name;
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// Like cotan_test_unit and unitOfBytes, but in 7 bits of each byte: the opengl3 of Godot 4 changes those below 57. Its
// vulkan converts colours to sRGB.
constexpr char kGodot4Numbers[] = R"(
vec3 cotan_test_unit(float x)
{
    float number = floor((x * 0.5 + 0.5) * 2097151.0 + 0.5);
    float high = floor(number / 16384.0);
    float middle = floor((number - high * 16384.0) / 128.0);
    vec3 bytes = vec3(high, middle, number - high * 16384.0 - middle * 128.0) + 100.0;
    return SRGB;
}
)";
double unitOf7Bits(const char* at)
{
    const auto number = [&](int k) { return static_cast<unsigned char>(at[k]) - 100; };
    return (number(0) * 16384 + number(1) * 128 + number(2)) / 2097151.0 * 2 - 1;
}

// The printed shader, which writes its normal as a colour. In Godot 4 textures are filtered and the vectors of the mesh
// are in other arrays.
std::string normalShader(const Choice& choice, const std::string& driver)
{
    const auto made = makeShaderText(choice);
    EXPECT_TRUE(made) << made.error().message;
    const bool four = isGodot4(driver);
    const std::string start =
        "shader_type spatial;\n" + std::string(choice.twoSided ? "render_mode cull_disabled;\n" : "");
    const std::string numbers = !four
        ? kGodotNumbers
        : replaced(kGodot4Numbers, "SRGB",
                   driver == "vulkan" ? "pow((bytes / 255.0 + 0.055) / 1.055, vec3(2.4))" : "bytes / 255.0");
    std::string text = replaced(made->text, start,
                                "shader_type spatial;\nrender_mode unshaded, "
                                    + std::string(choice.twoSided ? "cull_disabled" : "cull_back")
                                    + ";\nuniform float part;\n" + numbers);
    if (four)
        text = replaced(text, "hint_normal;", "hint_normal, filter_nearest, repeat_enable;");
    if (four && (readsTriangleVectors(choice.frame) || readsCotangents(choice.frame)))
        text = replaced(text, "TANGENT, COLOR.rgb, MODEL", "CUSTOM0.xyz, CUSTOM1.xyz, MODEL");
    // fragment() is the last function.
    return text.substr(0, text.rfind('}'))
        + "    ALBEDO = cotan_test_unit(part < 0.5 ? NORMAL.x : (part < 1.5 ? NORMAL.y : NORMAL.z));\n}\n";
}

constexpr int kWidth = 480, kHeight = 240;

Vec rayAt(int row, int column)
{
    return {((2 * (column + 0.5) / kWidth) - 1) * 2 / 2.2, (1 - 2 * (row + 0.5) / kHeight) / 2.2, -1};
}

// Reads a vector from an image in three parts.
Vec vectorAt(const std::string& image, int pixel, double (*unit)(const char*) = unitOfBytes)
{
    Vec n{};
    for (int part = 0; part < 3; ++part)
        n[static_cast<std::size_t>(part)] = unit(image.data() + 3 * (part * kWidth * kHeight + pixel));
    return n;
}

struct SheetError {
    double maximum = 0, mean = 0;
    int count = 0;
};

// Errors on the left sheet (front) or the right one (back). normalAt(pixel): counted from the top.
template<class NormalAt>
SheetError sheetError(bool right, SheetFrame frame, Vec (*map)(double, double), NormalAt normalAt)
{
    SheetError e;
    for (int row = 0; row < kHeight; ++row)
        for (int column = right ? kWidth / 2 : 0; column < (right ? kWidth : kWidth / 2); ++column) {
            const Vec ray = rayAt(row, column);
            const Vec expected = right ? truth(ray, 1.2, M_PI - 0.4, frame, map) : truth(ray, -1.2, 0.4, frame, map);
            if (dot(expected, expected) == 0)
                continue;
            const double error = degreesBetween(normalAt(row * kWidth + column), expected);
            e.maximum = error <= e.maximum ? e.maximum : error;
            e.mean += error;
            ++e.count;
        }
    e.mean /= e.count;
    return e;
}

// A frame, and the truth that its shaders draw.
struct Row {
    Frame frame;
    SheetFrame truth;
    std::optional<Form> form = {};
};

// The frames that a driver can draw: GLES2 has no derivatives.
std::vector<Row> rowsOf(const std::string& driver)
{
    std::vector<Row> rows = {{Frame::triangle, SheetFrame::cotangent},
                             {Frame::smooth, SheetFrame::cotangent},
                             {Frame::smooth, SheetFrame::cotangent, Form::fused},
                             {Frame::mikktspace, SheetFrame::orthonormal},
                             {Frame::vertex, SheetFrame::orthonormal}};
    if (driver != "GLES2")
        rows.insert(rows.begin(),
                    {{Frame::cotangent, SheetFrame::cotangent},
                     {Frame::cotangent, SheetFrame::cotangent, Form::total},
                     {Frame::gradient, SheetFrame::gradient},
                     {Frame::orthonormal, SheetFrame::orthonormal}});
    return rows;
}

Choice choiceOf(const Row& row, const std::string& driver, bool twoSided)
{
    Choice choice;
    choice.language = Language::godot;
    choice.frame = row.frame;
    choice.form = row.form;
    choice.twoSided = twoSided;
    choice.convention.channels = Channels::orthographic;
    choice.callerDifferences = driver == "GLES2";
    return choice;
}

// A sheet that is drawn, and what it must look like.
struct SheetCase {
    Row row;
    bool twoSided = false, mirrored = false; // mirrored: by the transform
    glm::vec3 scale{1};                      // of the transform
    nlohmann::json sheet;                    // its mesh
    Vec (*map)(double, double) = domeTexel;
    std::string label = {};
};

void expectSheets(const std::string& driver, const std::vector<SheetCase>& cases)
{
    GodotJobs jobs;
    const nlohmann::json map = jobs.texture(domeBytes(), kMapSize, kMapSize);
    for (const SheetCase& c : cases)
        jobs.add(normalShader(choiceOf(c.row, driver, c.twoSided), driver), kWidth, kHeight, 3,
                 {{"textures", {{"normal_map", map}}},
                  {"sheet", c.sheet},
                  {"mirrored", c.mirrored},
                  {"scale", {c.scale.x, c.scale.y, c.scale.z}}});
    const std::vector<std::string> images = jobs.draw(driver);
    for (std::size_t k = 0; k < cases.size(); ++k) {
        const SheetCase& c = cases[k];
        const auto normalAt = [&](int pixel) {
            return vectorAt(images[k], pixel, isGodot4(driver) ? unitOf7Bits : unitOfBytes);
        };
        for (const bool right : {false, true}) {
            if (right && !c.twoSided)
                continue;
            const SheetError e = sheetError(right, c.row.truth, c.map, normalAt);
            const std::string label = fmt::format("{} {}{}, {}{}, scale {}{}", info(c.row.frame).name, driver,
                                                  c.twoSided ? ", two-sided" : "", right ? "back" : "front",
                                                  c.mirrored ? ", mirrored" : "", c.scale.x, c.label);
            fmt::print("| {:50} | {:.4f} {:.4f} |\n", label, e.mean, e.maximum);
            EXPECT_GT(e.count, 8000);
            EXPECT_LT(e.maximum, 0.02) << label;
        }
    }
}

std::vector<SheetCase> onBothSides(const std::string& driver)
{
    std::vector<SheetCase> cases;
    for (const Row& row : rowsOf(driver))
        for (const bool twoSided : {false, true})
            for (const bool mirrored : {false, true})
                cases.push_back({row, twoSided, mirrored, glm::vec3(1), sheetFor(row.frame)});
    return cases;
}

// The sheet looks the same if its mesh is larger and its transform smaller, also along one axis only.
std::vector<SheetCase> scaled(const std::string& driver)
{
    std::vector<SheetCase> cases;
    for (const Row& row : rowsOf(driver))
        for (const glm::vec3 scale :
             {glm::vec3(0.25), glm::vec3(0.5), glm::vec3(2), glm::vec3(4), glm::vec3(3, 0.5, 1)})
            for (const bool mirrored : {false, true})
                cases.push_back({row, mirrored, mirrored, scale, sheetFor(row.frame, scale)});
    return cases;
}

Vec flatTexel(double, double) { return {0, 0, 1}; }

// With derivatives another frame draws the mesh, without them the normal of the mesh remains. Godot 4 invents tangents.
std::vector<SheetCase> withoutData(const std::string& driver)
{
    nlohmann::json none = sheetFor(Frame::cotangent), tangents = none;
    EXPECT_FALSE(none.contains("tangents") || none.contains("colors") || none.contains("generate_tangents"));
    tangents["generate_tangents"] = true;
    std::vector<SheetCase> cases;
    for (const Row& row : rowsOf(driver))
        for (const bool mirrored : {false, true})
            for (const nlohmann::json& sheet : {none, tangents})
                if (info(row.frame).source != FrameSource::differences
                    && !(readsTangents(row.frame) && (sheet == tangents || isGodot4(driver))))
                    cases.push_back({row, mirrored, mirrored, glm::vec3(1), sheet,
                                     driver == "GLES2" ? flatTexel : domeTexel,
                                     sheet == none ? ", no data" : ", tangents only"});
    return cases;
}

TEST_P(Godot, shadersDrawTheShearedSheetOnBothSides) { expectSheets(GetParam(), onBothSides(GetParam())); }
TEST_P(Godot, shadersDoNotDependOnTheScaleOfTheTransform) { expectSheets(GetParam(), scaled(GetParam())); }
TEST_P(Godot, meshesWithoutTheDataOfAFrameAreDrawnWithAnotherOrFlat)
{
    expectSheets(GetParam(), withoutData(GetParam()));
}

TEST_P(Godot4, shadersDrawTheShearedSheetOnBothSides) { expectSheets(GetParam(), onBothSides(GetParam())); }
TEST_P(Godot4, shadersDoNotDependOnTheScaleOfTheTransform) { expectSheets(GetParam(), scaled(GetParam())); }
TEST_P(Godot4, meshesWithoutTheDataOfAFrameAreDrawnWithAnother) { expectSheets(GetParam(), withoutData(GetParam())); }

// Combines all options.
TEST_P(Godot, everyWholeShaderCompiles)
{
    GodotJobs jobs;
    for (const FrameInfo& f : frames()) {
        const bool derivatives = f.source == FrameSource::differences; // not in GLES2
        if (f.frame == Frame::exact || (derivatives && GetParam() == "GLES2"))
            continue;
        Choice choice;
        choice.language = Language::godot;
        choice.frame = f.frame;
        choice.twoSided = true;
        choice.callerDifferences = GetParam() == "GLES2";
        choice.uvSets = derivatives ? 2 : 1;
        choice.sets = {shader_text::Set::gradient, shader_text::Set::blend, shader_text::Set::light};
        const auto made = makeShaderText(choice);
        ASSERT_TRUE(made) << made.error().message;
        jobs.add(made->text, 8, 8, 1, {{"light", {{0, 0, 1}}}});
    }
    EXPECT_NO_THROW(jobs.draw(GetParam()));
}

TEST_P(Godot, theDirectionOfUIsThatOfTheSheet)
{
    if (GetParam() == "GLES2")
        GTEST_SKIP() << "GLES2 of Godot 3.2 has no derivatives";
    Choice choice;
    choice.language = Language::godot;
    choice.frame = Frame::cotangent;
    choice.convention.channels = Channels::orthographic;
    GodotJobs jobs;
    const nlohmann::json map = jobs.texture(std::string("\x80\x80\xff\xff", 4), 1, 1); // flat
    jobs.add(
        replaced(normalShader(choice, GetParam()), "    ALBEDO =",
                 "    TANGENT = cotan_direction_of_u(NORMAL, VERTEX, UV);\n    BINORMAL = cross(NORMAL, TANGENT);\n"
                 "    ANISOTROPY = 0.8;\n    NORMAL = TANGENT;\n    ALBEDO ="),
        kWidth, kHeight, 3, {{"textures", {{"normal_map", map}}}, {"sheet", sheetFor(Frame::cotangent)}});
    const std::string image = jobs.draw(GetParam())[0];
    int count = 0;
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth / 2; ++column) {
            const Vec ray = rayAt(row, column);
            // As in truth(): u grows along the sheet's x where x is positive, and against it elsewhere.
            const double x = onSheet(ray, -1.2, 0.4)[0];
            if (dot(truth(ray, -1.2, 0.4), truth(ray, -1.2, 0.4)) == 0)
                continue;
            const double sign = x < 0 ? -1 : 1;
            ASSERT_LT(degreesBetween(vectorAt(image, row * kWidth + column),
                                     {sign * std::cos(0.4), 0, -sign * std::sin(0.4)}),
                      0.02)
                << column << ", " << row;
            ++count;
        }
    EXPECT_GT(count, 8000);
}

// light(): metallic-roughness under a coat whose normal is the sheet's own, with one red light, compared with the
// portable text in double. A step of a colour is 1/255, rounding is half of it. The normal's error of 0.0012 degrees,
// times the slope of a highlight of roughness 0.3, below 20 per radian, is 4e-4.
TEST_P(Godot, lightMatchesThePortableText)
{
    const bool derivatives = GetParam() == "GLES3";
    Choice choice;
    choice.language = Language::godot;
    choice.frame = derivatives ? Frame::cotangent : Frame::triangle;
    choice.callerDifferences = !derivatives;
    choice.convention.channels = Channels::orthographic;
    choice.sets = {shader_text::Set::light};
    choice.twoSided = true;
    std::string text = makeShaderText(choice)->text;
    text = replaced(text, "void fragment()\n{\n",
                    "void fragment()\n{\n    ALBEDO = vec3(0.25, 0.5, 0.5);\n    ROUGHNESS = 0.4;\n");
    text = replaced(text, "metallic : hint_range(0.0, 1.0) = 0.0", "metallic : hint_range(0.0, 1.0) = 0.25");
    text = replaced(text, "render_mode cull_disabled",
                    "render_mode cull_disabled, shadows_disabled, ambient_light_disabled");
    text =
        replaced(text, "coat_roughness : hint_range(0.0, 1.0) = 0.05", "coat_roughness : hint_range(0.0, 1.0) = 0.3");
    GodotJobs jobs;
    const nlohmann::json map = jobs.texture(domeBytes(), kMapSize, kMapSize);
    const glm::dvec3 to = glm::normalize(glm::dvec3(-0.3, 0.4, 1.0));
    jobs.add(text, kWidth, kHeight, 1,
             {{"textures", {{"normal_map", map}}}, {"sheet", sheetFor(choice.frame)}, {"light", {{to.x, to.y, to.z}}}});
    const std::string image = jobs.draw(GetParam())[0];
    double maximum = 0, brightest = 0;
    for (const bool right : {false, true}) {
        int count = 0;
        for (int row = 0; row < kHeight; ++row)
            for (int column = right ? kWidth / 2 : 0; column < (right ? kWidth : kWidth / 2); ++column) {
                const Vec ray = rayAt(row, column);
                const double middle = right ? 1.2 : -1.2, angle = right ? M_PI - 0.4 : 0.4;
                const Vec n = truth(ray, middle, angle, SheetFrame::cotangent, domeTexel);
                if (dot(n, n) == 0)
                    continue;
                const double side = right ? -1 : 1;
                const glm::dvec3 v = -glm::normalize(glm::dvec3(ray[0], ray[1], ray[2]));
                const f64::cotan_surface s{glm::dvec3(0.25, 0.5, 0.5),
                                           0.25,
                                           0.4,
                                           1,
                                           glm::dvec3(0),
                                           glm::normalize(glm::dvec3(n[0], n[1], n[2])),
                                           v};
                const f64::cotan_coat c{1, 0.3, {side * std::sin(angle), 0, side * std::cos(angle)}};
                const double expected = M_PI
                    * (f64::cotan_reflect_pbr(s, to).x * (1 - f64::cotan_coat_fraction(c, v))
                       + f64::cotan_reflect_coat(c, v, to));
                const char* at = image.data() + 3 * (row * kWidth + column);
                const double got = static_cast<unsigned char>(at[0]) / 255.0;
                brightest = std::max(brightest, got);
                maximum = std::max(maximum, std::abs(got - std::min(expected, 1.0)));
                EXPECT_LT(static_cast<unsigned char>(at[1]), 2) << "the light is red";
                ++count;
            }
        EXPECT_GT(count, 8000);
    }
    fmt::print("light {}: {:.4f} off at most, {:.2f} at the brightest\n", GetParam(), maximum, brightest);
    EXPECT_LT(maximum, 0.5 / 255 + 4e-4);
    EXPECT_GT(brightest, 0.3);
}

// The domes, except within two texels of a rim, where a filtered 128 x 128 map with mips differs from them.
Vec domesAwayFromRims(double u, double v)
{
    const double x = std::fmod(u * 4, 2) - 1, y = std::fmod(v * 4, 2) - 1;
    return std::abs(std::sqrt(x * x + y * y) - 0.8) < 0.15 ? Vec{0, 0, 0} : domes(u, v);
}

TEST_P(Godot, theExampleDrawsTheAnalyticSheet)
{
    TemporaryFolder folder;
    for (const std::string mirrored : {"", " --mirrored", " --scale=0.25", " --scale=3 --mirrored"}) {
        const std::string file = folder / ("normals" + mirrored + ".png");
        runGodot(COTAN_SOURCE_DIR "/examples/godot", GetParam(),
                 "--resolution 480x240 --normals" + mirrored + " '--picture=" + file + "'");
        const auto image = readImage(file);
        ASSERT_TRUE(image) << image.error().message;
        ASSERT_EQ(image->width, kWidth);
        ASSERT_EQ(image->height, kHeight);
        const auto normalAt = [&](int pixel) {
            Vec n{};
            for (int k = 0; k < 3; ++k)
                n[static_cast<std::size_t>(k)] = image->bytes8()[4 * pixel + k] / 127.5 - 1;
            return n;
        };
        for (const bool right : {false, true}) {
            const SheetError e = sheetError(right, SheetFrame::cotangent, domesAwayFromRims, normalAt);
            fmt::print("example {}{}, {}: {:.2f} degrees in the mean, {:.2f} at most\n", GetParam(), mirrored,
                       right ? "back" : "front", e.mean, e.maximum);
            EXPECT_GT(e.count, 5000);
            // A step of the image's 8 bits is 0.45 degrees along an axis; rounding gives a mean of 0.13 along each of
            // two. The map's 8 bits and filtering add about as much.
            EXPECT_LT(e.mean, 0.3);
            EXPECT_LT(e.maximum, 1.0);
        }
    }
}

} // namespace
} // namespace cotan::test

int main(int count, char** words)
{
    testing::InitGoogleTest(&count, words);
    const bool four = testing::GTEST_FLAG(filter).find("Godot4") != std::string::npos;
    const std::string program = four ? "godot --version | grep -q '^4'" : "command -v godot3 > /dev/null";
    if (std::system((program + " && command -v xvfb-run > /dev/null").c_str()) != 0) {
        std::printf("skipped: no Godot %d or no xvfb-run\n", four ? 4 : 3);
        return 77;
    }
    return RUN_ALL_TESTS();
}
