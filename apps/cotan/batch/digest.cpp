#include <chrono>
#include <ctime>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "batch/record.hpp"
#include "files/sandbox/process.hpp"

namespace cotan::app {

namespace {

constexpr std::int64_t kCoarse = 2'000'000'000; // nanoseconds: time resolution of the coarsest file systems
constexpr std::size_t kChunk = 1 << 20;

std::string digits(XXH128_hash_t hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

std::int64_t nanoseconds(const timespec& time) { return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec; }

bool sameFile(const FileState& a, const FileState& b)
{
    return a.bytes == b.bytes && a.modified == b.modified && a.changed == b.changed && a.number == b.number;
}

// Everything but the digest of the contents.
FileState statusOf(const std::filesystem::path& path, const std::string& file)
{
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return {.file = file, .digest = "missing"};
    if (!S_ISREG(status.st_mode)) // the files within a folder have states of their own
        return {.file = file, .digest = S_ISDIR(status.st_mode) ? "folder" : "special"};
    FileState state{.file = file, .digest = {}, .bytes = std::uint64_t(status.st_size)};
    state.modified = nanoseconds(status.st_mtim);
    state.changed = nanoseconds(status.st_ctim);
    state.number = status.st_ino;
    return state;
}

std::string contentsOf(const std::filesystem::path& path)
{
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
    if (file.get() < 0)
        return "unreadable";
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    thread_local std::vector<char> chunk(kChunk);
    for (;;) {
        const ssize_t got = ::read(file.get(), chunk.data(), chunk.size());
        if (got < 0)
            return "unreadable";
        if (got == 0)
            return digits(XXH3_128bits_digest(state.get()));
        XXH3_128bits_update(state.get(), chunk.data(), std::size_t(got));
    }
}

} // namespace

std::string digestOf(std::string_view text) { return digits(XXH3_128bits(text.data(), text.size())); }

std::int64_t nowNanoseconds()
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::int64_t fileClockNanoseconds()
{
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME_COARSE, &now);
    return nanoseconds(now);
}

FileState FileStates::of(const std::string& file)
{
    const std::filesystem::path path = folder_ / file;
    FileState now = statusOf(path, file);
    if (!now.digest.empty())
        return now;
    const auto known = known_.find(file);
    if (known != known_.end() && sameFile(known->second.state, now) && now.changed + kCoarse < known->second.at)
        return known->second.state;
    const std::int64_t at = nowNanoseconds();
    now.digest = contentsOf(path);
    known_[file] = {now, at};
    return now;
}

bool FileStates::holds(const FileState& recorded, std::int64_t at)
{
    const FileState now = statusOf(folder_ / recorded.file, recorded.file);
    if (!now.digest.empty())
        return now.digest == recorded.digest;
    if (sameFile(now, recorded) && now.changed + kCoarse < at)
        return true;
    return now.bytes == recorded.bytes && of(recorded.file).digest == recorded.digest;
}

} // namespace cotan::app
