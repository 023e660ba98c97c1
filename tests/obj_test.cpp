// OBJ and MTL files. Expected values follow from their text and from geometry.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

#include "cotan/model.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;

class ObjFile : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path()
        / ("cotan_obj_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    fs::path write(const std::string& name, const std::string& text) const
    {
        fs::remove(folder / name);
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    Scene load(const std::string& text) const
    {
        auto scene = loadScene(write("model.obj", text));
        if (!scene) {
            ADD_FAILURE() << scene.error().message;
            return {};
        }
        return *std::move(scene);
    }

    std::string problem(const std::string& text, const LoadLimits& limits = {}) const
    {
        const auto scene = loadScene(write("model.obj", text), limits);
        return scene ? "" : scene.error().message;
    }

    // A scene with a triangle whose material library has these lines.
    Scene loadMaterial(const std::string& lines) const
    {
        write("m.mtl", lines);
        return load("mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    }
};

bool mentions(const Scene& scene, const std::string& text)
{
    return std::ranges::any_of(scene.warnings, [&](const std::string& s) { return s.find(text) != std::string::npos; });
}

const Material& materialOf(const Scene& scene) { return scene.materials.at(std::size_t(scene.meshes.at(0).material)); }

// ---- numbers and statements -------------------------------------------------------------------

TEST_F(ObjFile, everyCommonNumberFormatIsRead)
{
    const std::pair<std::string, float> spellings[] = {{".5", 0.5f},
                                                       {"-.5", -0.5f},
                                                       {"+.5", 0.5f},
                                                       {"5.", 5},
                                                       {"+5", 5},
                                                       {"-0", 0},
                                                       {"5e-1", 0.5f},
                                                       {"5.e-1", 0.5f},
                                                       {".5E+0", 0.5f},
                                                       {"1e-60", 0},
                                                       {"1.5e-400", 0}, // too small for a double
                                                       {"0." + std::string(500, '0') + "1", 0},
                                                       {"1.5e-99999999999999999999", 0},
                                                       {"0e999999999999999999999", 0},
                                                       {"007", 7},
                                                       {"0.1", 0.1f},
                                                       {"16777217", 16777216},
                                                       {"3.4028234e38", 3.4028234e38f},
                                                       {"1.00000011920928955078125", 1.00000011920928955078125f}};
    for (const auto& [word, value] : spellings) {
        const Scene scene = load("v " + word + " 0 0\nv 0 " + word + " 0\nv 0 0 " + word + "\nv 1 2 3\nvt " + word
                                 + "\nf 4/1 2/1 3/1 1/1\n");
        ASSERT_EQ(scene.meshes.size(), 1u) << word;
        const auto& positions = scene.meshes[0].positions;
        EXPECT_NE(std::ranges::find(positions, glm::vec3(value, 0, 0)), positions.end()) << word;
        EXPECT_NE(std::ranges::find(positions, glm::vec3(0, 0, value)), positions.end()) << word;
        EXPECT_EQ(scene.meshes[0].texcoords[0].at(0), glm::vec2(value, 1)) << word;
    }
    for (const std::string word : {".", "+", "-", "1e", "0x10", "1,5", "nan", "1e39", "1e400",
                                   "-1e99999999999999999999", "+-1", "--1", "1.2.3", "1d5"})
        EXPECT_NE(problem("v " + word + " 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n").find("line 1: expected a finite number"),
                  std::string::npos)
            << word;
}

TEST_F(ObjFile, positionsMayHaveAWeightOrAColour)
{
    const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(load("v 2 4 6 2\n" + rest).meshes.at(0).positions[0], glm::vec3(1, 2, 3));
    EXPECT_NE(problem("v 2 4 6 0\n" + rest).find("line 1: expected a weight other than 0"), std::string::npos);
    EXPECT_NE(problem("v 2 4 6 1 1\n" + rest).find("found 5"), std::string::npos);

    const Scene coloured = load("v 0 0 5 1 0 1 0.25\n" + rest); // the others have no colour: white
    const Mesh& mesh = coloured.meshes.at(0);
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_EQ(mesh.colors[0], glm::vec4(1, 0, 1, 0.25f));
    EXPECT_EQ(mesh.colors[1], glm::vec4(1));
    // sRGB 0.5 is 0.2140 in linear light (IEC 61966-2-1).
    EXPECT_NEAR(load("v 1 0 0\nv 0 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 2 3\n").meshes.at(0).colors[1].x, 0.2140, 1e-4);
}

TEST_F(ObjFile, facesMayPrecedeTheirVerticesAndUseRelativeIndices)
{
    const Scene scene =
        load("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nv 6 5 5\nv 5 6 5\nfo -3 -2 -1\n");
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.triangleCount(), 3u);
    EXPECT_EQ(mesh.positions[mesh.indices[3]], glm::vec3(0, 0, 0));
    EXPECT_EQ(mesh.positions[mesh.indices[7]], glm::vec3(6, 5, 5));
}

TEST_F(ObjFile, eachGroupAndMaterialIsAMesh)
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng left arm\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n"
                             "o body\nf 3 2 1\ng left arm\nf 2 3 1\n";
    const Scene scene = load(text);
    ASSERT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.meshes[0].name, "left arm");
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
    EXPECT_EQ(scene.meshes[1].name, "left arm");
    EXPECT_EQ(scene.meshes[1].triangleCount(), 2u); // the second mesh with blue
    EXPECT_EQ(scene.meshes[2].name, "body");
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[2].name, "body");
    LoadLimits limits;
    limits.nodes = 2;
    EXPECT_NE(problem(text, limits).find("line 10: over the limit of 2 nodes"), std::string::npos);
}

