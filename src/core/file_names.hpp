// Names of objects, materials and images as names of files. All programs that name files after them ask here.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cotan {

// Part of a file name for any name: 1 to about 64 bytes of UTF-8 that neither leave the folder nor mean a device on any
// file system. Other characters than letters, digits, '-', '_' and '.' become '_', as do bytes that are no UTF-8. If
// `taken` says so, it gets a number: lid, lid-2, lid-3.
std::string fileNamePart(std::string_view name, const std::function<bool(const std::string&)>& taken = {});

// The same for each of the names. All differ, also where upper and lower case are the same (ASCII), from one another
// and from `taken`. A name that needs no change keeps it, whichever others there are.
std::vector<std::string> fileNameParts(const std::vector<std::string>& names,
                                       const std::vector<std::string>& taken = {});

} // namespace cotan
