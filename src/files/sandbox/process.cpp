#include "files/sandbox/process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/named_values.hpp"
#include "core/one_line.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/children.hpp"
#include "files/file_registry.hpp"

namespace cotan {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kWallPerProcessor = 15; // allows for other load on the processor
constexpr std::size_t kMaxStderr = 4096; // bytes of standard error that are kept

std::string readerName(const ReaderRequest& request)
{
    const std::string extension = upperCase(lowerExtension(request.name));
    const bool known = extension.size() > 1 && extension.size() < 6;
    const std::string format = known ? extension.substr(1) + " " : "";
    if (request.kind == ReaderKind::draco)
        return "the decoder of Draco streams";
    return fmt::format("the reader of {}{}", format, request.kind == ReaderKind::model ? "files" : "images");
}

// Moves a descriptor above the standard three, which are replaced in the child.
Descriptor above(int number)
{
    const Descriptor original(number);
    return Descriptor(::fcntl(number, F_DUPFD_CLOEXEC, 3));
}

bool makeChannels(Descriptor (&socket)[2], Descriptor (&messages)[2])
{
    int pair[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
        return false;
    socket[0] = above(pair[0]);
    socket[1] = above(pair[1]);
    if (::pipe2(pair, O_CLOEXEC) != 0)
        return false;
    messages[0] = above(pair[0]);
    messages[1] = above(pair[1]);
    return socket[0].get() >= 0 && socket[1].get() >= 0 && messages[0].get() >= 0 && messages[1].get() >= 0
        && ::fcntl(messages[0].get(), F_SETFL, O_NONBLOCK) == 0;
}

} // namespace

void Descriptor::close()
{
    if (number_ >= 0)
        ::close(number_);
    number_ = -1;
}

int spawn(const SpawnRequest& request, pid_t& process)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    if (request.input >= 0)
        ::posix_spawn_file_actions_adddup2(&files, request.input, 0);
    else
        ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, request.output, 1);
    ::posix_spawn_file_actions_adddup2(&files, request.output, 2);
    ::posix_spawn_file_actions_addclosefrom_np(&files, 3);
    if (!request.folder.empty())
        ::posix_spawn_file_actions_addchdir_np(&files, request.folder.c_str());
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    std::vector<std::string> texts{request.program};
    texts.insert(texts.end(), request.arguments.begin(), request.arguments.end());
    std::vector<char*> words;
    for (std::string& text : texts)
        words.push_back(text.data());
    words.push_back(nullptr);
    std::vector<std::string> variables;
    for (char** variable = environ; *variable; ++variable) {
        const std::string text = *variable;
        if (!request.environment.contains(text.substr(0, text.find('='))))
            variables.push_back(text);
    }
    for (const auto& [name, value] : request.environment)
        variables.push_back(name + "=" + value);
    std::vector<char*> environment;
    for (std::string& variable : variables)
        environment.push_back(variable.data());
    environment.push_back(nullptr);
    const int problem =
        ::posix_spawn(&process, request.program.c_str(), &files, &attributes, words.data(), environment.data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    return problem;
}

ReaderProcess::ReaderProcess(const ReaderRequest& request)
    : limits_(request.limits), name_(request.name), reader_(readerName(request)), fileBytes_(request.fileBytes),
      answer_([this](std::span<std::byte> bytes) { return receive(bytes); },
              std::uint64_t(budgetFor(limits_, SIZE_MAX, SIZE_MAX).megabytes) << 20),
      question_([this](std::span<const std::byte> bytes) { return send(bytes); })
{
    setDeadline();
}

ReaderProcess::~ReaderProcess() { kill(); }

Result<std::unique_ptr<ReaderProcess>> ReaderProcess::start(ReaderRequest request,
                                                            const std::function<void(WireOut&)>& more)
{
    std::unique_ptr<ReaderProcess> started(new ReaderProcess(request));
    const auto failed = [&](int problem) {
        return unavailableError(fmt::format("{}: cannot start the reader process {}: {}", request.name,
                                            request.limits.sandbox.program.string(), std::strerror(problem)));
    };
    Descriptor socket[2], messages[2];
    if (!makeChannels(socket, messages))
        return failed(errno);
    std::vector<std::string> words = request.limits.sandbox.arguments;
    words.emplace_back(kReaderWord);
    const SpawnRequest child{request.limits.sandbox.program.string(), words, socket[1].get(), messages[1].get()};
    if (const int problem = spawn(child, started->process_))
        return failed(problem);
    socket[1].close(); // otherwise no end of file is seen when the child ends
    messages[1].close();
    started->socket_ = std::move(socket[0]);
    started->messages_ = std::move(messages[0]);
    request.parent = ::getpid();
    exchangeRequest(started->question_, request);
    request.bytes = std::vector<std::byte>(); // free the bytes while the child reads; {} would keep their memory
    if (more)
        more(started->question_);
    COTAN_CHECK(started->await());
    return started;
}

