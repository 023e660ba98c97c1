#include "command_words.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cotan::app {

namespace {

std::vector<std::string> namesIn(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

Error unknown(const std::string& before, const std::string& word, const std::vector<std::string>& names)
{
    // The beginning of a name counts as one letter left out.
    const auto distance = [&](const std::string& name) {
        return word.size() > 1 && name.starts_with(word) ? 1 : editDistance(word, name);
    };
    const auto nearest = std::ranges::min_element(names, {}, distance);
    const bool near = distance(*nearest) <= std::max<std::size_t>(1, nearest->size() / 3);
    return usageError(fmt::format("{}there is no command '{}'; {}", before, word,
                                  near ? fmt::format("did you mean {}?", *nearest)
                                       : fmt::format("expected one of {}", fmt::join(names, ", "))));
}

} // namespace

std::size_t editDistance(std::string_view a, std::string_view b)
{
    // Rows of the table of distances between beginnings (Damerau, Levenshtein; neighbours exchanged once).
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

Status checkCommandWords(const CLI::App& app, std::span<char* const> words)
{
    const CLI::App* at = &app;
    std::string before;
    for (const std::string word : words) {
        const auto names = namesIn(*at);
        if (names.empty() || word.starts_with('-'))
            break;
        if (std::ranges::find(names, word) == names.end()) {
            if (word.size() > 100)
                return usageError(before + "there is no command of such a length");
            return unknown(before, word, names);
        }
        before = word + ": ";
        at = at->get_subcommand(word);
    }
    return Done{};
}

} // namespace cotan::app
