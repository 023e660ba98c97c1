#include "batch/child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "files/children.hpp"

namespace cotan::app {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kGrace = 2;                      // seconds between SIGTERM and SIGKILL
constexpr std::size_t kHead = 4096, kTail = 8192; // bytes of output kept, of the beginning and of the end
constexpr int kMaxReads = 64;                     // per call, so that other processes get their turn

double secondsOf(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

} // namespace

Result<std::unique_ptr<JobProcess>> JobProcess::start(const std::string& program, const std::filesystem::path& folder,
                                                      const ChildRequest& request,
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
    std::unique_ptr<JobProcess> job(new JobProcess(Descriptor(pair[0]), Seconds(limitSeconds)));
    ::fcntl(pair[0], F_SETFL, O_NONBLOCK);
    if (const int problem = spawn({program, toWords(request), -1, theirs.get(), folder, environment}, job->process_))
        return failed(problem);
    return job;
}

JobProcess::~JobProcess()
{
    if (process_ < 0)
        return;
    ::kill(-process_, SIGKILL);
    waitFor(process_);
}

void JobProcess::listen()
{
    std::array<char, 4096> bytes;
    for (int i = 0; i < kMaxReads && messages_.get() >= 0; ++i) {
        const ssize_t got = ::read(messages_.get(), bytes.data(), bytes.size());
        if (got < 0 && (errno == EAGAIN || errno == EINTR))
            return;
        if (got <= 0) {
            messages_.close();
            return;
        }
        std::string_view text(bytes.data(), std::size_t(got));
        const std::size_t toHead = std::min(text.size(), kHead - head_.size());
        head_ += text.substr(0, toHead);
        tail_ += text.substr(toHead);
        if (tail_.size() > 2 * kTail) {
            tail_.erase(0, tail_.size() - kTail);
            cut_ = true;
        }
    }
}

std::optional<Ending> JobProcess::look()
{
    listen();
    Ending ending;
    rusage usage{};
    const Waited found = waitFor(process_, /*look*/ true, ending.status, &usage);
    const auto now = Clock::now();
    if (found == Waited::running) {
        if (!terminated_ && now - began_ >= limit_) {
            ::kill(-process_, SIGTERM);
            terminated_ = true;
        }
        if (!killed_ && now - began_ >= limit_ + Seconds(kGrace)) {
            ::kill(-process_, SIGKILL);
            killed_ = true;
        }
        return std::nullopt;
    }
    ::kill(-process_, SIGKILL); // kills processes that it left running
    process_ = -1;
    listen(); // reads the remaining output
    ending.lost = found == Waited::lost;
    ending.late = terminated_;
    ending.record.output = cut_ ? head_ + "\n...\n" + tail_ : head_ + tail_;
    ending.record.seconds = Seconds(now - began_).count();
    ending.record.processorSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    ending.record.megabytes = double(usage.ru_maxrss) / 1024;
    return ending;
}

} // namespace cotan::app
