// `cotan map` as a process: reports, exit codes, files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;

nlohmann::json reportOf(const ToolRun& run)
{
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
}

void expectRefused(const ToolRun& run, int code, const TemporaryFolder& folder, const std::string& output)
{
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_FALSE(fs::exists(folder / output));
}

// Black everywhere: only background. Averages over nothing are not numbers.
TEST(MapCommand, info_prints_no_figures_without_texels)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "black.png", makeImage(16, 8, PixelType::unorm8)));
    const ToolRun text = runTool({"map", "info", "black.png"}, folder.path());
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("no texel has a direction to measure"), std::string::npos) << text.out;
    EXPECT_EQ(text.out.find("mean"), std::string::npos) << text.out;
    const ToolRun report = runTool({"map", "info", "black.png", "--json", "-"}, folder.path());
    const auto j = nlohmann::json::parse(report.out);
    for (const char* figure : {"mean_length", "mean", "mean_tilt_degrees", "tilt_by_10_degrees"})
        EXPECT_TRUE(j.at(figure).is_null()) << figure;
}

TEST(MapCommand, detects_every_texture_of_the_collection)
{
    COTAN_NEEDS_DATA("textures/CONVENTIONS.tsv");
    const fs::path textures = dataFile("textures");
    std::ifstream list(textures / "CONVENTIONS.tsv");
    std::string line;
    std::getline(list, line); // names of the columns
    int seen = 0;
    TemporaryFolder folder;
    while (std::getline(list, line)) {
        const std::string file = line.substr(0, line.find('\t'));
        const std::string truth = line.substr(file.size() + 1, 2);
        const auto report =
            reportOf(runTool({"map", "detect", (textures / file).string(), "--json", "-"}, folder.path()));
        EXPECT_EQ(report["green"], truth == "+Y" ? "up" : truth == "-Y" ? "down" : "undecidable") << file;
        EXPECT_NE(report["exchanged"], "yes") << file;
        ++seen;
    }
    EXPECT_GT(seen, 0);
}

// A relief on the left half; `outside` fills the right half.
Image chartOn(const std::array<std::uint8_t, 4>& outside)
{
    Image map = makeReliefMap(Relief::waves, 128);
    for (std::size_t i = 0; i < map.pixelCount(); ++i)
        if (i % 128 >= 64)
            std::ranges::copy(outside, map.bytes8() + 4 * i);
    return map;
}

TEST(MapCommand, background_between_charts_is_excluded)
{
    TemporaryFolder folder;
    for (const std::array<std::uint8_t, 4>& outside :
         {std::array<std::uint8_t, 4>{0, 0, 0, 255}, {255, 255, 255, 255}, {9, 99, 200, 0}, {128, 128, 255, 255}}) {
        ASSERT_TRUE(writeImage(folder / "map.png", chartOn(outside)));
        const auto detected = reportOf(runTool({"map", "detect", "map.png", "--json", "-"}, folder.path()));
        EXPECT_EQ(detected["green"], "up") << detected;
        const auto info = reportOf(runTool({"map", "info", "map.png", "--json", "-"}, folder.path()));
        EXPECT_EQ(info["contents"], "tangent space");
        EXPECT_NEAR(info["background"].get<double>(), outside[2] == 255 && outside[0] == 128 ? 0 : 0.5, 1e-9);
        EXPECT_EQ(info["below_horizon"], 0);
    }
}

TEST(MapCommand, flat_of_directx_stays_128_in_every_preset)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "flat.png", chartOn({128, 128, 255, 255})));
    for (const std::string to : {"gltf", "opengl", "unity", "unreal", "blender"}) {
        ASSERT_EQ(
            runTool({"map", "convert", "flat.png", "--from", "directx", "--to", to, "-o", "out.png"}, folder.path())
                .code,
            0);
        const auto out = readImage(folder / "out.png");
        ASSERT_TRUE(out);
        EXPECT_EQ(int(out->bytes8()[4 * 100]), 128) << to;
        EXPECT_EQ(int(out->bytes8()[4 * 100 + 1]), 128) << to;
        EXPECT_EQ(int(out->bytes8()[4 * 100 + 2]), 255) << to;
        fs::remove(folder / "out.png");
    }
}

