#include "files/plan.hpp"

#include <set>
#include <system_error>

#include <fmt/format.h>

#include "files/file_registry.hpp"
#include "files/output.hpp"

namespace cotan {

std::vector<PlannedOutput> plannedIn(const std::string& option, const std::filesystem::path& folder,
                                     const std::vector<std::string>& names)
{
    std::vector<PlannedOutput> files;
    for (const std::string& name : names)
        files.push_back({option, folder / name, /*makesFolder*/ true});
    return files;
}

Result<std::vector<std::string>> planOutputs(std::vector<PlannedOutput> files)
{
    std::erase_if(files, [](const PlannedOutput& output) { return output.file.empty(); });
    for (const PlannedOutput& output : files)
        if (Status planned = planOutput(output.option, output.file); !planned)
            return planned.error();
    std::set<std::filesystem::path> folders, made;
    for (const PlannedOutput& output : files) {
        const std::filesystem::path folder =
            (output.file.has_parent_path() ? output.file.parent_path() : ".").lexically_normal();
        folders.insert(folder);
        if (output.makesFolder)
            made.insert(folder);
        if (Status writable = checkWritable(output.file, made.contains(folder)); !writable)
            return writable.error();
    }
    std::vector<std::string> left;
    for (const std::filesystem::path& folder : folders)
        if (const auto parts = leftParts(folder); !parts.empty())
            left.push_back(
                fmt::format("{}: {} unfinished file{} of a run that was killed, {}{}; delete what is not needed",
                            folder.string(), parts.size(), parts.size() > 1 ? "s" : "",
                            parts.front().filename().string(), parts.size() > 1 ? " and others" : ""));
    return left;
}

Status makeFolder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        return outputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                       error ? error.message() : "a file is in the way"));
    return Done{};
}

} // namespace cotan