TEST_F(ObjFile, manyGroupsAndMaterialsTakeLinearTime)
{
    std::ostringstream text, library;
    text << "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    constexpr int kGroups = 30000; // once took quadratic time and never finished
    for (int i = 0; i < kGroups; ++i) {
        text << "g " << i << "\nusemtl m" << i << "\nf 1 2 3\n";
        library << "newmtl m" << i << "\nKd 0 0 1\n";
    }
    write("m.mtl", library.str());
    const std::clock_t start = std::clock();
    const Scene scene = load(text.str());
    EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 5.0);
    EXPECT_EQ(scene.meshes.size(), std::size_t(kGroups));
    EXPECT_EQ(scene.materials.size(), std::size_t(kGroups));
}

TEST_F(ObjFile, faceIndicesAreCheckedAgainstTheCounts)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_NE(problem(vertices + "f 1 2 9\nf 1 2 3\n").find("line 4: expected a position index up to 3, found 9"),
              std::string::npos);
    EXPECT_NE(problem(vertices + "vn 0 0 1\nf 1//1 2 3\n").find("found a mixture"), std::string::npos);
    EXPECT_NE(problem(vertices + "vn 0 0 1\nf 1 2//1 3//1\n").find("found a mixture"), std::string::npos);
}

TEST_F(ObjFile, uncolouredVerticesAreWhiteAndColoursBecomeLinear)
{
    const Mesh mesh = load("v 1 0 0\nv 0 0 0 0.25 0.5 0.75\nv 0 1 0\nf 1 2 3\n").meshes.at(0);
    EXPECT_EQ(mesh.colors.at(0), glm::vec4(1));
    // IEC 61966-2-1: ((c + 0.055) / 1.055)^2.4.
    EXPECT_NEAR(mesh.colors.at(1).x, 0.050876, 1e-5);
    EXPECT_NEAR(mesh.colors.at(1).y, 0.214041, 1e-5);
    EXPECT_NEAR(mesh.colors.at(1).z, 0.522522, 1e-5);
    EXPECT_EQ(mesh.colors.at(2), glm::vec4(1));
}

TEST_F(ObjFile, linesAndPointsMakeNoMesh)
{
    const Scene scene = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wire\nf 1 2\nf 3\nusemtl skin\nf 1 2 3\n");
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
}

TEST_F(ObjFile, invalidNormalsAreRegeneratedWithAWarning)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const Scene zero = load(vertices + "vn 0 3 4\nvn 0 0 0\nf 1//1 2//1 3//2\n");
    for (const glm::vec3& n : zero.meshes.at(0).normals)
        EXPECT_EQ(n, glm::vec3(0, 0, 1));
    EXPECT_TRUE(mentions(zero, "some normals are zero or missing; all are regenerated"));
    const Scene kept = load(vertices + "vn 0 3 4\nf 1//1 2//1 3//1\n");
    EXPECT_EQ(kept.meshes.at(0).normals.at(0), glm::vec3(0, 0.6f, 0.8f));
    EXPECT_TRUE(kept.warnings.empty());
}

// ---- polygons -----------------------------------------------------------------------------------

using Polygon = std::vector<glm::dvec2>;

