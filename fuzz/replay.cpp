// NAME_replay PATH...: runs a harness over files, and over all files of folders, without libFuzzer. Reports and skips
// paths that do not exist. The exit code is 1 if a file takes more than kLimitSeconds of processor time; a property
// that does not hold aborts the program at that file.
#include <algorithm>
#include <ctime>
#include <fstream>
#include <iterator>
#include <vector>

#include <sys/resource.h>

#include "fuzz.hpp"

namespace {

namespace fs = std::filesystem;

// The limits of libFuzzer in scripts/fuzz; builds with sanitizers need several times as much of both.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kLimitSeconds = 30;
constexpr bool kLimitMemory = false; // sanitizers reserve terabytes of address space
#else
constexpr double kLimitSeconds = 5;
constexpr bool kLimitMemory = true;
#endif
constexpr rlim_t kLimitBytes = rlim_t(1500) << 20;

std::vector<fs::path> filesOf(const fs::path& path)
{
    std::vector<fs::path> files;
    if (fs::is_regular_file(path))
        files.push_back(path);
    else if (fs::is_directory(path))
        for (const fs::directory_entry& entry : fs::directory_iterator(path))
            if (entry.is_regular_file())
                files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

bool replay(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::vector<std::uint8_t> bytes(text.begin(), text.end()); // exact size, so that sanitizers see overreads
    fmt::print(stderr, "{}\n", file.string());
    const std::clock_t start = std::clock();
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    if (seconds > kLimitSeconds)
        fmt::print(stderr, "{}: took {:.1f} s, the limit is {:.0f}\n", file.string(), seconds, kLimitSeconds);
    return seconds <= kLimitSeconds;
}

} // namespace

int main(int argc, char** argv)
{
    const rlimit limit{kLimitBytes, kLimitBytes};
    if (kLimitMemory)
        ::setrlimit(RLIMIT_DATA, &limit);
    int count = 0;
    bool quick = true;
    for (int i = 1; i < argc; ++i) {
        if (!fs::exists(argv[i]))
            fmt::print(stderr, "{}: does not exist, skipped\n", argv[i]);
        for (const fs::path& file : filesOf(argv[i])) {
            quick = replay(file) && quick;
            ++count;
        }
    }
    fmt::print(stderr, "{} inputs\n", count);
    return quick && count > 0 ? 0 : 1;
}