TEST(MapCommand, heights_with_free_borders_honour_the_kernel)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::domes, 64)));
    const auto residualFraction = [&](const std::string& kernel) {
        const auto report = reportOf(
            runTool({"map", "to-height", "map.png", "--free", "--kernel", kernel, "-o", kernel + ".exr", "--json", "-"},
                    folder.path()));
        return report["residual_fraction"].get<double>();
    };
    EXPECT_NE(residualFraction("forward"), residualFraction("spectral"));
    EXPECT_NE(residualFraction("scharr"), residualFraction("central"));
}

TEST(MapCommand, conversion_round_trips_within_rounding)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::domes, 96)));
    for (const char* words : {"directx", "unreal", "unity,xy", "opengl,stereographic"}) {
        const std::string to = words;
        ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf,exact", "--to", to, "--bits", "16", "-o",
                           "there.png"},
                          folder.path())
                      .code,
                  0);
        ASSERT_EQ(runTool({"map", "convert", "there.png", "--from", to, "--to", "gltf,exact", "--bits", "16", "-o",
                           "back.png"},
                          folder.path())
                      .code,
                  0);
        const auto report = reportOf(runTool({"map", "diff", "map.png", "back.png", "--json", "-"}, folder.path()));
        // Steps of 1/32767, two roundings, a slope of 0.92 at most (1/cos = 1.36): 0.005 degrees.
        EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 0.01) << to << report;
    }
}

TEST(MapCommand, float_formats_keep_signed_values)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 32)));
    for (const char* name : {"there.exr", "there.tif"}) {
        ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf,exact", "--to", "gltf,signed", "--bits",
                           "float", "-o", name},
                          folder.path())
                      .code,
                  0);
        const auto report =
            reportOf(runTool({"map", "diff", "map.png", name, "--to", "gltf,signed", "--json", "-"}, folder.path()));
        EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 1e-4) << name; // float rounding
    }
}

TEST(MapCommand, half_floats_keep_directions_within_their_rounding)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 32)));
    ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf,exact", "--to", "directx,signed", "--bits", "half",
                       "-o", "there.exr"},
                      folder.path())
                  .code,
              0);
    const auto report = reportOf(
        runTool({"map", "diff", "map.png", "there.exr", "--to", "directx,signed", "--json", "-"}, folder.path()));
    // 11 bits of fraction: half a step is 2^-12 of each component, at most 0.024 degrees for all three.
    EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 0.025);
    EXPECT_GT(report["angles"]["max_degrees"].get<double>(), 0.001); // proves that it is not stored as float
}

// Writes a Wavefront file with a grid over the whole map; shape: maps (u, v up), each in [0,1], to a position.
template<class Shape> void writeObj(const fs::path& file, int cells, Shape shape)
{
    std::ofstream out(file);
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const glm::dvec3 p = shape(double(i) / cells, double(j) / cells);
            out << "v " << p.x << ' ' << p.y << ' ' << p.z << "\nvt " << double(i) / cells << ' ' << double(j) / cells
                << '\n';
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const int a = j * (cells + 1) + i + 1, b = a + 1, c = b + cells + 1, d = c - 1;
            out << "f " << a << '/' << a << ' ' << b << '/' << b << ' ' << c << '/' << c << ' ' << d << '/' << d
                << '\n';
        }
}

TEST(MapCommand, object_space_of_a_z_plane_is_tangent_space_with_green_up)
{
    TemporaryFolder folder;
    Image map = makeReliefMap(Relief::domes, 48);
    map.height = 30; // the upper part
    map.data.resize(map.pixelCount() * map.bytesPerPixel());
    ASSERT_TRUE(writeImage(folder / "map.png", map));
    writeObj(folder / "plane.obj", 1, [](double u, double v) { return glm::dvec3(u, v, 0); });
    for (const std::string frame : {"cotangent", "smooth", "mikktspace"}) {
        ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf,exact", "--to", "gltf,exact,object", "--mesh",
                           "plane.obj", "--frame", frame, "--bits", "16", "-o", "object.png"},
                          folder.path())
                      .code,
                  0);
        const auto report = reportOf(runTool({"map", "diff", "map.png", "object.png", "--json", "-"}, folder.path()));
        EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 0.002) << frame; // sqrt(3)/2 steps of 1/32767, floats
    }
}

