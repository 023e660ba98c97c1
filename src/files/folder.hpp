// The only folder that a model may open files from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cotan {

// The file that `request`, as a model writes it, stands for: relative to `folder` (canonical), with
// either slash. Nothing where it is missing or leads out of the folder, by an absolute path, by
// ".." or by a symbolic link; `outside` is set in the latter case.
std::optional<std::filesystem::path> findInFolder(const std::filesystem::path& folder, std::string request,
                                                  bool& outside);

} // namespace cotan
