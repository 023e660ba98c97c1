#include "batch/child.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include "files/children.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/process.hpp"

namespace cotan::app {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kGrace = 2;    // seconds between SIGTERM and SIGKILL
constexpr int kMaxReads = 64;   // per call, so that other processes get their turn
constexpr int kTick = 50;       // milliseconds between two checks of the deadlines
constexpr int kClosingTick = 1; // the same once a process has closed its output

double secondsOf(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

} // namespace

struct JobProcess::System {
    pid_t process = -1;  // -1: none, or reaped
    Descriptor messages; // closed: its output is closed
    Seconds limit{};
    Clock::time_point began = Clock::now();
    bool terminated = false, killed = false; // SIGTERM, SIGKILL were sent
    KeptOutput output;

    void listen()
    {
        std::array<char, 4096> bytes;
        for (int i = 0; i < kMaxReads && messages.get() >= 0; ++i) {
            const ssize_t got = ::read(messages.get(), bytes.data(), bytes.size());
            if (got < 0 && (errno == EAGAIN || errno == EINTR))
                return;
            if (got <= 0) {
                messages.close();
                return;
            }
            output.add({bytes.data(), std::size_t(got)});
        }
    }

    void endIfLate()
    {
        const auto since = Clock::now() - began;
        if (!terminated && since >= limit) {
            ::kill(-process, SIGTERM);
            terminated = true;
        }
        if (!killed && since >= limit + Seconds(kGrace)) {
            ::kill(-process, SIGKILL);
            killed = true;
        }
    }
};

JobProcess::JobProcess(std::unique_ptr<System> system) : system_(std::move(system)) {}

Result<std::unique_ptr<JobProcess>> JobProcess::start(const std::filesystem::path& program,
                                                      const std::filesystem::path& folder, const ChildRequest& request,
                                                      const std::map<std::string, std::string>& environment,
                                                      double limitSeconds)
{
    const auto failed = [](int problem) {
        return unavailableError(fmt::format("cannot start a process: {}", std::strerror(problem)));
    };
    int pair[2];
    if (::pipe2(pair, O_CLOEXEC) != 0)
        return failed(errno);
    const Descriptor theirs(pair[1]);
    auto system = std::make_unique<System>();
    system->messages = Descriptor(pair[0]);
    system->limit = Seconds(limitSeconds);
    ::fcntl(pair[0], F_SETFL, O_NONBLOCK);
    if (const int problem =
            spawn({program.string(), toWords(request), -1, theirs.get(), folder, environment}, system->process))
        return failed(problem);
    return std::unique_ptr<JobProcess>(new JobProcess(std::move(system)));
}

JobProcess::~JobProcess()
{
    if (system_->process < 0)
        return;
    ::kill(-system_->process, SIGKILL);
    waitFor(system_->process);
}

pid_t JobProcess::number() const { return system_->process; }

std::optional<Ending> JobProcess::look()
{
    System& s = *system_;
    s.listen();
    int status = 0;
    rusage usage{};
    const Waited found = waitFor(s.process, /*look*/ true, status, &usage);
    if (found == Waited::running) {
        s.endIfLate();
        return std::nullopt;
    }
    ::kill(-s.process, SIGKILL); // kills processes that it left running
    s.process = -1;
    s.listen(); // reads the remaining output
    Ending ending;
    ending.lost = found == Waited::lost;
    ending.late = s.terminated;
    if (!ending.lost && WIFEXITED(status))
        ending.code = WEXITSTATUS(status);
    if (!ending.lost && WIFSIGNALED(status)) {
        ending.signal = WTERMSIG(status);
        ending.crash = fmt::format("signal {}, {}", ending.signal, ::strsignal(ending.signal));
        ending.overWorked = ending.signal == SIGXCPU;
        ending.killed = ending.signal == SIGKILL;
    }
    ending.record.output = s.output.text();
    ending.record.seconds = Seconds(Clock::now() - s.began).count();
    ending.record.processorSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    ending.record.megabytes = double(usage.ru_maxrss) / 1024;
    return ending;
}

void JobProcess::waitForOne(std::span<JobProcess* const> processes)
{
    std::vector<pollfd> descriptors;
    int tick = kTick;
    for (const JobProcess* process : processes) {
        descriptors.push_back({process->system_->messages.get(), POLLIN, 0});
        if (descriptors.back().fd < 0)
            tick = kClosingTick;
    }
    ::poll(descriptors.data(), descriptors.size(), tick);
}

void limitJobProcess(const ChildRequest& request)
{
    dieWith(request.parent, SIGTERM); // the handler of SIGTERM removes unfinished files
    leaveNoCore();
    if (!kSanitized && request.megabytes > 0)
        setLimit(RLIMIT_DATA, request.megabytes << 20, request.megabytes << 20);
    if (request.processorSeconds > 0)
        setLimit(RLIMIT_CPU, request.processorSeconds, RLIM_INFINITY);
}

} // namespace cotan::app