double areaOf(const Polygon& p)
{
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        twice += p[i].x * p[(i + 1) % p.size()].y - p[(i + 1) % p.size()].x * p[i].y;
    return twice / 2;
}

// Whether q is inside p, by the crossings of a ray.
bool isInside(const Polygon& p, glm::dvec2 q)
{
    bool inside = false;
    for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
        if ((p[i].y > q.y) != (p[j].y > q.y) && q.x < (p[j].x - p[i].x) * (q.y - p[i].y) / (p[j].y - p[i].y) + p[i].x)
            inside = !inside;
    return inside;
}

Polygon star(int points, double inner)
{
    Polygon p;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = glm::pi<double>() * i / points, r = i % 2 ? inner : 1.0;
        p.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    return p;
}

Polygon comb(int teeth)
{
    Polygon p = {{0, -1}, {double(teeth), -1}};
    for (int i = teeth; i > 0; --i) {
        p.emplace_back(i, 0);
        p.emplace_back(i - 0.5, 10);
    }
    p.emplace_back(0, 0);
    return p;
}

Polygon spiral(int corners)
{
    Polygon p, back;
    for (int i = 0; i < corners / 2; ++i) {
        const double angle = 0.3 * i, r = 1 + 0.1 * angle;
        p.emplace_back(r * std::cos(angle), r * std::sin(angle));
        back.emplace_back((r + 0.3) * std::cos(angle), (r + 0.3) * std::sin(angle));
    }
    p.insert(p.end(), back.rbegin(), back.rend());
    std::ranges::reverse(p);
    return p;
}

const std::vector<std::pair<const char*, Polygon>> kPolygons = {
    {"arrow head", {{0, 0}, {4, -2}, {1, 0}, {4, 2}}},
    // its shorter diagonal is outside
    {"dart", {{0, 0}, {10, -1}, {0.5, 0.2}, {1, 10}}},
    {"pentagon with a notch", {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}},
    {"corners in line", {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}},
    {"L with corners in line", {{0, 0}, {2, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {1, 3}, {0, 3}}},
    {"frame with a bridge", {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}},
    {"star", star(7, 0.3)},
    {"comb", comb(6)},
    {"spiral", spiral(60)},
};

// Places a point of the polygon in one of six planes.
glm::dvec3 placed(glm::dvec2 p, int plane)
{
    switch (plane) {
    case 0: return {p, 5};
    case 1: return {-3, p};
    case 2: return {p.y, 2, p.x};
    case 3: return {p.y, p.x, 0}; // flipped
    case 4: return {p, p.x};      // tilted by 45 degrees
    default: return {p.x, 100 - p.x - 2 * p.y, p.y};
    }
}

std::string faceText(const Polygon& polygon, int plane, std::size_t first)
{
    std::ostringstream text;
    text.precision(9);
    for (const glm::dvec2& p : polygon) {
        const glm::dvec3 q = placed(p, plane);
        text << "v " << q.x << ' ' << q.y << ' ' << q.z << '\n';
    }
    text << 'f';
    for (std::size_t i = 0; i < polygon.size(); ++i)
        text << ' ' << 1 + (first + i) % polygon.size();
    text << '\n';
    return text.str();
}

// The triangles cover every point of the polygon exactly once and nothing outside.
TEST_F(ObjFile, trianglesCoverAPolygonExactlyOnce)
{
    for (const auto& [name, polygon] : kPolygons)
        for (int plane = 0; plane < 6; ++plane)
            for (std::size_t first = 0; first < std::min<std::size_t>(polygon.size(), 5); ++first) {
                SCOPED_TRACE(name + std::string(", plane ") + std::to_string(plane) + ", from "
                             + std::to_string(first));
                const Scene scene = load(faceText(polygon, plane, first));
                const Mesh& mesh = scene.meshes.at(0);
                ASSERT_EQ(mesh.triangleCount(), polygon.size() - 2);
                // Maps vertices back to the polygon's own coordinates.
                const auto back = [&](std::uint32_t i) -> glm::dvec2 {
                    const glm::dvec3 q = mesh.positions[i];
                    return plane == 1 ? glm::dvec2(q.y, q.z)
                        : plane == 2  ? glm::dvec2(q.z, q.x)
                        : plane == 3  ? glm::dvec2(q.y, q.x)
                        : plane == 5  ? glm::dvec2(q.x, q.z)
                                      : glm::dvec2(q);
                };
                double area = 0;
                std::vector<std::array<glm::dvec2, 3>> triangles;
                for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
                    triangles.push_back({back(mesh.indices[t]), back(mesh.indices[t + 1]), back(mesh.indices[t + 2])});
                    const auto& [a, b, c] = triangles.back();
                    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                    EXPECT_GE(twice, -1e-6); // the polygon's winding; corners are rounded to float
                    area += twice / 2;
                }
                EXPECT_NEAR(area, areaOf(polygon), 1e-5 * (1 + std::abs(areaOf(polygon))));
                glm::dvec2 low(1e9), high(-1e9);
                for (const glm::dvec2& p : polygon) {
                    low = glm::min(low, p);
                    high = glm::max(high, p);
                }
                std::mt19937 random(7);
                std::uniform_real_distribution<double> unit(0, 1);
                for (int i = 0; i < 300; ++i) {
                    const glm::dvec2 q = low + (high - low) * glm::dvec2(unit(random), unit(random));
                    int covers = 0;
                    for (const auto& [a, b, c] : triangles)
                        covers += isInside({a, b, c}, q);
                    EXPECT_EQ(covers, isInside(polygon, q) ? 1 : 0) << q.x << ' ' << q.y;
                }
            }
}