TEST(MapCommand, object_space_round_trips_on_a_bent_mesh)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 64)));
    writeObj(folder / "bent.obj", 8,
             [](double u, double v) { return glm::dvec3(std::sin(2 * u), 0.7 * v + 0.2 * u, std::cos(2 * u)); });
    for (const std::string frame : {"cotangent", "smooth", "mikktspace", "orthonormal"}) {
        const auto convert = [&](const std::string& from, const std::string& to, const std::string& in,
                                 const std::string& out) {
            return runTool({"map", "convert", in, "--from", from, "--to", to, "--mesh", "bent.obj", "--frame", frame,
                            "--bits", "16", "-o", out},
                           folder.path());
        };
        ASSERT_EQ(convert("gltf,exact", "gltf,exact,object", "map.png", "object.png").code, 0);
        ASSERT_EQ(convert("gltf,exact,object", "directx,exact", "object.png", "back.png").code, 0);
        const auto report = reportOf(
            runTool({"map", "diff", "map.png", "back.png", "--to", "directx,exact", "--json", "-"}, folder.path()));
        // Two roundings of 0.0015 degrees; the frame enlarges them by at most 3 (uv 2 x 0.7, sheared by 0.2).
        EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 0.008) << frame;
        const auto difference =
            reportOf(runTool({"map", "diff", "map.png", "object.png", "--json", "-"}, folder.path()));
        EXPECT_GT(difference["angles"]["max_degrees"].get<double>(), 90) << frame; // the mesh bends by 115 degrees
    }
    const auto refuse = [&](std::vector<std::string> words, int code) {
        words.insert(words.begin(), {"map", "convert", "map.png", "--from", "gltf", "-o", "none.png"});
        expectRefused(runTool(words, folder.path()), code, folder, "none.png");
    };
    refuse({"--to", "gltf,object"}, 1);
    refuse({"--to", "directx", "--mesh", "bent.obj"}, 1);
    refuse({"--to", "gltf,object", "--mesh", "missing.obj"}, 2);
    refuse({"--to", "gltf,object", "--mesh", "bent.obj", "--frame", "nobody"}, 1);
    refuse({"--to", "gltf,object", "--mesh", "bent.obj", "--strength", "2"}, 1);
}

// 66,000 triangles in a file of 1 MB once took 64 s on a map of 4096 x 4096.
TEST(MapCommand, too_much_uv_overlap_is_refused_as_by_bakes)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeImage(1, 65535, PixelType::unorm8)));
    const auto convert = [&](int triangles) { // each covers all rows of the map; 612 are allowed (BakeBounds)
        std::ofstream out(folder / "mesh.obj");
        out << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (int i = 0; i < triangles; ++i)
            out << "vt " << 0.001 * i << " -1\nvt " << 1 + 0.001 * i << " -1\nvt 0.5 2\nf 1/-3 2/-2 3/-1\n";
        out.close();
        return runTool({"map", "convert", "map.png", "--from", "gltf", "--to", "gltf,object", "--mesh", "mesh.obj",
                        "--overwrite", "-o", "object.png"},
                       folder.path());
    };
    const ToolRun most = convert(612), more = convert(613);
    EXPECT_EQ(most.code, 0) << most.err;
    EXPECT_EQ(more.code, 2);
    EXPECT_NE(more.err.find("mesh.obj: its triangles overlap in 4.02e+07 rows of texels; expected at most "
                            "4.01e+07: use fewer triangles or a smaller map"),
              std::string::npos)
        << more.err;
}

