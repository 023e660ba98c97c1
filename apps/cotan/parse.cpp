#include "parse.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cotan::app {

std::vector<std::string> presetWords()
{
    std::vector<std::string> words;
    for (const ConventionPreset& p : conventionPresets())
        words.emplace_back(p.name);
    return words;
}

std::vector<std::string> splitAtCommas(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t at = 0; !text.empty() && at <= text.size(); at += words.back().size() + 1)
        words.push_back(text.substr(at, text.find(',', at) - at));
    return words;
}

Result<Frame> parseFrame(const std::string& text, std::string_view option)
{
    if (const auto frame = frameFromName(text))
        return *frame;
    return usageError(fmt::format("{}: expected one of {}; found '{}'", option, frameNames(), text));
}

Error unknownWord(const std::string& option, const std::vector<std::string_view>& known, const std::string& word)
{
    return usageError(fmt::format("{}: expected {}; found '{}'", option, eitherOf({known.begin(), known.end()}), word));
}

Error notOneOf(const std::string& option, const std::vector<std::string_view>& known, const std::string& word)
{
    return usageError(fmt::format("{}: expected one of {}; found '{}'", option, fmt::join(known, ", "), word));
}

} // namespace cotan::app
