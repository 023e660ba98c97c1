#include "files/folder.hpp"

#include <algorithm>
#include <system_error>

namespace cotan {

namespace fs = std::filesystem;

std::optional<fs::path> findInFolder(const fs::path& folder, std::string request, bool& outside)
{
    outside = false;
    std::ranges::replace(request, '\\', '/');
    if (request.empty() || request.find('\0') != std::string::npos)
        return std::nullopt;

    // An absolute path replaces the folder here; it is fine only if it leads back into it.
    std::error_code error;
    const fs::path wanted = fs::weakly_canonical(folder / request, error);
    if (error)
        return std::nullopt;
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), wanted.begin(), wanted.end());
    if (end != folder.end()) {
        outside = true;
        return std::nullopt;
    }
    if (!fs::is_regular_file(wanted, error))
        return std::nullopt;
    return wanted;
}

} // namespace cotan
