// The page and the report of a batch: every field of a job, with distinct values. Thumbnails of large images.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include "batch/job.hpp"
#include "batch/report.hpp"
#include "cotan/image.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

// One job of each state, in the order of their names; the first has no other fields.
struct Results {
    JobList list{"/jobs", {}};
    std::vector<JobResult> all;

    Results()
    {
        for (int i = 0; i < 8; ++i) {
            Job job;
            job.name = "job " + std::to_string(i);
            job.words = {"lint", "a b.glb", std::to_string(i)};
            job.line = std::size_t(10 + i);
            list.jobs.push_back(job);
            all.push_back({std::size_t(i), {}, false});
            all.back().record.state = JobState(i);
        }
        JobRecord& r = all[1].record;
        r.code = 5;
        r.signal = 15;
        r.runs = 3;
        r.reason = "over 2 degrees";
        r.output = std::string(1500, 'x');
        r.seconds = 1.23456;
        r.processorSeconds = 2.5;
        r.megabytes = 20.75;
        r.degrees = Degrees{4.5, "between the maps"};
        r.thumbnail = {7, 9, "AAAA"};
        r.inputs = {{"a.glb", "00"}, {"b.png", "01"}};
        r.outputs = {{"out/c d.png", "02"}, {"/report/sub/e~1.txt", "03"}};
        all[1].kept = true;
    }
};

