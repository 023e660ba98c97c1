#include "files/sandbox/child.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>

#include "files/sandbox/process_windows.hpp"

namespace cotan {

namespace {

constexpr DWORD kLookEvery = 10; // ms, at the child's memory and times

bool writePipe(HANDLE pipe, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        DWORD written = 0;
        const DWORD most = DWORD(std::min<std::size_t>(bytes.size(), 1u << 20));
        if (::WriteFile(pipe, bytes.data(), most, &written, nullptr) == 0 || written == 0)
            return false;
        bytes = bytes.subspan(written);
    }
    return true;
}

// A job whose processes end with its last handle, that starts no further processes, and that has no access to the
// clipboard, the desktop and other programs' windows.
Handle confiningJob()
{
    Handle job(::CreateJobObjectW(nullptr, nullptr));
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_ACTIVE_PROCESS
        | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    limits.BasicLimitInformation.ActiveProcessLimit = 1;
    JOBOBJECT_BASIC_UI_RESTRICTIONS windows{};
    windows.UIRestrictionsClass = JOB_OBJECT_UILIMIT_HANDLES | JOB_OBJECT_UILIMIT_READCLIPBOARD
        | JOB_OBJECT_UILIMIT_WRITECLIPBOARD | JOB_OBJECT_UILIMIT_SYSTEMPARAMETERS | JOB_OBJECT_UILIMIT_DISPLAYSETTINGS
        | JOB_OBJECT_UILIMIT_GLOBALATOMS | JOB_OBJECT_UILIMIT_DESKTOP | JOB_OBJECT_UILIMIT_EXITWINDOWS;
    ::SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
    ::SetInformationJobObject(job.get(), JobObjectBasicUIRestrictions, &windows, sizeof windows);
    return job;
}

} // namespace

// Two threads serve the child: one reads its messages, one looks at its memory and times and ends it over a limit,
// which wakes the thread that waits for it in send or receive.
struct Child::System {
    enum Over : int { within, deadlinePassed, processorOver, memoryOver };

    Handle job, process, input, output, error;
    std::thread reader, watcher;
    mutable std::mutex mutex; // of what follows
    std::string log;
    Clock::time_point deadline = Clock::time_point::max();
    ReaderBudget budget{};
    std::atomic<int> over = within;
    std::atomic<bool> timedOut = false;

    void readMessages()
    {
        std::array<std::byte, 4096> bytes;
        while (const std::size_t got = readPipe(error.get(), bytes)) {
            const std::lock_guard lock(mutex);
            log.append(reinterpret_cast<const char*>(bytes.data()),
                       std::min(got, kMaxMessages - std::min(kMaxMessages, log.size())));
        }
    }

    int limitPassed() const
    {
        const std::lock_guard lock(mutex);
        if (Clock::now() >= deadline)
            return deadlinePassed;
        if (budget.megabytes > 0 && megabytesOf(process.get()) > budget.megabytes)
            return memoryOver;
        return budget.seconds > 0 && processorSeconds(process.get()) > budget.seconds ? processorOver : within;
    }

    void watch()
    {
        while (::WaitForSingleObject(process.get(), kLookEvery) == WAIT_TIMEOUT)
            if (const int passed = limitPassed()) {
                over = passed;
                timedOut = passed == deadlinePassed;
                ::TerminateProcess(process.get(), UINT(kNoMemoryCode));
                return;
            }
    }
};

Child::Child() : system_(std::make_unique<System>()) {}

Child::~Child() { kill(); }

std::string Child::start(const ChildProgram& p)
{
    Pipe input, output, error;
    if (!input.open(/*childReads*/ true) || !output.open(false) || !error.open(false))
        return lastReason();
    System& s = *system_;
    s.job = p.confined ? confiningJob() : endingJob();
    const SpawnRequest request{p.program,   p.arguments, input.childs.get(), output.childs.get(), error.childs.get(),
                               s.job.get(), {},          p.environment};
    if (std::string why = spawn(request, s.process); !why.empty())
        return why;
    s.input = std::move(input.ours);
    s.output = std::move(output.ours);
    s.error = std::move(error.ours);
    s.reader = std::thread([&s] { s.readMessages(); });
    s.watcher = std::thread([&s] { s.watch(); });
    return {};
}

void Child::setLimits(Clock::time_point deadline, const ReaderBudget& budget, const ReaderBudget&)
{
    const std::lock_guard lock(system_->mutex);
    system_->deadline = deadline;
    system_->budget = budget;
}

bool Child::timedOut() const { return system_->timedOut; }

bool Child::send(std::span<const std::byte> bytes) { return writePipe(system_->input.get(), bytes); }

std::size_t Child::receive(std::span<std::byte> bytes) { return readPipe(system_->output.get(), bytes); }

ChildEnd Child::end()
{
    System& s = *system_;
    if (!s.watcher.joinable())
        return {};
    s.watcher.join();
    DWORD code = 0;
    ::WaitForSingleObject(s.process.get(), INFINITE);
    ::GetExitCodeProcess(s.process.get(), &code);
    if (s.over == System::processorOver)
        return {ChildEnd::tooLong};
    if (s.over == System::deadlinePassed)
        return {};
    constexpr DWORD kFirstException = 0xC0000000;
    if (code >= kFirstException)
        return {ChildEnd::crashed, 0, fmt::format("exception {:#X}", code)};
    return {ChildEnd::exited, int(code)};
}

void Child::kill()
{
    System& s = *system_;
    if (s.process.get() != nullptr)
        ::TerminateProcess(s.process.get(), 1); // no effect if it has ended
    if (s.watcher.joinable())
        s.watcher.join();
    if (s.reader.joinable())
        s.reader.join();
    s.process.close();
}

std::string Child::messages() const
{
    const std::lock_guard lock(system_->mutex);
    return system_->log;
}

std::optional<ParentConnection> ParentConnection::take()
{
    const HANDLE in = ::GetStdHandle(STD_INPUT_HANDLE), out = ::GetStdHandle(STD_OUTPUT_HANDLE);
    if (::GetFileType(in) != FILE_TYPE_PIPE || ::GetFileType(out) != FILE_TYPE_PIPE)
        return std::nullopt;
    const HANDLE self = ::GetCurrentProcess();
    HANDLE ownIn = nullptr, ownOut = nullptr;
    if (::DuplicateHandle(self, in, self, &ownIn, 0, FALSE, DUPLICATE_SAME_ACCESS) == 0
        || ::DuplicateHandle(self, out, self, &ownOut, 0, FALSE, DUPLICATE_SAME_ACCESS) == 0)
        return std::nullopt;
    // What libraries print goes to standard error, and they read nothing.
    const int nothing = ::_open("NUL", _O_RDONLY);
    ::_dup2(nothing, 0);
    ::_dup2(2, 1);
    ParentConnection connection;
    connection.in_ = reinterpret_cast<std::intptr_t>(ownIn);
    connection.out_ = reinterpret_cast<std::intptr_t>(ownOut);
    return connection;
}

bool ParentConnection::send(std::span<const std::byte> bytes) const
{
    return writePipe(reinterpret_cast<HANDLE>(out_), bytes);
}

std::size_t ParentConnection::receive(std::span<std::byte> bytes) const
{
    return readPipe(reinterpret_cast<HANDLE>(in_), bytes);
}

} // namespace cotan
