// Modules that a program loads on demand, and the messages for missing or broken ones.
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "files/module.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

const auto kRight = [](const void* offered) { return std::strcmp(static_cast<const char*>(offered), "7") == 0; };

Result<const void*> loaded(const std::string& folder, const char* entry, const std::function<bool(const void*)>& fits)
{
    return loadModule({MODULE_NAME, "no/such", folder.c_str(), ""}, entry, fits, "this thing");
}

TEST(Module, isLoadedOnlyIfItsVersionMatches)
{
    const auto other = loaded(MODULE_FOLDER, "versionSix", kRight);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().kind, ErrorKind::unavailable);
    EXPECT_EQ(other.error().message,
              "this thing needs the module " MODULE_NAME ": " MODULE_FOLDER "/" MODULE_NAME " has a different version");
    const auto without = loaded(MODULE_FOLDER, "noSuchEntry", [](const void*) { return true; });
    EXPECT_FALSE(without);
    const auto nothing = loaded(MODULE_FOLDER, "offersNothing", [](const void*) { return true; });
    EXPECT_FALSE(nothing);
    const auto right = loaded(MODULE_FOLDER, "versionSeven", kRight);
    ASSERT_TRUE(right) << right.error().message;
    EXPECT_STREQ(static_cast<const char*>(*right), "7");
}

TEST(Module, missingOrBrokenModulesAreReported)
{
    const test::TemporaryFolder folder;
    const auto missing = loaded(folder.path().string(), "versionSeven", kRight);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "this thing needs the module " MODULE_NAME ": not found");
    std::ofstream(folder / MODULE_NAME) << "no library";
    const auto broken = loaded(folder.path().string(), "versionSeven", kRight);
    ASSERT_FALSE(broken);
    EXPECT_NE(broken.error().message.find((folder / MODULE_NAME).string()), std::string::npos)
        << broken.error().message;
}

} // namespace
} // namespace cotan
