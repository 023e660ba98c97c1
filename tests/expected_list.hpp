// The lists of malformed and hostile files of the test data, with the expected outcome of each.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "test_data.hpp"

namespace cotan::test {

// Limit of processor time for bad input. Builds with sanitizers need several times as much.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr double kBadInputSeconds = 30;
#else
inline constexpr double kBadInputSeconds = 5;
#endif

struct Expected {
    std::filesystem::path file;
    std::string verdict; // reject, accept, warn, either
};

// The rows of both folders, bad (collected) and found (by stress tests), whose file has this extension; empty if the
// folders are missing.
inline std::vector<Expected> expectedFor(const std::string& extension)
{
    std::vector<Expected> rows;
    for (const char* const name : {"bad", "found"}) {
        const std::filesystem::path folder = dataFile(name);
        std::ifstream list(folder / "EXPECTED.tsv");
        for (std::string line; std::getline(list, line);) {
            std::istringstream fields(line);
            std::string file, verdict;
            if (line.starts_with('#') || !std::getline(fields, file, '\t') || !std::getline(fields, verdict, '\t'))
                continue;
            if (std::filesystem::path(file).extension() == extension)
                rows.push_back({folder / file, verdict});
        }
    }
    return rows;
}

} // namespace cotan::test