json dataOf(const std::string& page)
{
    const std::string begin = "id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    return json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(BatchReport, aRowOfThePageHasEveryFieldOfItsJob)
{
    Results results;
    const std::string page = batchPage(results.list, results.all, "a & b", "the end", "/report", 8);
    const json data = dataOf(page);
    EXPECT_EQ(data["states"],
              json({"done", "over limit", "not run", "skipped", "failed", "too slow", "out of memory", "crashed"}));
    EXPECT_EQ(data["bad"], json({4, 5, 6, 7}));
    EXPECT_EQ(data["warn"], json({1, 2, 3}));
    ASSERT_EQ(data["rows"].size(), 8u);
    const std::string command = "lint 'a b.glb' ";
    // Worst first: crashed, memory, late, over the limit, refused, skipped, not run, done.
    const int order[] = {7, 6, 5, 1, 4, 3, 2, 0};
    for (std::size_t i = 0; i < 8; ++i) {
        const std::string number = std::to_string(order[i]);
        if (order[i] == 1) {
            EXPECT_EQ(data["rows"][i],
                      json({"job 1",
                            1,
                            4.5,
                            "between the maps",
                            1.235,
                            21.0,
                            command + "1",
                            "over 2 degrees",
                            std::string(1500, 'x'),
                            json::array({json::array({"out/c d.png", "../jobs/out/c%20d.png"}),
                                         json::array({"/report/sub/e~1.txt", "sub/e~1.txt"})}),
                            {"a.glb", "b.png"},
                            {7, 9, "AAAA"},
                            1}));
        } else {
            EXPECT_EQ(data["rows"][i],
                      json({"job " + number, order[i], nullptr, "", 0.0, 0.0, command + number, "", "", json::array(),
                            json::array(), nullptr, 0}));
        }
    }
    EXPECT_NE(page.find("<title>a &amp; b</title>"), std::string::npos);
    EXPECT_NE(page.find("<h1>a &amp; b</h1>"), std::string::npos);
    EXPECT_NE(page.find("<footer>the end</footer>"), std::string::npos) << "all are shown";
    // One button for each state present, worst first, with its number and count.
    results.all.push_back(results.all[4]);
    results.all.erase(results.all.begin() + 6); // no job is out of memory
    const std::string other = batchPage(results.list, results.all, "t", "f", "/report", 8);
    std::size_t at = 0;
    for (const char* button : {"\"7\">1 crashed<", "\"5\">1 too slow<", "\"4\">2 failed<", "\"3\">1 skipped<",
                               "\"2\">1 not run<", "\"1\">1 over limit<", "\"0\">1 done<"})
        ASSERT_NE(at = other.find(std::string("data-state=") + button, at), std::string::npos) << button;
    EXPECT_EQ(other.find("out of memory<"), std::string::npos);
}

// Shows the first 1500 bytes of jobs that are done, and all kept output of others.
TEST(BatchReport, outputOfFinishedJobsIsTruncatedOnThePage)
{
    for (const JobState state :
         {JobState::done, JobState::limit, JobState::skipped, JobState::failed, JobState::crashed})
        for (const std::size_t size : {1500, 1501, 4000}) {
            Results results;
            results.all.resize(1);
            results.all[0].record.state = state;
            results.all[0].record.output = std::string(size, 'y') + "z";
            results.all[0].record.output.erase(0, 1);
            const std::string output = results.all[0].record.output;
            const std::string printed = dataOf(batchPage(results.list, results.all, "", "", "/", 1))["rows"][0][8];
            const bool cut = size > 1500 && (state == JobState::done || state == JobState::limit);
            EXPECT_EQ(printed, cut ? std::string(1500, 'y') + "..." : output) << size << int(state);
        }
}

TEST(BatchReport, asJsonHasTheCountOfEachStateAndEveryFieldOfEachJob)
{
    const Results results;
    const json report = json::parse(toText(batchJson(results.list, results.all)));
    EXPECT_EQ(report["command"], "batch");
    for (const char* state :
         {"done", "over limit", "not run", "skipped", "failed", "too slow", "out of memory", "crashed"})
        EXPECT_EQ(report["counts"][state], 1) << state;
    ASSERT_EQ(report["jobs"].size(), 8u);
    EXPECT_EQ(report["jobs"][3],
              json({{"name", "job 1"},
                    {"line", 11},
                    {"command", {"lint", "a b.glb", "1"}},
                    {"state", "over limit"},
                    {"code", 5},
                    {"signal", 15},
                    {"runs", 3},
                    {"reason", "over 2 degrees"},
                    {"kept", true},
                    {"degrees", 4.5},
                    {"degrees_of", "between the maps"},
                    {"seconds", 1.23456},
                    {"processor_seconds", 2.5},
                    {"megabytes", 20.75},
                    {"inputs", {"a.glb", "b.png"}},
                    {"outputs", {"out/c d.png", "/report/sub/e~1.txt"}}}));
    for (const char* none : {"code", "signal", "degrees", "degrees_of"})
        EXPECT_TRUE(report["jobs"][0][none].is_null()) << none;
    EXPECT_EQ(report["jobs"][0]["name"], "job 7");
    EXPECT_EQ(report["jobs"][7]["kept"], false);
}

TEST(BatchReport, theSummaryCountsStatesInOrderAndReusedResults)
{
    Results results;
    EXPECT_EQ(summaryOf(results.all),
              "8 jobs: 1 done, 1 over limit, 1 not run, 1 skipped, 1 failed, 1 too slow, 1 out of memory, 1 crashed; "
              "1 from an earlier run");
    results.all.resize(1);
    EXPECT_EQ(summaryOf(results.all), "1 job: 1 done");
    results.all.clear();
    EXPECT_EQ(summaryOf(results.all), "0 jobs");
}

TEST(BatchDegrees, areReadFromTheFieldOfEachCommand)
{
    struct Row {
        const char *report, *of;
        double mean;
    };
    for (const Row& row :
         {Row{R"({"command": "bake", "verify": {"all": {"mean_degrees": 3}, "views": 1}})", "against the detailed mesh",
              3},
          {R"({"command": "convert", "maps": [{"degrees_after_rounding": {"mean": 2},
               "degrees_unconverted": {"mean": 1}},
               {"degrees_after_rounding": {"mean": 0.5}, "degrees_unconverted": {"mean": 9}}]})",
           "read with the new frame", 1},
          {R"({"command": "convert", "verify": {"degrees": {"mean_degrees": 4}}})", "drawn, against the original", 4},
          {R"({"command": "compare", "normals": {"mean_degrees": 5}})", "between the frames", 5},
          {R"({"command": "map diff", "angles": {"mean_degrees": 6}})", "between the maps", 6},
          {R"({"command": "tangents", "whole": {"directions": {"mean_degrees": 7}}})", "stored tangents", 7},
          {R"({"command": "lint", "fits": [{"cotangent": {"mean": 8}}]})", "read without tangents", 8}}) {
        const auto degrees = degreesIn(row.report);
        ASSERT_TRUE(degrees) << row.report;
        EXPECT_EQ(degrees->mean, row.mean) << row.report;
        EXPECT_EQ(degrees->of, row.of) << row.report;
    }
}

