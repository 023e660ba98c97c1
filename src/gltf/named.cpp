#include "named.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/ranges.h>

#include "core/parse_number.hpp"
#include "problem.hpp"

namespace cotan {

std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what)
{
    if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
        return std::size_t(found - names.begin());
    std::size_t number = 0;
    if (parseNumber(std::string_view(wanted), number) && number < names.size())
        return number;
    throw GltfProblem{usageError(
        names.empty() ? fmt::format("expected a model with {} for \"{}\", it has none", what, wanted)
                      : fmt::format("expected one of its {} {} by number or name ({}), found \"{}\"", names.size(),
                                    what, oneLine(fmt::format("{}", fmt::join(names, ", "))), wanted))};
}

} // namespace cotan