TEST_F(ObjFile, aPolygonOfFiveThousandCornersIsQuick)
{
    for (const Polygon& polygon : {star(2500, 0.5), comb(2500), spiral(5000)}) {
        const std::clock_t start = std::clock();
        const Scene scene = load(faceText(polygon, 0, 3));
        EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
        const Mesh& mesh = scene.meshes.at(0);
        double area = 0;
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
            const glm::dvec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                             c = mesh.positions[mesh.indices[t + 2]];
            const double twice = glm::cross(b - a, c - a).z;
            EXPECT_GE(twice, -1e-6);
            area += twice / 2;
        }
        EXPECT_NEAR(area, areaOf(polygon), 1e-5 * areaOf(polygon));
    }
}

TEST_F(ObjFile, quadraticTriangulationIsRefusedInTime)
{
    const std::clock_t start = std::clock();
    EXPECT_NE(problem(faceText(star(100000, 0.5), 0, 0)).find("triangulation steps, at a polygon of 200000"),
              std::string::npos);
    EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 5.0);
    EXPECT_EQ(problem(faceText(star(100000, 0.99999999), 0, 0)), ""); // a circle, up to rounding
}

TEST_F(ObjFile, selfIntersectingPolygonsAreTriangulated)
{
    for (const Polygon& polygon : {Polygon{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, Polygon{{0, 0}, {0, 0}, {0, 0}, {0, 0}},
                                   Polygon{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}},
                                   Polygon{{0, 0}, {2, 0}, {0, 2}, {0, 0}, {2, 2}, {0, 1}, {2, 0}}}) {
        const Scene scene = load(faceText(polygon, 0, 0));
        EXPECT_EQ(scene.meshes.at(0).triangleCount(), polygon.size() - 2);
    }
}

// ---- material libraries ---------------------------------------------------------------------------

TEST_F(ObjFile, statementsBeforeTheFirstNewmtlAreSkippedWithAWarning)
{
    const Scene scene = loadMaterial("Kd 1 0 0\na 1\nmap_Kd x.png\nnewmtl m\nKd 0 1 0\n");
    EXPECT_EQ(materialOf(scene).baseColor, glm::vec4(0, 1, 0, 1));
    EXPECT_TRUE(mentions(scene, "material library m.mtl: 3 lines before the first newmtl are left out"));
}

TEST_F(ObjFile, unreadableMaterialNumbersAreSkippedWithAWarning)
{
    const Scene scene = loadMaterial("newmtl m\nKd red\nNs 1e99\nd\nPr .25\nKd 0.5\nKe nan 0 0\n");
    EXPECT_EQ(materialOf(scene).baseColor, glm::vec4(0.5f, 0.5f, 0.5f, 1)); // a single number is a grey
    EXPECT_EQ(materialOf(scene).roughness, 0.25f);
    EXPECT_EQ(materialOf(scene).emissive, glm::vec3(0));
    EXPECT_TRUE(mentions(scene, "4 lines whose numbers cannot be read are left out, the first is line 2"));
}