TEST(BatchJobOptions, areAcceptedUpToTheirBounds)
{
    const TemporaryFolder folder;
    const auto takes = [&](const std::string& member) {
        std::ofstream(folder / "jobs.jsonl", std::ios::binary) << "{\"command\": [\"lint\"], " << member << "}\n";
        return bool(readJobs(folder / "jobs.jsonl", [](Job&) { return Status(Done{}); }));
    };
    for (const auto& [member, least, most, under, over] :
         {std::tuple("limit-memory", "0", "16777216", "-1", "16777217"),
          {"limit-time", "0.001", "1000000", "0.0009", "1000000.1"},
          {"limit-processor-time", "0", "1000000", "-0.001", "1000000.1"},
          {"retries", "0", "100", "-1", "101"},
          {"priority", "-1000000", "1000000", "-1000001", "1000001"}}) {
        const std::string begin = "\"" + std::string(member) + "\": ";
        EXPECT_TRUE(takes(begin + least) && takes(begin + most)) << member;
        EXPECT_FALSE(takes(begin + under)) << member;
        EXPECT_FALSE(takes(begin + over)) << member;
    }
    EXPECT_TRUE(takes("\"name\": \"" + std::string(1000, 'n') + "\""));
    EXPECT_FALSE(takes("\"name\": \"" + std::string(1001, 'n') + "\""));
}

// ---- thumbnails --------------------------------------------------------------------------------

std::string decoded(const std::string& base64)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : base64) {
        if (c == '=')
            break;
        bits = bits << 6 | unsigned(digits.find(c));
        if ((count += 6) >= 8)
            bytes += char(bits >> (count -= 8) & 255u);
    }
    return bytes;
}

class BatchThumbnail : public ::testing::Test {
protected:
    // Decodes the thumbnail of a file; returns an empty image if there is no thumbnail.
    Image of(const std::string& file)
    {
        const auto thumbnail = thumbnailOf(folder / file);
        if (!thumbnail)
            return {};
        const std::string jpeg = decoded(thumbnail->jpeg);
        bytes = jpeg.size();
        std::ofstream(folder / "read.jpg", std::ios::binary) << jpeg;
        auto image = readImage(folder / "read.jpg");
        EXPECT_TRUE(image);
        EXPECT_EQ(image->width, thumbnail->width);
        EXPECT_EQ(image->height, thumbnail->height);
        return std::move(*image);
    }

    // The thumbnail's colour for a uniform image of this type; `color` is red, green, blue and alpha.
    glm::ivec3 colorOf(const std::string& file, PixelType type, std::array<float, 4> color)
    {
        Image image = makeImage(16, 16, type);
        for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i) {
            const float c = color[i % 4];
            if (type == PixelType::unorm8)
                image.bytes8()[i] = std::uint8_t(std::lround(c * 255));
            else if (type == PixelType::unorm16)
                image.words()[i] = std::uint16_t(std::lround(c * 65535));
            else
                image.floats()[i] = c;
        }
        EXPECT_TRUE(writeImage(folder / file, image));
        return colorAt(of(file), 8, 8);
    }

    static glm::ivec3 colorAt(const Image& image, int x, int y)
    {
        if (!hasPixels(image))
            return {};
        const std::uint8_t* p = image.bytes8() + 4 * (y * image.width + x);
        return {p[0], p[1], p[2]};
    }

    static void expectNear(glm::ivec3 found, glm::ivec3 expected)
    {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], 3) << c; // error of JPEG compression
    }

    TemporaryFolder folder;
    std::size_t bytes = 0;
};

