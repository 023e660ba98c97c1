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

Error unknownWord(const std::string& option, const std::vector<std::string_view>& known, const std::string& word)
{
    std::string list;
    for (std::size_t i = 0; i < known.size(); ++i)
        list += (i == 0 ? "" : i + 1 == known.size() ? " or " : ", ") + std::string(known[i]);
    return usageError(fmt::format("{}: expected {}; found '{}'", option, list, word));
}

Error notOneOf(const std::string& option, const std::vector<std::string_view>& known, const std::string& word)
{
    return usageError(fmt::format("{}: expected one of {}; found '{}'", option, fmt::join(known, ", "), word));
}

} // namespace cotan::app
