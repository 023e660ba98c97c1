#include "batch/child.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "files/sandbox/confine.hpp"
#include "files/sandbox/process_windows.hpp"
#include "files/sandbox/request.hpp"

namespace cotan::app {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr DWORD kStep = 50;                   // milliseconds between two looks at limits
constexpr DWORD kFirstException = 0xC0000000; // exit codes from here on are exceptions
constexpr DWORD kEndedByControl = 0xC000013A; // STATUS_CONTROL_C_EXIT

} // namespace

// A thread reads its output. Its limits are watched by look().
struct JobProcess::System {
    Handle job, process, pipe;
    std::thread reader;
    std::mutex mutex; // of the output
    KeptOutput output;
    Clock::time_point began = Clock::now();
    Seconds limit{};
    double maxMegabytes = 0, maxProcessorSeconds = 0; // 0: none
    double megabytes = 0;                             // the most so far
    bool late = false, overWorked = false, noMemory = false;

    void read()
    {
        std::array<std::byte, 4096> bytes;
        while (const std::size_t got = readPipe(pipe.get(), bytes)) {
            const std::lock_guard lock(mutex);
            output.add({reinterpret_cast<const char*>(bytes.data()), got});
        }
    }

    void endIfOver()
    {
        megabytes = std::max(megabytes, megabytesOf(process.get()));
        late = late || Clock::now() - began >= limit;
        overWorked = overWorked || (maxProcessorSeconds > 0 && processorSeconds(process.get()) > maxProcessorSeconds);
        noMemory = noMemory || (maxMegabytes > 0 && megabytes > maxMegabytes);
        if (late || overWorked || noMemory)
            ::TerminateJobObject(job.get(), UINT(kNoMemoryCode));
    }
};

JobProcess::JobProcess(std::unique_ptr<System> system) : system_(std::move(system)) {}

Result<std::unique_ptr<JobProcess>> JobProcess::start(const std::filesystem::path& program,
                                                      const std::filesystem::path& folder, const ChildRequest& request,
                                                      const std::map<std::string, std::string>& environment,
                                                      double limitSeconds)
{
    auto system = std::make_unique<System>();
    System& s = *system;
    s.limit = Seconds(limitSeconds);
    s.maxMegabytes = double(request.megabytes);
    s.maxProcessorSeconds = double(request.processorSeconds);
    s.job = endingJob();
    Pipe pipe;
    if (!pipe.open(/*childReads*/ false))
        return unavailableError("cannot start a process: " + lastReason());
    const HANDLE output = pipe.childs.get();
    if (const std::string why =
            spawn({program, toWords(request), nullptr, output, output, s.job.get(), folder, environment}, s.process);
        !why.empty())
        return unavailableError("cannot start a process: " + why);
    s.pipe = std::move(pipe.ours);
    std::unique_ptr<JobProcess> started(new JobProcess(std::move(system)));
    s.reader = std::thread([&s] { s.read(); });
    return started;
}

JobProcess::~JobProcess()
{
    ::TerminateJobObject(system_->job.get(), 1); // no effect on what has ended
    if (system_->reader.joinable())
        system_->reader.join();
}

pid_t JobProcess::number() const { return pid_t(::GetProcessId(system_->process.get())); }

std::optional<Ending> JobProcess::look()
{
    System& s = *system_;
    if (::WaitForSingleObject(s.process.get(), 0) == WAIT_TIMEOUT) {
        s.endIfOver();
        return std::nullopt;
    }
    ::TerminateJobObject(s.job.get(), 1); // processes that it left running
    s.reader.join();
    DWORD code = 0;
    ::GetExitCodeProcess(s.process.get(), &code);
    Ending ending;
    ending.late = s.late;
    ending.overWorked = s.overWorked;
    if (code >= kFirstException) {
        ending.crash = fmt::format("exception {:#X}", code);
        ending.killed = code == kEndedByControl;
    } else if (!s.late && !s.overWorked) {
        ending.code = s.noMemory ? kNoMemoryCode : int(code);
    }
    ending.record.output = s.output.text();
    std::erase(ending.record.output, '\r');
    ending.record.seconds = Seconds(Clock::now() - s.began).count();
    ending.record.processorSeconds = processorSeconds(s.process.get());
    ending.record.megabytes = std::max(s.megabytes, peakMegabytesOf(s.job.get()));
    return ending;
}

void JobProcess::waitForOne(std::span<JobProcess* const> processes)
{
    std::vector<HANDLE> handles;
    for (const JobProcess* process : processes.first(std::min<std::size_t>(processes.size(), MAXIMUM_WAIT_OBJECTS)))
        handles.push_back(process->system_->process.get());
    ::WaitForMultipleObjects(DWORD(handles.size()), handles.data(), FALSE, kStep);
}

void limitJobProcess(const ChildRequest&) { leaveNoCore(); }

} // namespace cotan::app
