// CMakeLists.txt defines the version. Other files that repeat it for people and tools must agree.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

struct Copy {
    const char* file;
    const char* pattern; // regular expression for the text before the version
};

TEST(Version, isTheSameInEveryFile)
{
    const std::string number = R"((\d+\.\d+\.\d+))";
    for (const Copy& copy :
         std::vector<Copy>{{"CITATION.cff", "\nversion: "},
                           {"bindings/python/cotan/_version.py", "__version__ = \""},
                           {"cmake/packages/changelog.in", "^cotan \\("},
                           {"integrations/blender/cotan_blender/blender_manifest.toml", "\nversion = \""},
                           {"README.md", "cotan-"},
                           {"bindings/js/README.md", "cotan-"},
                           {"bindings/js/types/tangents.d.ts", "version of the library, \""},
                           {"src/c/include/cotan.h", "/\\* \""}}) {
        const std::string text = readWhole(std::filesystem::path(COTAN_SOURCE_DIR) / copy.file);
        const std::regex pattern(copy.pattern + number);
        auto found = std::sregex_iterator(text.begin(), text.end(), pattern);
        EXPECT_NE(found, std::sregex_iterator()) << copy.file << " no longer says the version";
        for (; found != std::sregex_iterator(); ++found)
            EXPECT_EQ((*found)[1], COTAN_VERSION) << copy.file;
    }
}

TEST(Version, isTheNewestOfTheChangelog)
{
    const std::string text = readWhole(std::filesystem::path(COTAN_SOURCE_DIR) / "CHANGELOG.md");
    const std::size_t begin = text.find("\n## ", text.find("## Unreleased") + 1);
    ASSERT_NE(begin, std::string::npos);
    EXPECT_EQ(text.substr(begin + 4, text.find_first_of(" \n", begin + 4) - begin - 4), COTAN_VERSION);
}

TEST(Version, isTheOneThatExamplesRequest)
{
    const std::regex requested(R"(find_package\(cotan (\d+\.\d+))");
    int found = 0;
    for (const char* folder : {"examples", "docs", "tests/smallest"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(COTAN_SOURCE_DIR) / folder))
            if (entry.path().filename() == "CMakeLists.txt" || entry.path().extension() == ".md") {
                const std::string text = readWhole(entry.path());
                for (auto it = std::sregex_iterator(text.begin(), text.end(), requested); it != std::sregex_iterator();
                     ++it, ++found)
                    EXPECT_TRUE(std::string(COTAN_VERSION).starts_with((*it)[1].str() + ".")) << entry.path();
            }
    EXPECT_GE(found, 6);
}

TEST(Version, isPrintedByTheTool)
{
    TemporaryFolder folder;
    EXPECT_EQ(runTool({"--version"}, folder.path()).out, "cotan " COTAN_VERSION "\n");
}

} // namespace
} // namespace cotan::test
