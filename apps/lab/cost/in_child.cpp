#include "in_child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "files/children.hpp"

namespace cotan::cost {

namespace {

[[noreturn]] void runChild(int pipe, int seconds, const std::function<void(const LineWriter&)>& work)
{
    ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
    const rlimit noCore{0, 0};
    ::setrlimit(RLIMIT_CORE, &noCore);
    ::signal(SIGALRM, SIG_DFL);
    ::alarm(unsigned(seconds));
    int code = 0;
    try {
        work([&](std::string_view words) {
            std::string line(words);
            std::replace(line.begin(), line.end(), '\n', ' ');
            line += '\n';
            for (std::size_t done = 0; done < line.size();) {
                const ssize_t n = ::write(pipe, line.data() + done, line.size() - done);
                if (n < 0 && errno != EINTR)
                    ::_exit(1);
                done += n > 0 ? std::size_t(n) : 0;
            }
            ::alarm(unsigned(seconds));
        });
    } catch (...) {
        code = 1;
    }
    ::_exit(code); // no destructors: they belong to the parent
}

std::string endOf(pid_t child, int seconds)
{
    int status = 0;
    if (waitFor(child, /*look*/ false, status) == Waited::lost)
        return "was lost";
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return "took more than " + std::to_string(seconds) + " s";
    if (WIFSIGNALED(status))
        return "crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
    return WEXITSTATUS(status) == 0 ? "" : "ended with " + std::to_string(WEXITSTATUS(status));
}

} // namespace

std::string inChild(int seconds, const std::function<void(const LineWriter&)>& work,
                    const std::function<void(std::string_view)>& line)
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return "could not be started";
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        runChild(ends[1], seconds, work);
    }
    ::close(ends[1]);
    std::string kept; // start of a line that is not complete yet
    std::array<char, 4096> buffer{};
    while (child > 0) {
        const ssize_t n = ::read(ends[0], buffer.data(), buffer.size());
        if (n == 0 || (n < 0 && errno != EINTR))
            break;
        kept.append(buffer.data(), n > 0 ? std::size_t(n) : 0);
        for (std::size_t end; (end = kept.find('\n')) != std::string::npos; kept.erase(0, end + 1))
            line(std::string_view(kept).substr(0, end));
    }
    ::close(ends[0]);
    return child > 0 ? endOf(child, seconds) : "could not be started";
}

} // namespace cotan::cost
