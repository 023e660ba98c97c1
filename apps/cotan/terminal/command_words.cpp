#include "terminal/command_words.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cotan::app {

namespace {

Error unknown(const std::string& before, const std::string& word, const std::vector<CommandNames>& commands)
{
    // A prefix of a name counts as distance 1.
    const auto distance = [&](const CommandNames& command) {
        return word.size() > 1 && command.name.starts_with(word) ? 1 : editDistance(word, command.name);
    };
    const auto nearest = std::ranges::min_element(commands, {}, distance);
    const bool near = distance(*nearest) <= std::max<std::size_t>(1, nearest->name.size() / 3);
    std::vector<std::string_view> names;
    for (const CommandNames& command : commands)
        names.push_back(command.name);
    return usageError(fmt::format("unknown {}command '{}'; {}", before, word,
                                  near ? fmt::format("did you mean {}?", nearest->name)
                                       : fmt::format("expected one of {}", fmt::join(names, ", "))));
}

} // namespace

std::size_t editDistance(std::string_view a, std::string_view b)
{
    // Optimal string alignment: the Damerau-Levenshtein distance in which no substring is edited twice.
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

Status checkCommandWords(const CommandNames& tool, std::span<const std::string> words)
{
    const CommandNames* at = &tool;
    std::string before;
    for (const std::string& word : words) {
        if (at->commands.empty() || word.starts_with('-'))
            break;
        const auto found = std::ranges::find(at->commands, word, &CommandNames::name);
        if (found == at->commands.end()) {
            if (word.size() > 100)
                return usageError(fmt::format("unknown {}command of {} letters", before, word.size()));
            return unknown(before, word, at->commands);
        }
        before = word + " ";
        at = &*found;
    }
    return Done{};
}

bool asksForHelp(const CommandNames& tool, std::span<const std::string> words)
{
    return !words.empty() && words[0] == "help" && (words.size() == 1 || !words[1].starts_with('-'))
        && std::ranges::find(tool.commands, "help", &CommandNames::name) != tool.commands.end();
}

std::vector<std::string> withoutEquals(std::vector<std::string> words)
{
    for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i)
        if (const std::string word = words[i]; word.size() > 2 && word[0] == '-' && word[1] != '-' && word[2] == '=') {
            words[i] = word.substr(0, 2);
            words.insert(words.begin() + std::ptrdiff_t(i) + 1, word.substr(3));
            ++i;
        }
    return words;
}

} // namespace cotan::app
