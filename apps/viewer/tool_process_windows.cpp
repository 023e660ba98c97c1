#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#include "files/sandbox/process_windows.hpp"
#include "tool_process.hpp"

namespace cotan::viewer {

struct ToolProcess::State {
    Handle job, process;
    Pipe pipe;
    std::thread reader;
    std::atomic<bool> ended = false; // its streams are closed
    std::string output;              // once it has ended

    void read()
    {
        std::array<std::byte, 4096> bytes;
        while (const std::size_t got = readPipe(pipe.ours.get(), bytes))
            output.append(reinterpret_cast<const char*>(bytes.data()),
                          std::min(got, kMaxToolOutput - std::min(kMaxToolOutput, output.size())));
        ended = true;
    }
};

ToolProcess::ToolProcess() : state_(std::make_unique<State>()) {}

ToolProcess::~ToolProcess()
{
    stop();
    if (state_->reader.joinable())
        state_->reader.join();
}

Status ToolProcess::start(const std::filesystem::path& program, const std::vector<std::string>& words)
{
    State& s = *state_;
    s.job = endingJob();
    s.pipe = Pipe();
    if (!s.pipe.open(/*childReads*/ false))
        return unavailableError("no pipe to another process: " + lastReason());
    const HANDLE output = s.pipe.childs.get();
    if (const std::string why = spawn({program, words, nullptr, output, output, s.job.get()}, s.process); !why.empty())
        return unavailableError("no process could be started: " + why);
    s.pipe.childs.close();
    s.ended = false;
    s.output.clear();
    s.reader = std::thread([&s] { s.read(); });
    return Done{};
}

bool ToolProcess::running() const { return state_->reader.joinable(); }

std::optional<ToolProcess::End> ToolProcess::take()
{
    State& s = *state_;
    if (!running() || !s.ended)
        return std::nullopt;
    s.reader.join();
    DWORD code = 0;
    ::WaitForSingleObject(s.process.get(), INFINITE);
    ::GetExitCodeProcess(s.process.get(), &code);
    s.process = Handle();
    std::erase(s.output, '\r');
    return End{code <= 255 ? int(code) : -1, std::move(s.output)};
}

void ToolProcess::stop()
{
    if (running())
        ::TerminateJobObject(state_->job.get(), ~0u);
}

} // namespace cotan::viewer
