// Files that tests need and that the repository does not contain. docs/project/testing.md says where they come from.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace cotan::test {

// A file or folder of the test data: that of ../shared/data if it exists there, otherwise that of build/data, where
// scripts/test-data puts it. COTAN_TEST_DATA=fetched in the environment leaves ../shared/data out.
// tests/web/data.mjs and tests/python/conftest.py have the same rule.
inline std::filesystem::path dataFile(const std::string& name)
{
    const std::filesystem::path shared = std::filesystem::path(COTAN_SOURCE_DIR "/../shared/data") / name;
    const char* const wanted = std::getenv("COTAN_TEST_DATA");
    const bool both = wanted == nullptr || wanted != std::string_view("fetched");
    return both && std::filesystem::exists(shared) ? shared
                                                   : std::filesystem::path(COTAN_SOURCE_DIR "/build/data") / name;
}

inline bool hasData(const std::string& name) { return std::filesystem::exists(dataFile(name)); }

// Skips the test if a file or folder of the test data is missing.
#define COTAN_NEEDS_DATA(name)                                                                                         \
    if (!cotan::test::hasData(name))                                                                                   \
    GTEST_SKIP() << (name) << " is missing: run scripts/test-data"

// Whether the file is the published one of that name, and not a model with the same traits: by its checksum. Numbers
// that were measured on published files hold for these only.
inline bool isOriginal(const std::string& name)
{
    std::ifstream list(COTAN_SOURCE_DIR "/tests/test_data/originals.sha256");
    for (std::string line; std::getline(list, line);)
        if (line.ends_with("  " + name)) {
            const std::string command = "echo '" + line.substr(0, 64) + "  " + dataFile(name).string()
                + "' | sha256sum --check --status 2> /dev/null";
            return std::system(command.c_str()) == 0;
        }
    ADD_FAILURE() << "tests/test_data/originals.sha256 does not list " << name;
    return false;
}

} // namespace cotan::test
