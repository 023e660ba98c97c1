#include "files/sandbox/child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/children.hpp"
#include "files/sandbox/process.hpp"

namespace cotan {

namespace {

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

struct Child::System {
    pid_t process = -1; // -1: none, or already reaped
    Descriptor socket, messages;
    std::string log;
    Clock::time_point deadline;
    bool timedOut = false;

    void readMessages()
    {
        std::array<char, 4096> bytes;
        const ssize_t got = ::read(messages.get(), bytes.data(), bytes.size());
        if (got > 0)
            log.append(bytes.data(), std::min(std::size_t(got), kMaxMessages - std::min(kMaxMessages, log.size())));
        else if (got == 0 || (errno != EINTR && errno != EAGAIN))
            messages.close();
    }

    // Reads what has arrived.
    void drainMessages()
    {
        pollfd waiting{messages.get(), POLLIN, 0};
        while (messages.get() >= 0 && log.size() < kMaxMessages && ::poll(&waiting, 1, 0) > 0)
            readMessages();
    }

    // Waits until the socket is ready or the deadline has passed.
    bool ready(short events)
    {
        for (;;) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
            timedOut = left.count() <= 0;
            if (timedOut)
                return false;
            pollfd waiting[2] = {{socket.get(), events, 0}, {messages.get(), POLLIN, 0}};
            const int found = ::poll(waiting, 2, int(std::min<std::int64_t>(left.count(), 1'000'000)));
            if (found < 0 && errno != EINTR)
                return false;
            if (found > 0 && waiting[1].revents != 0)
                readMessages();
            if (found > 0 && waiting[0].revents != 0)
                return true;
        }
    }
};

Child::Child() : system_(std::make_unique<System>()) {}

Child::~Child() { kill(); }

std::string Child::start(const ChildProgram& p)
{
    Descriptor socket[2], messages[2];
    if (!makeChannels(socket, messages))
        return std::strerror(errno);
    const SpawnRequest child{p.program.string(), p.arguments, socket[1].get(), messages[1].get(), {}, p.environment};
    if (const int problem = spawn(child, system_->process))
        return std::strerror(problem);
    system_->socket =
        std::move(socket[0]); // ours are closed here: otherwise no end of file is seen when the child ends
    system_->messages = std::move(messages[0]);
    return {};
}

void Child::setLimits(Clock::time_point deadline, const ReaderBudget&, const ReaderBudget&)
{
    system_->deadline = deadline; // the child limits itself to the budget
}

bool Child::timedOut() const { return system_->timedOut; }

bool Child::send(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = ::send(system_->socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent >= 0)
            bytes = bytes.subspan(std::size_t(sent));
        else if ((errno != EAGAIN && errno != EINTR) || !system_->ready(POLLOUT))
            return false;
    }
    return true;
}

std::size_t Child::receive(std::span<std::byte> bytes)
{
    for (;;) {
        const ssize_t got = ::recv(system_->socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (got >= 0)
            return std::size_t(got);
        if ((errno != EAGAIN && errno != EINTR) || !system_->ready(POLLIN))
            return 0;
    }
}

ChildEnd Child::end()
{
    for (;;) {
        int status = 0;
        system_->drainMessages();
        const Waited found = waitFor(system_->process, /*look*/ true, status);
        if (found != Waited::running) {
            system_->drainMessages(); // messages written just before the end
            system_->process = -1;
        }
        if (found == Waited::ended && WIFEXITED(status))
            return {ChildEnd::exited, WEXITSTATUS(status)};
        if (found == Waited::ended && WIFSIGNALED(status)) {
            const int signal = WTERMSIG(status);
            return {signal == SIGXCPU       ? ChildEnd::tooLong
                        : signal == SIGKILL ? ChildEnd::killed
                                            : ChildEnd::crashed,
                    0, fmt::format("signal {}, {}", signal, ::strsignal(signal))};
        }
        system_->timedOut = found == Waited::running && Clock::now() >= system_->deadline;
        if (found != Waited::running || system_->timedOut)
            return {};
        ::usleep(500);
    }
}

void Child::kill()
{
    if (system_->process < 0)
        return;
    ::kill(system_->process, SIGKILL);
    waitFor(system_->process);
    system_->process = -1;
}

std::string Child::messages() const { return system_->log; }

std::optional<ParentConnection> ParentConnection::take()
{
    struct stat status {};
    if (::fstat(0, &status) != 0 || !S_ISSOCK(status.st_mode))
        return std::nullopt;
    ParentConnection connection;
    connection.in_ = connection.out_ = ::fcntl(0, F_DUPFD_CLOEXEC, 3);
    ::dup2(2, 0);
    return connection;
}

bool ParentConnection::send(std::span<const std::byte> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t sent = ::send(int(out_), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0)
            return false;
        bytes = bytes.subspan(std::size_t(sent));
    }
    return true;
}

std::size_t ParentConnection::receive(std::span<std::byte> bytes) const
{
    return std::size_t(std::max<ssize_t>(::recv(int(in_), bytes.data(), bytes.size(), 0), 0));
}

} // namespace cotan