TEST(MapCommand, heights_round_trip_through_normals)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 96)));
    const auto heights = reportOf(runTool(
        {"map", "to-height", "map.png", "--size", "2", "-o", "height.png", "--kernel", "central", "--json", "-"},
        folder.path()));
    const std::string range = std::to_string(heights["highest"].get<double>() - heights["lowest"].get<double>());
    ASSERT_EQ(
        runTool({"map", "from-height", "height.png", "--size", "2", "--range", range, "-o", "again.png"}, folder.path())
            .code,
        0);
    const auto report = reportOf(runTool({"map", "diff", "map.png", "again.png", "--json", "-"}, folder.path()));
    // 8 bits of the map: at most 0.4 degrees (sqrt(3)/2 steps of 1/127). 16 bits of the heights: half a step of range 9
    // texels/65535 is a slope of 1e-4.
    EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 0.6) << report;
    EXPECT_LT(heights["residual_fraction"].get<double>(), 0.02); // rounding of 1/127/sqrt(12) over slopes of 0.2
}

TEST(MapCommand, free_borders_follow_the_mean_tilt)
{
    TemporaryFolder folder;
    Image slope = makeImage(40, 20, PixelType::unorm8);
    for (std::size_t i = 0; i < slope.pixelCount(); ++i) {
        const std::uint8_t texel[4] = {192, 128, 238, 255}; // falls to the right by 64/110 per texel
        std::copy_n(texel, 4, slope.bytes8() + 4 * i);
    }
    ASSERT_TRUE(writeImage(folder / "map.png", slope));
    const auto h =
        reportOf(runTool({"map", "to-height", "map.png", "--free", "-o", "height.exr", "--json", "-"}, folder.path()));
    EXPECT_NEAR(h["highest"].get<double>() - h["lowest"].get<double>(), 39 * 64.0 / 110, 1e-3);
    const auto flat =
        reportOf(runTool({"map", "to-height", "map.png", "-o", "flat.exr", "--json", "-"}, folder.path()));
    EXPECT_NEAR(flat["highest"].get<double>(), 0, 1e-3);
    EXPECT_NEAR(flat["mean_tilt_degrees"].get<double>(), std::atan(64.0 / 110) * 180 / 3.14159265, 1e-3);
}

TEST(MapCommand, blending_a_flat_map_keeps_the_base_within_rounding)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "base.png", makeReliefMap(Relief::domes, 64)));
    Image flat = makeImage(8, 8, PixelType::unorm8);
    for (std::size_t i = 0; i < flat.pixelCount(); ++i) {
        const std::uint8_t texel[4] = {128, 128, 255, 255};
        std::copy_n(texel, 4, flat.bytes8() + 4 * i);
    }
    ASSERT_TRUE(writeImage(folder / "flat.png", flat));
    for (const std::string mode : {"reoriented", "whiteout", "udn", "slopes"}) {
        ASSERT_EQ(runTool({"map", "blend", "base.png", "flat.png", "--mode", mode, "--tiles", "3x5", "--bits", "16",
                           "-o", "out.png"},
                          folder.path())
                      .code,
                  0);
        const auto report = reportOf(runTool({"map", "diff", "base.png", "out.png", "--json", "-"}, folder.path()));
        EXPECT_LT(report["angles"]["max_degrees"].get<double>(), 0.003)
            << mode; // sqrt(3)/2 steps of 1/32767, and floats
    }
}

