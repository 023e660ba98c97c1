#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "files/children.hpp"
#include "files/sandbox/process.hpp"
#include "tool_process.hpp"

namespace cotan::viewer {

struct ToolProcess::State {
    pid_t process = 0; // and its process group; 0: none
    Descriptor pipe;
    std::string output;

    void read()
    {
        char bytes[4096];
        for (ssize_t count; (count = ::read(pipe.get(), bytes, sizeof bytes)) > 0;)
            output.append(bytes,
                          std::min(std::size_t(count), kMaxToolOutput - std::min(kMaxToolOutput, output.size())));
    }
};

ToolProcess::ToolProcess() : state_(std::make_unique<State>()) {}

ToolProcess::~ToolProcess()
{
    if (!running())
        return;
    stop();
    for (int i = 0; i < 100 && waitFor(state_->process, /*look*/ true) == Waited::running; ++i)
        ::usleep(10000); // it removes its unfinished files
    ::kill(-state_->process, SIGKILL);
    waitFor(state_->process);
}

Status ToolProcess::start(const std::filesystem::path& program, const std::vector<std::string>& words)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return unavailableError(std::string("no pipe to another process: ") + std::strerror(errno));
    Descriptor ours(ends[0]), childs(ends[1]);
    ::fcntl(ours.get(), F_SETFL, O_NONBLOCK);
    SpawnRequest request;
    request.program = program.string();
    request.arguments = words;
    request.output = childs.get();
    if (const int problem = spawn(request, state_->process)) {
        state_->process = 0;
        return unavailableError(std::string("no process could be started: ") + std::strerror(problem));
    }
    state_->pipe = std::move(ours);
    state_->output.clear();
    return Done{};
}

bool ToolProcess::running() const { return state_->process > 0; }

std::optional<ToolProcess::End> ToolProcess::take()
{
    if (!running())
        return std::nullopt;
    state_->read();
    int status = 0;
    const Waited waited = waitFor(state_->process, /*look*/ true, status);
    if (waited == Waited::running)
        return std::nullopt;
    state_->read();
    state_->process = 0;
    state_->pipe.close();
    return End{waited == Waited::ended && WIFEXITED(status) ? WEXITSTATUS(status) : -1, std::move(state_->output)};
}

void ToolProcess::stop()
{
    if (running())
        ::kill(-state_->process, SIGTERM);
}

} // namespace cotan::viewer
