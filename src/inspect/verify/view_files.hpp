// Compared views as files and for a report.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cotan/inspect.hpp"
#include "cotan/result.hpp"
#include "files/report/json.hpp"

namespace cotan {

// What the pictures of a view are called: NAME-0.png, NAME-1.png and so on.
struct ViewNames {
    const char *expected, *drawn, *difference;
};

inline constexpr ViewNames kConversionNames = {"before", "after", "difference"}, kBakeNames = {"high", "low", "error"};

// The files of so many views.
std::vector<std::string> picturesOf(const ViewNames& names, std::size_t views);

// Writes the pictures of all views into a folder that is there. Errors: as writeImage.
Status writeViews(const ComparedViews& compared, const ViewNames& names, const std::filesystem::path& folder);

// The degrees of each.
Json viewsOf(const ComparedViews& compared);

} // namespace cotan
