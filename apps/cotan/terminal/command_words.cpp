#include "terminal/command_words.hpp"

#include <algorithm>
#include <vector>

namespace cotan::app {

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

std::vector<std::string> splitAtCommas(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t at = 0; !text.empty() && at <= text.size(); at += words.back().size() + 1)
        words.push_back(text.substr(at, text.find(',', at) - at));
    return words;
}

std::string quoted(const std::string& path)
{
    const bool plain = path.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./")
        == std::string::npos;
    std::string text = "'";
    for (char c : path)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return plain && !path.empty() ? path : text + "'";
}

} // namespace cotan::app
