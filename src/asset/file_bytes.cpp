#include "file_bytes.hpp"

#include <atomic>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace cotan {

namespace fs = std::filesystem;

Result<std::size_t> usableFileSize(const fs::path& file, std::size_t limit)
{
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        return inputError(fmt::format("{}: no such file", file.string()));
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
        return inputError(
            fmt::format("{}: the file has {} bytes, the limit is {}", file.string(), size, limit));
    return static_cast<std::size_t>(size);
}

Result<std::vector<std::byte>> readFileBytes(const fs::path& file, std::size_t limit)
{
    const auto size = usableFileSize(file, limit);
    if (!size)
        return size.error();
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> handle(
        std::fopen(file.c_str(), "rb"), [](std::FILE* f) { return std::fclose(f); });
    if (!handle)
        return inputError(fmt::format("{}: cannot be opened for reading", file.string()));
    std::vector<std::byte> bytes(*size);
    if (std::fread(bytes.data(), 1, bytes.size(), handle.get()) != bytes.size())
        return inputError(fmt::format("{}: reading stopped before the end", file.string()));
    return bytes;
}

namespace {

// Unique among the processes of this machine and the threads of this process.
fs::path nameBeside(const fs::path& file)
{
    static std::atomic<unsigned> counter{0};
    fs::path beside = file;
    beside.replace_filename(fmt::format(".{}.{}-{}.part{}", file.stem().string(), ::getpid(),
                                        counter.fetch_add(1), file.extension().string()));
    return beside;
}

} // namespace

BesideFile::BesideFile(fs::path file) : file_(std::move(file)), beside_(nameBeside(file_)) {}

BesideFile::BesideFile(BesideFile&& other) noexcept
    : file_(std::move(other.file_)), beside_(std::exchange(other.beside_, {}))
{
}

BesideFile::~BesideFile()
{
    std::error_code ignored;
    if (!beside_.empty())
        fs::remove(beside_, ignored);
}

Result<BesideFile> BesideFile::begin(const fs::path& file)
{
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return outputError(
            fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
    if (fs::is_directory(file, error))
        return outputError(fmt::format("{}: is a folder", file.string()));
    return BesideFile(file);
}

Status BesideFile::commit()
{
    std::error_code error;
    fs::rename(beside_, file_, error);
    if (error)
        return outputError(fmt::format("{}: {}", file_.string(), error.message()));
    beside_.clear();
    return Done{};
}

Status writeBeside(const fs::path& file, const std::function<Status(const fs::path&)>& write)
{
    auto beside = BesideFile::begin(file);
    if (!beside)
        return beside.error();
    if (Status written = write(beside->path()); !written)
        return written;
    return beside->commit();
}

} // namespace cotan