Status ReaderProcess::await()
{
    question_.flush(); // a write error shows as a missing answer
    for (;;) {
        ReaderFrame frame = ReaderFrame::error;
        answer_.choice(frame, ReaderFrame::error);
        if (frame == ReaderFrame::expect) {
            std::uint64_t bytes = 0;
            answer_.number(bytes);
            decodedBytes_ += std::min(bytes, std::uint64_t(1) << 40);
            setDeadline();
        }
        std::string input;
        if (frame == ReaderFrame::input)
            answer_.array(input);
        if (!answer_.good())
            return failure();
        if (frame == ReaderFrame::input)
            COTAN_CHECK(noteInput(input));
        if (frame == ReaderFrame::value)
            return Done{};
        if (frame == ReaderFrame::error) {
            Error error;
            exchangeError(answer_, error);
            if (error.kind < ErrorKind::usage || error.kind > ErrorKind::limit)
                answer_.refuse();
            if (!answer_.good())
                return failure();
            return reworded(error, oneLine(error.message, 4096));
        }
    }
}

void ReaderProcess::restartClock()
{
    began_ = Clock::now();
    setDeadline();
}

void ReaderProcess::setDeadline()
{
    const double seconds = kWallPerProcessor * budgetFor(limits_, fileBytes_, decodedBytes_).seconds;
    deadline_ = began_ + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

void ReaderProcess::readStderr()
{
    std::array<char, 4096> bytes;
    const ssize_t got = ::read(messages_.get(), bytes.data(), bytes.size());
    if (got > 0)
        log_.append(bytes.data(), std::min(std::size_t(got), kMaxStderr - std::min(kMaxStderr, log_.size())));
    else if (got == 0 || (errno != EINTR && errno != EAGAIN))
        messages_.close();
}

// Waits until the socket is ready or the deadline has passed.
bool ReaderProcess::ready(short events)
{
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now());
        timedOut_ = left.count() <= 0;
        if (timedOut_)
            return false;
        pollfd waiting[2] = {{socket_.get(), events, 0}, {messages_.get(), POLLIN, 0}};
        const int found = ::poll(waiting, 2, int(std::min<std::int64_t>(left.count(), 1'000'000)));
        if (found < 0 && errno != EINTR)
            return false;
        if (found > 0 && waiting[1].revents != 0)
            readStderr();
        if (found > 0 && waiting[0].revents != 0)
            return true;
    }
}

bool ReaderProcess::send(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent >= 0)
            bytes = bytes.subspan(std::size_t(sent));
        else if ((errno != EAGAIN && errno != EINTR) || !ready(POLLOUT))
            return false;
    }
    return true;
}

std::size_t ReaderProcess::receive(std::span<std::byte> bytes)
{
    for (;;) {
        const ssize_t got = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (got >= 0)
            return std::size_t(got);
        if ((errno != EAGAIN && errno != EINTR) || !ready(POLLIN))
            return 0;
    }
}

bool ReaderProcess::ended(int& status)
{
    const auto drainStderr = [&] {
        pollfd waiting{messages_.get(), POLLIN, 0};
        while (messages_.get() >= 0 && log_.size() < kMaxStderr && ::poll(&waiting, 1, 0) > 0)
            readStderr();
    };
    for (;;) {
        drainStderr();
        if (const Waited found = waitFor(process_, /*look*/ true, status); found != Waited::running) {
            drainStderr(); // messages written just before the end
            process_ = -1;
            return found == Waited::ended;
        }
        timedOut_ = Clock::now() >= deadline_;
        if (timedOut_)
            return false;
        ::usleep(500);
    }
}

void ReaderProcess::kill()
{
    if (process_ < 0)
        return;
    ::kill(process_, SIGKILL);
    waitFor(process_);
    process_ = -1;
}

Error ReaderProcess::failure()
{
    const ReaderBudget budget = budgetFor(limits_, fileBytes_, decodedBytes_);
    const auto line = [&](const std::string& what) {
        const std::string first = oneLine(log_.substr(0, log_.find('\n')), 160);
        return inputError(fmt::format("{}: {} {}{}", name_, reader_, what, first.empty() ? "" : ": " + first));
    };
    int status = 0;
    const bool dead = !timedOut_ && answer_.ended() && ended(status);
    kill();
    if (timedOut_ || (dead && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        return line(fmt::format("took too long; the limit is {:.0f} seconds", budget.seconds));
    if (!answer_.ended())
        return line("returned invalid data");
    if (dead && WIFEXITED(status) && WEXITSTATUS(status) == kNoMemoryCode)
        return line(fmt::format("takes too much memory; the limit is {:.0f} MiB", budget.megabytes));
    if (dead && WIFSIGNALED(status))
        return line(fmt::format("{} (signal {}, {})", WTERMSIG(status) == SIGKILL ? "was killed" : "crashed",
                                WTERMSIG(status), ::strsignal(WTERMSIG(status))));
    return line("ended without a result");
}

} // namespace cotan
