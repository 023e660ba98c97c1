#include "file_output.hpp"

#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace cotan::app {

Status writeFileWhole(const std::filesystem::path& file, const std::string& text)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    const bool special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)
        && !std::filesystem::is_directory(status);
    std::filesystem::path beside = file;
    if (!special) // a pipe or a device is written to, not replaced
        beside += fmt::format(".{}.part", ::getpid());
    {
        std::ofstream stream(beside, std::ios::binary);
        stream.write(text.data(), std::streamsize(text.size()));
        stream.close();
        if (!stream) {
            if (!special)
                std::filesystem::remove(beside, error);
            return outputError(fmt::format("{}: cannot write", file.string()));
        }
    }
    if (special)
        return Done{};
    std::filesystem::rename(beside, file, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        return outputError(fmt::format("{}: cannot write: {}", file.string(), error.message()));
    }
    return Done{};
}

Status checkFolderOf(const std::filesystem::path& file)
{
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return outputError(fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
    return Done{};
}

} // namespace cotan::app
