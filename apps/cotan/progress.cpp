#include "progress.hpp"

#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace cotan::app {

Progress::Progress(const CommonOptions& options, std::size_t total, std::string what)
    : visible_(!options.quiet && isatty(STDERR_FILENO) == 1), total_(total), what_(std::move(what))
{
    show(0);
}

Progress::~Progress()
{
    if (visible_)
        fmt::print(stderr, "\r\033[K");
}

void Progress::step() { show(++done_); }

void Progress::show(std::size_t done)
{
    if (!visible_)
        return;
    const std::lock_guard lock(printing_);
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::string line = fmt::format("{} of {} {}", done, total_, what_);
    if (done > 0)
        line += fmt::format(", about {:.0f} s left", spent / double(done) * double(total_ - done));
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
}

} // namespace cotan::app