// Left half covered: there the maps are equal. Right of it one is flat and the other leans by 45 degrees.
TEST(MapCommand, diff_leaves_out_what_the_mask_has_in_black)
{
    TemporaryFolder folder;
    Image a = makeImage(8, 4, PixelType::unorm8), b = a, mask = a;
    for (std::size_t i = 0; i < a.pixelCount(); ++i) {
        const bool covered = i % 8 < 4;
        const std::uint8_t flat[] = {128, 128, 255, 255}, leaning[] = {218, 128, 218, 255};
        const std::uint8_t green[] = {0, 179, 0, 255}, black[] = {0, 0, 0, 255};
        std::copy_n(flat, 4, a.bytes8() + 4 * i);
        std::copy_n(covered ? flat : leaning, 4, b.bytes8() + 4 * i);
        std::copy_n(covered ? green : black, 4, mask.bytes8() + 4 * i);
    }
    for (const auto& [image, file] : {std::pair(&a, "a.png"), {&b, "b.png"}, {&mask, "mask.png"}})
        ASSERT_TRUE(writeImage(folder / file, *image));
    const auto all = reportOf(runTool({"map", "diff", "a.png", "b.png", "--json", "-"}, folder.path()));
    EXPECT_NEAR(all["angles"]["max_degrees"].get<double>(), 45, 0.1);
    const ToolRun run = runTool(
        {"map", "diff", "a.png", "b.png", "--mask", "mask.png", "--json", "-", "-o", "heat.png"}, folder.path());
    const auto covered = reportOf(run);
    EXPECT_EQ(covered["angles"]["max_degrees"], 0);
    EXPECT_EQ(covered["angles"]["pixels"], 16);
    EXPECT_EQ(covered["masked"], 16);
    EXPECT_EQ(covered["skipped"], 0);
    ASSERT_TRUE(writeImage(folder / "small.png", makeImage(4, 4, PixelType::unorm8)));
    const ToolRun refused = runTool({"map", "diff", "a.png", "b.png", "--mask", "small.png"}, folder.path());
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("small.png: expected 8 x 4 as a.png has, found 4 x 4"), std::string::npos)
        << refused.err;
    EXPECT_EQ(runTool({"map", "diff", "a.png", "b.png", "--mask", "none.png"}, folder.path()).code, 2);
}

// Decoded by other code: OpenImageIO reads DDS and the blocks of KTX2, rounding to 8 bits.
TEST(MapCommand, textures_hold_the_same_normals_with_and_without_compression)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 50)));
    for (const std::string extension : {".dds", ".ktx2"}) {
        const std::string plain = "plain" + extension, blocks = "blocks" + extension;
        ASSERT_EQ(
            runTool({"map", "convert", "map.png", "--from", "opengl", "--to", "directx", "-o", plain}, folder.path())
                .code,
            0);
        const ToolRun same = runTool({"map", "diff", "map.png", plain, "--to", "directx"}, folder.path());
        EXPECT_NE(same.out.find("mean 0.000,"), std::string::npos) << same.out << same.err;
        const ToolRun packed = runTool(
            {"map", "convert", "map.png", "--from", "opengl", "--to", "directx", "--compress", "bc5", "-o", blocks},
            folder.path());
        EXPECT_NE(packed.out.find("bc5: tangent space, two channels"), std::string::npos) << packed.out;
        const auto diff = reportOf(
            runTool({"map", "diff", "map.png", blocks, "--to", "directx,orthographic", "--json", "-"}, folder.path()));
        EXPECT_LT(diff["angles"]["mean_degrees"].get<double>(), 1.5) << diff; // steps of a seventh, waves of 25 texels
        EXPECT_EQ(fs::file_size(folder / blocks), 13u * 13 * 16 + (extension == ".dds" ? 148 : 80 + 24 + 60 + 44));
        const std::string three = "three" + extension;
        const ToolRun packed7 = runTool(
            {"map", "convert", "map.png", "--from", "opengl", "--to", "directx", "--compress", "bc7", "-o", three},
            folder.path());
        EXPECT_NE(packed7.out.find("bc7: tangent space, xyz"), std::string::npos) << packed7.out;
        const auto diff7 =
            reportOf(runTool({"map", "diff", "map.png", three, "--to", "directx", "--json", "-"}, folder.path()));
        EXPECT_LT(diff7["angles"]["mean_degrees"].get<double>(), 4) << diff7; // one line per block
        const auto image = readImage(folder / three);
        ASSERT_TRUE(image);
        EXPECT_EQ(image->bytes8()[3], 255);
    }
}

