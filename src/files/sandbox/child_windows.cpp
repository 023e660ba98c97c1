#include "files/sandbox/child.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>

#include "core/windows.hpp"
// After windows.h.
#include <psapi.h>

namespace cotan {

namespace {

constexpr double kMegabyte = 1 << 20;
constexpr DWORD kLookEvery = 10; // ms, at the child's memory and times

class Handle {
public:
    Handle() = default;
    explicit Handle(HANDLE handle) : handle_(handle) {}
    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Handle() { close(); }
    HANDLE get() const { return handle_; }
    void close()
    {
        if (handle_ != nullptr && handle_ != INVALID_HANDLE_VALUE)
            ::CloseHandle(handle_);
        handle_ = nullptr;
    }

private:
    HANDLE handle_ = nullptr;
};

std::string lastReason() { return std::system_category().message(int(::GetLastError())); }

// A pipe of which the child inherits one end.
struct Pipe {
    Handle ours, childs;

    bool open(bool childReads)
    {
        HANDLE read = nullptr, write = nullptr;
        if (::CreatePipe(&read, &write, nullptr, 1 << 16) == 0)
            return false;
        ours = Handle(childReads ? write : read);
        childs = Handle(childReads ? read : write);
        return ::SetHandleInformation(childs.get(), HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT) != 0;
    }
};

// As the C runtime of the child takes a word apart again:
// https://learn.microsoft.com/cpp/c-language/parsing-c-command-line-arguments
std::wstring quoted(const std::wstring& word)
{
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t letter : word) {
        if (letter == L'"')
            text.append(backslashes + 1, L'\\'); // doubles those before a quotation mark, and escapes it
        backslashes = letter == L'\\' ? backslashes + 1 : 0;
        text += letter;
    }
    return text.append(backslashes, L'\\') + L"\"";
}

std::size_t readPipe(HANDLE pipe, std::span<std::byte> bytes)
{
    DWORD got = 0;
    const DWORD most = DWORD(std::min<std::size_t>(bytes.size(), 1u << 30));
    return ::ReadFile(pipe, bytes.data(), most, &got, nullptr) != 0 ? got : 0;
}

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
Handle makeJob()
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

double processorSeconds(HANDLE process)
{
    FILETIME created{}, ended{}, kernel{}, user{};
    ::GetProcessTimes(process, &created, &ended, &kernel, &user);
    const auto seconds = [](const FILETIME& t) { return 1e-7 * (4294967296.0 * t.dwHighDateTime + t.dwLowDateTime); };
    return seconds(kernel) + seconds(user);
}

double megabytesOf(HANDLE process)
{
    PROCESS_MEMORY_COUNTERS counters{};
    ::K32GetProcessMemoryInfo(process, &counters, sizeof counters);
    return double(std::max(counters.PagefileUsage, counters.WorkingSetSize)) / kMegabyte;
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

std::string Child::start(const std::filesystem::path& program, const std::vector<std::string>& arguments)
{
    Pipe input, output, error;
    if (!input.open(/*childReads*/ true) || !output.open(false) || !error.open(false))
        return lastReason();
    std::wstring line = quoted(program.native());
    for (const std::string& argument : arguments)
        line += L" " + quoted(std::filesystem::path(argument).native());

    // The child inherits these three handles and no others.
    std::array<HANDLE, 3> inherited{input.childs.get(), output.childs.get(), error.childs.get()};
    SIZE_T size = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> attributes(size);
    STARTUPINFOEXW startup{};
    startup.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(attributes.data());
    startup.StartupInfo.cb = sizeof startup;
    startup.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    startup.StartupInfo.hStdInput = inherited[0];
    startup.StartupInfo.hStdOutput = inherited[1];
    startup.StartupInfo.hStdError = inherited[2];
    if (::InitializeProcThreadAttributeList(startup.lpAttributeList, 1, 0, &size) == 0
        || ::UpdateProcThreadAttribute(startup.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, inherited.data(),
                                       sizeof inherited, nullptr, nullptr)
            == 0)
        return lastReason();
    PROCESS_INFORMATION started{};
    const BOOL fine = ::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                                       EXTENDED_STARTUPINFO_PRESENT | CREATE_SUSPENDED | CREATE_NO_WINDOW
                                           | CREATE_NEW_PROCESS_GROUP, // so that Ctrl-C reaches only us
                                       nullptr, nullptr, &startup.StartupInfo, &started);
    const std::string why = fine ? std::string() : lastReason();
    ::DeleteProcThreadAttributeList(startup.lpAttributeList);
    if (!fine)
        return why;
    System& s = *system_;
    s.process = Handle(started.hProcess);
    s.job = makeJob();
    ::AssignProcessToJobObject(s.job.get(), s.process.get()); // fails inside of jobs before Windows 8: then without
    ::ResumeThread(started.hThread);
    ::CloseHandle(started.hThread);
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
