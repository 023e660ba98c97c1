#include "file_output.hpp"

#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace cotan::app {

Status writeFileWhole(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::path beside = file;
    beside += fmt::format(".{}.part", ::getpid());
    std::error_code error;
    {
        std::ofstream stream(beside, std::ios::binary);
        stream.write(text.data(), std::streamsize(text.size()));
        stream.close();
        if (!stream) {
            std::filesystem::remove(beside, error);
            return outputError(fmt::format("{}: cannot write", file.string()));
        }
    }
    std::filesystem::rename(beside, file, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        return outputError(fmt::format("{}: cannot write: {}", file.string(), error.message()));
    }
    return Done{};
}

} // namespace cotan::app
