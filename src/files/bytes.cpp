#include "files/bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/large_array.hpp"
#include "core/try.hpp"
#include "cotan/files.hpp"
#include "files/file_registry.hpp"
#include "files/system/system.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

Sandbox& sandboxOfProcess()
{
    static Sandbox sandbox;
    return sandbox;
}

} // namespace

Result<std::size_t> usableFileSize(const fs::path& file, std::size_t limit, bool isInput)
{
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        return inputError(fmt::format("{}: no such file", file.string()));
    if (isInput)
        COTAN_CHECK(noteInput(file));
    if (fs::is_directory(status))
        return inputError(fmt::format("{}: expected a file, found a folder", file.string()));
    if (!fs::is_regular_file(status))
        return inputError(fmt::format("{}: expected a regular file", file.string()));
    const std::uintmax_t size = fs::file_size(file, error);
    if (error)
        return inputError(fmt::format("{}: {}", file.string(), error.message()));
    if (size == 0)
        return inputError(fmt::format("{}: the file is empty", file.string()));
    if (size > limit)
        return inputError(fmt::format("{}: the file has {} bytes, the limit is {}", file.string(), size, limit));
    return static_cast<std::size_t>(size);
}

Result<std::vector<std::byte>> readFileBytes(const fs::path& file, std::size_t limit, bool isInput)
{
    COTAN_TRY(size, usableFileSize(file, limit, isInput));
    const OpenFile handle(openStream(file, "rb"));
    if (!handle)
        return inputError(fmt::format("{}: cannot be opened for reading", file.string()));
    std::vector<std::byte> bytes = zeros<std::byte>(*size);
    if (std::fread(bytes.data(), 1, bytes.size(), handle.get()) != bytes.size())
        return inputError(fmt::format("{}: reading stopped before the end", file.string()));
    return bytes;
}

Result<std::string> readText(const fs::path& file, bool isInput, std::size_t limit)
{
    if (isInput)
        COTAN_CHECK(noteInput(file));
    const OpenFile handle(openStream(file, "rb"));
    std::string text;
    char part[4096];
    for (std::size_t got; handle && text.size() <= limit && (got = std::fread(part, 1, sizeof part, handle.get())) > 0;)
        text.append(part, got);
    if (!handle || std::ferror(handle.get()) != 0)
        return inputError(fmt::format("{}: cannot read: {}", file.string(), std::generic_category().message(errno)));
    if (text.size() > limit)
        return inputError(fmt::format("{}: expected at most {} bytes, found more", file.string(), limit));
    return text;
}

std::optional<fs::path> findInFolder(const fs::path& folder, std::string request, bool& outside)
{
    outside = false;
    std::ranges::replace(request, '\\', '/');
    if (request.empty() || request.find('\0') != std::string::npos)
        return std::nullopt;

    // An absolute path replaces the folder here; it is accepted only if it leads back into it.
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

void sandboxByDefault(Sandbox sandbox) { sandboxOfProcess() = std::move(sandbox); }

Sandbox defaultSandbox() { return sandboxOfProcess(); }

} // namespace cotan
