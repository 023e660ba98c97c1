// Shared by the command files: parsing the words of a line, and errors for invalid ones.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/parse_number.hpp"
#include "cotan/result.hpp"
#include "event.hpp"
#include "state.hpp"

namespace cotan::viewer {

// A command line that is parsed word by word.
struct Words {
    std::string rest;

    std::string next() { return nextWord(rest); }
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