TEST(MapCommand, mips_are_written_all_or_none)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 8)));
    std::ofstream(folder / "level_0.png") << "older";
    fs::create_directory(folder / "level_roughness_2.png"); // prevents writing the sixth of eight files
    const ToolRun run = runTool({"map", "mips", "map.png", "-o", "level.png"}, folder.path());
    EXPECT_EQ(run.code, 4) << run.err;
    EXPECT_EQ(fs::file_size(folder / "level_0.png"), 5u);
    for (const char* name : {"level_roughness_0.png", "level_1.png", "level_2.png"})
        EXPECT_FALSE(fs::exists(folder / name)) << name;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3); // no partial files either
}

TEST(MapCommand, two_channel_compressed_mips_write_roughness_to_a_second_file)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 32)));
    ASSERT_EQ(runTool({"map", "mips", "map.png", "-o", "level.png"}, folder.path()).code, 0);
    for (const std::string extension : {".dds", ".ktx2"}) {
        const ToolRun run =
            runTool({"map", "mips", "map.png", "--compress", "bc5", "-o", "chain" + extension}, folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
        const auto grey = readImage(folder / ("chain_roughness" + extension)),
                   file = readImage(folder / "level_roughness_0.png");
        ASSERT_TRUE(grey && file);
        for (std::size_t i = 0; i < 4 * grey->pixelCount(); i += 4)
            EXPECT_NEAR(grey->bytes8()[i], file->bytes8()[i], 1);
    }
    // 32 to 1: blocks of 64 + 16 + 4 + 1 + 1 + 1.
    EXPECT_EQ(fs::file_size(folder / "chain.dds"), 148u + 87 * 16);
    EXPECT_EQ(fs::file_size(folder / "chain_roughness.dds"), 148u + 87 * 8);
}

TEST(MapCommand, four_channel_compressed_mips_are_one_file)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 32)));
    ASSERT_EQ(runTool({"map", "mips", "map.png", "-o", "level.png"}, folder.path()).code, 0);
    for (const std::string extension : {".dds", ".ktx2"}) {
        ASSERT_EQ(
            runTool({"map", "mips", "map.png", "--compress", "bc7", "-o", "chain" + extension}, folder.path()).code, 0);
        EXPECT_FALSE(fs::exists(folder / ("chain_roughness" + extension)));
        const auto both = readImage(folder / ("chain" + extension)),
                   rough = readImage(folder / "level_roughness_0.png");
        ASSERT_TRUE(both && rough);
        for (std::size_t i = 0; i < 4 * both->pixelCount(); i += 4)
            EXPECT_NEAR(both->bytes8()[i + 3], rough->bytes8()[i], 4); // the fit weighs a code like 0.45 degrees
    }
    EXPECT_EQ(fs::file_size(folder / "chain.dds"), 148u + 87 * 16);
}

TEST(MapCommand, options_that_textures_cannot_store_are_refused_in_one_line)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 8)));
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--compress", "bc1", "-o", "x.dds"},
         "--compress: expected one of none, bc3, bc5, bc5-snorm, bc7, uastc, eac-rg11, astc-4x4, astc-5x4, astc-5x5, "
         "astc-6x5, "
         "astc-6x6, astc-8x5, astc-8x6, astc-8x8; found 'bc1'"},
        {{"--to", "gltf,orthographic", "--compress", "bc7", "-o", "x.ktx2"}, "--to: bc7 holds x, y and z"},
        {{"--compress", "bc5", "-o", "x.png"}, "--compress: blocks are for .dds and .ktx2 files"},
        {{"--bits", "16", "-o", "x.ktx2"}, "--bits: expected 8 or auto, as .ktx2 files have 8 bits; found '16'"},
        {{"--to", "gltf,slope", "--compress", "bc5", "-o", "x.ktx2"}, "--to: bc5 holds x and y"},
        {{"--to", "gltf,signed", "-o", "x.ktx2"}, "--to: signed values"},
        {{"--keep-lengths", "--compress", "bc5", "-o", "x.ktx2"}, "--keep-lengths: bc5"}};
    for (const auto& [words, why] : cases) {
        std::vector<std::string> all = {"map", "mips", "map.png"};
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun run = runTool(all, folder.path());
        EXPECT_EQ(run.code, 1) << why;
        EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
        EXPECT_FALSE(fs::exists(folder / words.back()));
    }
}