TEST_F(BatchThumbnail, fitsInto64PixelsAndKeepsTheAspectRatio)
{
    for (const auto& [from, to] : {std::pair(glm::ivec2(64, 64), glm::ivec2(64, 64)),
                                   {{65, 13}, {64, 13}},
                                   {{256, 64}, {64, 16}},
                                   {{50, 200}, {16, 64}},
                                   {{3, 2}, {3, 2}},
                                   {{1, 300}, {1, 64}},
                                   {{300, 1}, {64, 1}}}) {
        ASSERT_TRUE(writeImage(folder / "a.png", makeImage(from.x, from.y, PixelType::unorm8)));
        const Image image = of("a.png");
        EXPECT_EQ(glm::ivec2(image.width, image.height), to) << from.x << " " << from.y;
    }
    std::ofstream(folder / "text.png") << "no picture";
    EXPECT_FALSE(hasPixels(of("text.png")));
    EXPECT_FALSE(hasPixels(of("missing.png")));
}

TEST_F(BatchThumbnail, averagesThePixelsThatFallOnEachPixel)
{
    // Four quarters; the last one has stripes that are averaged.
    Image image = makeImage(256, 128, PixelType::unorm8);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            std::uint8_t* p = image.bytes8() + 4 * (y * 256 + x);
            const bool right = x >= 128, below = y >= 64;
            const glm::ivec3 c = right && below ? glm::ivec3(x % 2 ? 240 : 40)
                : right                         ? glm::ivec3(200, 180, 160)
                : below                         ? glm::ivec3(60, 80, 100)
                                                : glm::ivec3(90, 90, 120);
            for (int k = 0; k < 3; ++k)
                p[k] = std::uint8_t(c[k]);
            p[3] = 255;
        }
    ASSERT_TRUE(writeImage(folder / "a.png", image));
    const Image small = of("a.png");
    ASSERT_EQ(small.width, 64);
    ASSERT_EQ(small.height, 32);
    expectNear(colorAt(small, 8, 4), {90, 90, 120});
    expectNear(colorAt(small, 56, 4), {200, 180, 160});
    expectNear(colorAt(small, 8, 28), {60, 80, 100});
    expectNear(colorAt(small, 56, 28), glm::ivec3(140));
    // A JPEG of one colour takes 623 bytes with the standard's tables, and less with optimised ones.
    expectNear(colorOf("even.png", PixelType::unorm8, {0.4f, 0.4f, 0.4f, 1}), glm::ivec3(102));
    EXPECT_LT(bytes, 400u);
}

TEST_F(BatchThumbnail, showsTransparencyOverGreyAndNonColoursAsBlack)
{
    expectNear(colorOf("a.png", PixelType::unorm8, {1, 1, 1, 0.25f}), glm::ivec3(159)); // 0.25 + 0.75 / 2
    expectNear(colorOf("b.png", PixelType::unorm16, {0, 0, 0, 0.5f}), glm::ivec3(64));
    expectNear(colorOf("c.png", PixelType::unorm16, {0.7f, 0.6f, 0.5f, 1}), {179, 153, 128});
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    expectNear(colorOf("d.exr", PixelType::float32, {0.5f, 0.5f, 0.5f, 1}), glm::ivec3(128));
    expectNear(colorOf("e.exr", PixelType::float32, {7, 7, 7, 1}), glm::ivec3(255));
    expectNear(colorOf("f.exr", PixelType::float32, {-7, -7, -7, 1}), glm::ivec3(0));
    expectNear(colorOf("g.exr", PixelType::float32, {nan, infinite, -infinite, 1}), glm::ivec3(0));
}

} // namespace
} // namespace cotan
