// Large models: memory per triangle of `lint` and `convert`, and their refusal when memory does not suffice. Memory is
// bounded here, never time; bench/scans measures both at full size.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/sandbox/confine.hpp"
#include "run_tool.hpp"
#include "scan_model.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

constexpr ScanOptions kSmall{.rows = 4, .mapSide = 256};
constexpr ScanOptions kLarge{.rows = 354, .mapSide = 256}; // 501,264 triangles

class Scans : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TemporaryFolder();
        writeScan(*folder_ / "small.glb", kSmall);
        writeScan(*folder_ / "large.glb", kLarge);
    }
    static void TearDownTestSuite() { delete std::exchange(folder_, nullptr); }

    static const std::filesystem::path& folder() { return folder_->path(); }

    // Bytes per triangle: peak memory of the process, less that with a small mesh and the same map.
    static double bytesATriangle(const std::vector<std::string>& before, const std::vector<std::string>& after)
    {
        const auto megabytes = [&](const char* model) {
            std::vector<std::string> words = before;
            words.emplace_back(model);
            words.insert(words.end(), after.begin(), after.end());
            const ToolRun run = runTool(words, folder(), 300);
            EXPECT_EQ(run.code, 0) << run.err;
            return run.megabytes;
        };
        const double small = megabytes("small.glb");
        return (megabytes("large.glb") - small) * (1 << 20) / double(trianglesOf(kLarge) - trianglesOf(kSmall));
    }

private:
    static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(Scans, lintTakesLessThan200BytesPerTriangle)
{
    if (kSanitized)
        GTEST_SKIP() << "sanitizers take memory of their own";
    EXPECT_LT(bytesATriangle({"lint"}, {"--quiet"}), 200);
}

TEST_F(Scans, convertTakesLessThan150BytesPerTriangle)
{
    if (kSanitized)
        GTEST_SKIP() << "sanitizers take memory of their own";
    for (const char* frame : {"smooth", "cotangent", "orthonormal"})
        EXPECT_LT(bytesATriangle({"convert"}, {"--to-frame", frame, "--bits", "8", "-o", "out.glb", "--quiet"}), 150)
            << frame;
}

// A model that does not fit is refused before any work, whatever its number of triangles.
TEST_F(Scans, modelsThatExceedTheMemoryAreRefused)
{
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"lint", "large.glb"},
          std::vector<std::string>{"convert", "large.glb", "--to-frame", "smooth", "-o", "out.glb"}}) {
        std::vector<std::string> words = command;
        words.insert(words.end(), {"--quiet", "--memory", "20"});
        const ToolRun refused = runTool(words, folder());
        EXPECT_EQ(refused.code, 2) << refused.out;
        EXPECT_EQ(lines(refused.err), 1) << refused.err;
        EXPECT_NE(refused.err.find("large"), std::string::npos) << refused.err;
        EXPECT_NE(refused.err.find("the limit is 20 MiB (--memory raises it)"), std::string::npos) << refused.err;
    }
}

} // namespace
} // namespace cotan