TEST(MapCommand, mips_are_written_as_a_standard_dds_or_as_files)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::bricks, 32)));
    const auto report = reportOf(runTool({"map", "mips", "map.png", "-o", "chain.dds", "--json", "-"}, folder.path()));
    EXPECT_EQ(report["levels"].size(), 6u);
    EXPECT_EQ(fs::file_size(folder / "chain.dds"), 128u + 4 * (1024 + 256 + 64 + 16 + 4 + 1));
    ASSERT_EQ(runTool({"map", "mips", "map.png", "-o", "level.png"}, folder.path()).code, 0);
    const auto dds = readImage(folder / "chain.dds"), file = readImage(folder / "level_0.png");
    ASSERT_TRUE(dds && file);
    ASSERT_EQ(dds->type, PixelType::unorm8);
    for (std::size_t i = 0; i < dds->pixelCount(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(dds->bytes8()[4 * i + c], file->bytes8()[4 * i + c]);
    EXPECT_TRUE(fs::exists(folder / "level_5.png"));
    EXPECT_TRUE(fs::exists(folder / "level_roughness_5.png"));
}

TEST(MapCommand, bad_input_is_refused_in_one_line)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 32)));
    std::ofstream(folder / "text.png") << "not a picture";
    std::ofstream(folder / "empty.png").flush();
    const auto convert = [&](const std::string& file, const std::string& to, const std::string& out,
                             const std::string& bits) {
        return runTool({"map", "convert", file, "--from", "gltf", "--to", to, "-o", out, "--bits", bits},
                       folder.path());
    };
    expectRefused(convert("text.png", "directx", "out.png", "auto"), 2, folder, "out.png");
    expectRefused(convert("empty.png", "directx", "out.png", "auto"), 2, folder, "out.png");
    expectRefused(convert("missing.png", "directx", "out.png", "auto"), 2, folder, "out.png");
    expectRefused(convert("map.png", "directy", "out.png", "auto"), 1, folder, "out.png");
    expectRefused(convert("map.png", "", "out.png", "auto"), 1, folder, "out.png");
    expectRefused(convert("map.png", "directx,signed", "out.png", "auto"), 1, folder, "out.png");
    expectRefused(convert("map.png", "directx", "out.png", "float"), 1, folder, "out.png");
    expectRefused(convert("map.png", "directx", "out.jpg", "16"), 1, folder, "out.jpg");
    expectRefused(convert("map.png", "directx", "out.xyz", "auto"), 1, folder, "out.xyz");
    expectRefused(convert("map.png", "directx", "none/out.png", "auto"), 4, folder, "none");
    const auto refused = [&](std::vector<std::string> words, int code) {
        words.insert(words.begin(), "map");
        words.insert(words.end(), {"-o", "none.png"});
        expectRefused(runTool(words, folder.path()), code, folder, "none.png");
    };
    refused({"from-height", "map.png", "--size", "2"}, 1);
    refused({"from-height", "map.png", "--size", "2y", "--range", "1"}, 1);
    refused({"from-height", "map.png", "--kernel", "spectral"}, 1);
    refused({"from-height", "map.png", "--wrap", "border"}, 1);
    refused({"to-height", "map.png", "--size", "0x1"}, 1);
    refused({"to-height", "text.png"}, 2);
    refused({"blend", "map.png", "map.png", "--mode", "multiply"}, 1);
    refused({"blend", "map.png", "map.png", "--tiles", "0"}, 1);
    refused({"blend", "map.png", "missing.png"}, 2);
    refused({"mips", "map.png", "--roughness", "2"}, 1);
    refused({"mips", "map.png", "--model", "magic"}, 1);
    expectRefused(runTool({"map"}, folder.path()), 1, folder, "none");
    expectRefused(runTool({"map", "diff", "map.png", "map.png", "--from", "nobody"}, folder.path()), 1, folder, "none");
}

