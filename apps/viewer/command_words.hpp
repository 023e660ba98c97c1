// Shared by the command files: parsing the words of a line, and errors for invalid ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/parse_number.hpp"
#include "cotan/result.hpp"
#include "state.hpp"

namespace cotan::viewer {

// A command line that is parsed word by word.
struct Words {
    std::string rest;

    std::string next()
    {
        const std::size_t start = std::min(rest.find_first_not_of(' '), rest.size());
        const std::size_t end = std::min(rest.find(' ', start), rest.size());
        std::string word = rest.substr(start, end - start);
        rest = rest.substr(std::min(end + 1, rest.size()));
        return word;
    }
    Result<float> number(const char* what)
    {
        const std::string word = next();
        float value = 0;
        if (!parseNumber(std::string_view(word), value) || !std::isfinite(value))
            return usageError(fmt::format("{}: expected a number; found '{}'", what, word));
        return value;
    }
};

inline Status expected(const std::string& command, const std::string& what, const std::string& found)
{
    return usageError(fmt::format("{}: expected {}; found '{}'", command, what, found));
}

// Performs a command that moves the camera or the light; returns nothing for other commands. words: the arguments.
std::optional<Status> performCamera(State& state, const std::string& command, Words& words);

// The camera's azimuth in degrees, which a pinned light follows.
float azimuthOf(const Camera& camera);

} // namespace cotan::viewer
