#include "batch/store.hpp"

#include <chrono>
#include <random>
#include <system_error>

#include <fmt/format.h>

#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"

namespace cotan::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxRecordBytes = 64 << 20;
constexpr const char* kResults = "results";
constexpr const char* kWork = "work";
constexpr const char* kLock = "lock";
constexpr int kTries = 100; // of names that others have

// The hash under which a record is stored. It is the same on all machines: it depends on neither folders nor times.
std::string keyOf(const std::vector<std::string>& words, const std::string& version)
{
    std::string text = version;
    for (const std::string& word : words) {
        text += '\0';
        text += word;
    }
    return digestOf(text);
}

// Removes work folders of ended processes: their lock is free, or they have no lock file after a minute.
void removeStale(const fs::path& work)
{
    constexpr auto kTimeForALock = std::chrono::minutes(1);
    std::error_code ignored;
    for (fs::directory_iterator at(work, ignored), end; !ignored && at != end; at.increment(ignored)) {
        const FileLock::State lock = FileLock(at->path() / kLock, 0, /*create*/ false).state(); // and lets it go
        std::error_code none;
        const auto made = fs::last_write_time(at->path(), none);
        const bool old = !none && made + kTimeForALock < fs::file_time_type::clock::now();
        if (lock == FileLock::ours || (lock == FileLock::missing && old))
            fs::remove_all(at->path(), none);
    }
}

} // namespace

Store::Store(fs::path folder, std::string version)
    : folder_(fs::absolute(folder).lexically_normal()), version_(std::move(version))
{
}

Store::~Store()
{
    std::error_code ignored;
    workLock_ = FileLock(); // Windows removes no open files
    if (!work_.empty())
        fs::remove_all(work_, ignored);
}

Result<Store> Store::open(const fs::path& folder, std::string version)
{
    Store store(folder, std::move(version));
    for (const char* name : {kResults, kWork}) {
        COTAN_CHECK(makeFolder(store.folder_ / name));
        COTAN_CHECK(checkWritable(store.folder_ / name / kLock));
    }
    removeStale(store.folder_ / kWork);
    return store;
}

Result<Store> Store::openToRead(const fs::path& folder, std::string version)
{
    Store store(folder, std::move(version));
    std::error_code ignored;
    if (!fs::is_directory(store.folder_ / kResults, ignored))
        return inputError(folder.string() + ": expected a store of cotan batch; found none");
    return store;
}

// 256 folders, since some file systems are slow with a million files in one.
fs::path Store::fileOf(const std::vector<std::string>& words) const
{
    const std::string key = keyOf(words, version_);
    return folder_ / kResults / key.substr(0, 2) / (key.substr(2) + ".json");
}

std::optional<JobRecord> Store::find(const std::vector<std::string>& words) const
{
    const auto text = readText(fileOf(words), /*isInput*/ false, kMaxRecordBytes);
    return text ? parseRecord(*text) : std::nullopt;
}

Status Store::keep(const std::vector<std::string>& words, const JobRecord& record) const
{
    const fs::path file = fileOf(words);
    COTAN_CHECK(makeFolder(file.parent_path()));
    return writeFileWhole(file, toText(record, words, version_));
}

std::optional<Claim> Store::claim(const std::vector<std::string>& words) const
{
    // Locks one byte of a shared file per job, far past its end: no file is created that could be left behind.
    Claim claim(folder_ / kLock, std::strtoull(keyOf(words, version_).substr(0, 15).c_str(), nullptr, 16),
                /*create*/ true);
    if (claim.state() == FileLock::elsewhere)
        return std::nullopt;
    return claim;
}

Result<fs::path> Store::workFolder()
{
    if (!work_.empty())
        return work_;
    std::random_device random;
    std::error_code problem;
    for (int tries = 0; work_.empty() && tries < kTries && !problem; ++tries)
        if (const fs::path folder = folder_ / kWork / fmt::format("{:08x}", random());
            fs::create_directory(folder, problem))
            work_ = folder;
    if (work_.empty())
        return outputError(
            fmt::format("{}: cannot create a folder there: {}", (folder_ / kWork).string(), problem.message()));
    workLock_ = FileLock(work_ / kLock, 0, /*create*/ true);
    return work_;
}

} // namespace cotan::app
