// What an option's value has to be: each gives a check that returns an empty text for a good value, and for others what
// was expected and found.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace cotan {

using ValueCheck = std::function<std::string(const std::string&)>;

ValueCheck numberAbove0(); // and at most 1e6
ValueCheck numberAbove0Or(const std::string& word);
ValueCheck numberWithin(double least, double most);
ValueCheck wholeNumberWithin(long long least, long long most);
ValueCheck wholeNumberOf(const std::vector<long long>& numbers);
ValueCheck wordOf(const std::vector<std::string>& words);

} // namespace cotan
