// Checks for option values. Each returns an empty text for a good value, otherwise what was expected and found.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace cotan {

using ValueCheck = std::function<std::string(const std::string&)>;

ValueCheck numberAbove0(); // above 0 and at most 1e6
ValueCheck numberAbove0Or(const std::string& word);
ValueCheck numberWithin(double minimum, double maximum);
ValueCheck wholeNumberWithin(long long minimum, long long maximum);
ValueCheck wholeNumberOf(const std::vector<long long>& numbers);
ValueCheck wordOf(const std::vector<std::string>& words);

} // namespace cotan