TEST_F(ObjFile, transparencyIsOneMinusOpacity)
{
    EXPECT_EQ(materialOf(loadMaterial("newmtl m\nTr 0.25\n")).baseColor[3], 0.75f);
    EXPECT_EQ(materialOf(loadMaterial("newmtl m\nd -halo 0.25\n")).baseColor[3], 0.25f);
    EXPECT_EQ(materialOf(loadMaterial("newmtl m\n")).baseColor[3], 1.0f);
}

TEST_F(ObjFile, namesMayContainSpaces)
{
    write("my materials.mtl", "newmtl red paint\t\r\nmap_Kd -bm 1 -type sphere  my picture.png \r\n");
    const Scene scene =
        load("mtllib my materials.mtl\nusemtl  red paint \nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    EXPECT_EQ(materialOf(scene).name, "red paint");
    EXPECT_TRUE(mentions(scene, "texture my picture.png: no such file"));
}

TEST_F(ObjFile, mtllibListsSeveralLibrariesAndTheFirstDefinitionWins)
{
    write("a.mtl", "newmtl m\nKd 1 0 0\n");
    write("b.mtl", "newmtl m\nKd 0 1 0\nnewmtl n\nKd 0 0 1\n");
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n";
    const Scene scene = load("mtllib a.mtl b.mtl\n" + triangle);
    EXPECT_EQ(materialOf(scene).baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(scene.materials.at(1).baseColor, glm::vec4(0, 0, 1, 1));
    EXPECT_TRUE(scene.warnings.empty());

    const Scene lacking = load("mtllib a.mtl\n" + triangle);
    EXPECT_TRUE(mentions(lacking, "1 parts name materials that no library has, the first is \"n\""));
    write("model.mtl", "newmtl n\nKd 0 0 1\n");
    const Scene beside = load("mtllib gone.mtl\n" + triangle);
    EXPECT_TRUE(mentions(beside, "gone.mtl was not found; model.mtl is read instead"));
    EXPECT_EQ(beside.materials.at(1).baseColor, glm::vec4(0, 0, 1, 1));
}

// u v of the file, v up, become s u + o; here v runs down.
TEST_F(ObjFile, mapsAreScaledShiftedAndClamped)
{
    const Scene scene = loadMaterial("newmtl m\nmap_Kd -s 2 3 1 -o 0.25 0.125 -clamp on 1.png\n");
    EXPECT_TRUE(mentions(scene, "texture 1.png"));
    const Texture& t = materialOf(scene).baseColorMap;
    EXPECT_EQ(t.sampler.wrapU, Wrap::clamp);
    EXPECT_EQ(t.sampler.wrapV, Wrap::clamp);
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(0.5f, 0.75f)}) {
        const glm::vec2 down(uv.x, 1 - uv.y);
        EXPECT_FLOAT_EQ(t.uRow.x * down.x + t.uRow.y * down.y + t.uRow.z, 2 * uv.x + 0.25f);
        EXPECT_FLOAT_EQ(t.vRow.x * down.x + t.vRow.y * down.y + t.vRow.z, 1 - (3 * uv.y + 0.125f));
    }
    EXPECT_EQ(materialOf(loadMaterial("newmtl m\nmap_Kd -clamp off 1.png\n")).baseColorMap.sampler.wrapU, Wrap::repeat);
}

TEST_F(ObjFile, onlyTheClampOptionClampsAndNegativeColoursBecomeZero)
{
    const Texture t = materialOf(loadMaterial("newmtl m\nmap_Kd -blendu on -cc on 1.png\n")).baseColorMap;
    EXPECT_EQ(t.sampler.wrapU, Wrap::repeat);
    EXPECT_EQ(t.sampler.wrapV, Wrap::repeat);
    EXPECT_EQ(materialOf(loadMaterial("newmtl m\nKd -1 0.5 -0.25\n")).baseColor, glm::vec4(0, 0.5f, 0, 1));
}

TEST_F(ObjFile, eachMeshHasTheMaterialOfItsGroup)
{
    write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    const Scene scene = load("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl blue\nf 1 2 3\nusemtl red\nf 1 2 3\n"
                             "g again\nf 1 2 3\n");
    ASSERT_EQ(scene.meshes.size(), 3u);
    const auto colour = [&](std::size_t i) {
        return scene.materials.at(std::size_t(scene.meshes[i].material)).baseColor;
    };
    EXPECT_EQ(colour(0), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(colour(1), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(colour(2), glm::vec4(1, 0, 0, 1));
}

} // namespace
} // namespace cotan