TEST(MapCommand, whole_images_over_the_memory_limit_are_refused_before_allocation)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 600))); // 1.4 MB
    for (const std::string command : {"to-height", "mips"}) {
        const ToolRun run = runTool({"map", command, "map.png", "--memory", "1", "-o", "none.png"}, folder.path());
        expectRefused(run, 2, folder, "none.png");
        EXPECT_NE(run.err.find("--memory"), std::string::npos) << run.err;
    }
    EXPECT_EQ(runTool({"map", "info", "map.png", "--memory", "1"}, folder.path()).code, 0); // read by rows
}

TEST(MapCommand, degenerate_images_are_handled)
{
    TemporaryFolder folder;
    Image one = makeImage(1, 1, PixelType::unorm8), wide = makeImage(301, 1, PixelType::unorm16);
    Image nan = makeImage(7, 5, PixelType::float32);
    std::fill_n(nan.floats(), 7 * 5 * 4, std::numeric_limits<float>::quiet_NaN());
    ASSERT_TRUE(writeImage(folder / "one.png", one));
    ASSERT_TRUE(writeImage(folder / "wide.png", wide));
    ASSERT_TRUE(writeImage(folder / "nan.exr", nan));
    for (const std::string file : {"one.png", "wide.png", "nan.exr"}) {
        EXPECT_EQ(runTool({"map", "info", file}, folder.path()).code, 0) << file;
        const auto report = reportOf(runTool({"map", "detect", file, "--json", "-"}, folder.path()));
        EXPECT_EQ(report["green"], "undecidable") << file;
        EXPECT_EQ(
            runTool({"map", "convert", file, "--from", "gltf", "--to", "directx", "--bits", "8", "-o", file + ".png"},
                    folder.path())
                .code,
            0)
            << file;
        EXPECT_EQ(runTool({"map", "diff", file, file, "-o", "heat.png"}, folder.path()).code, 0) << file;
        for (const std::vector<std::string>& words : {std::vector<std::string>{"from-height", file},
                                                      {"to-height", file},
                                                      {"to-height", file, "--free"},
                                                      {"blend", file, file},
                                                      {"mips", file}}) {
            std::vector<std::string> all{"map"};
            all.insert(all.end(), words.begin(), words.end());
            all.insert(all.end(), {"-o", "out.png"});
            const ToolRun run = runTool(all, folder.path());
            EXPECT_EQ(run.code, 0) << words[0] << " " << file << " " << run.err;
        }
    }
}

TEST(MapCommand, the_same_bytes_for_any_number_of_threads)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::bricks, 128)));
    for (const std::string threads : {"1", "2", "5"}) {
        ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf", "--to", "unreal,stereographic", "--dither",
                           "--threads", threads, "-o", threads + ".png"},
                          folder.path())
                      .code,
                  0);
        ASSERT_EQ(
            runTool({"map", "detect", "map.png", "--threads", threads, "--json", threads + ".json"}, folder.path())
                .code,
            0);
        ASSERT_EQ(runTool({"map", "to-height", "map.png", "--threads", threads, "-o", "height" + threads + ".png"},
                          folder.path())
                      .code,
                  0);
        ASSERT_EQ(
            runTool({"map", "mips", "map.png", "--threads", threads, "-o", "mips" + threads + ".dds"}, folder.path())
                .code,
            0);
        EXPECT_EQ(readWhole(folder / ("height" + threads + ".png")), readWhole(folder / "height1.png"));
        EXPECT_EQ(readWhole(folder / ("mips" + threads + ".dds")), readWhole(folder / "mips1.dds"));
        EXPECT_EQ(readWhole(folder / (threads + ".png")), readWhole(folder / "1.png"));
        EXPECT_EQ(readWhole(folder / (threads + ".json")), readWhole(folder / "1.json"));
    }
}

} // namespace
} // namespace cotan
