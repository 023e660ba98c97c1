#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "batch/record.hpp"
#include "files/bytes.hpp"
#include "files/system/system.hpp"

namespace cotan::app {

namespace {

constexpr std::int64_t kCoarse = 2'000'000'000; // nanoseconds: time resolution of the coarsest file systems
constexpr std::size_t kChunk = 1 << 20;

std::string digits(XXH128_hash_t hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

bool sameFile(const FileState& a, const FileState& b)
{
    return a.bytes == b.bytes && a.modified == b.modified && a.changed == b.changed && a.number == b.number;
}

std::string contentsOf(const std::filesystem::path& path)
{
    const OpenFile file(openStream(path, "rb"));
    if (!file)
        return "unreadable";
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    thread_local std::vector<char> chunk(kChunk);
    for (;;) {
        const std::size_t got = std::fread(chunk.data(), 1, chunk.size(), file.get());
        XXH3_128bits_update(state.get(), chunk.data(), got);
        if (std::ferror(file.get()) != 0)
            return "unreadable";
        if (got < chunk.size())
            return digits(XXH3_128bits_digest(state.get()));
    }
}

} // namespace

std::string digestOf(std::string_view text) { return digits(XXH3_128bits(text.data(), text.size())); }

std::int64_t nowNanoseconds()
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
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
