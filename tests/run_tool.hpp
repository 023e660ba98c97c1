// Runs the tool in a separate process and measures it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cotan::test {

struct ToolRun {
    int code = -1; // exit code; 128 + signal if it was killed
    std::string out;
    std::string err;
    double seconds = 0;   // CPU time
    double megabytes = 0; // peak resident size
};

// A folder that is removed with its contents.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "cotan-test-XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline std::string readWhole(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

// Runs COTAN_TOOL with these arguments in `folder`; kills it after `limitSeconds` of CPU time.
inline ToolRun runTool(const std::vector<std::string>& words, const std::filesystem::path& folder,
                       unsigned limitSeconds = 60)
{
    TemporaryFolder prints;
    const std::string out = prints / "out", err = prints / "err";
    std::vector<std::string> all{COTAN_TOOL};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    for (std::string& w : all)
        arguments.push_back(w.data());
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit limit{limitSeconds, limitSeconds + 1};
        ::setrlimit(RLIMIT_CPU, &limit);
        const bool ready = ::chdir(folder.c_str()) == 0 && ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), 1) == 1
            && ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), 2) == 2;
        if (ready)
            ::execv(COTAN_TOOL, arguments.data());
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    ToolRun run;
    run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = readWhole(out);
    run.err = readWhole(err);
    auto seconds = [](timeval t) { return double(t.tv_sec) + double(t.tv_usec) * 1e-6; };
    run.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    run.megabytes = double(usage.ru_maxrss) / 1024;
    return run;
}

inline int lines(const std::string& text)
{
    int n = 0;
    for (char c : text)
        n += c == '\n';
    return n;
}

} // namespace cotan::test
