#include "terminal/progress_line.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "terminal/printable.hpp"
#include "terminal/screen.hpp"

namespace cotan::app {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxColumns = 79; // a full line of 80 would wrap on some terminals
constexpr auto kBetween = std::chrono::milliseconds(100);
constexpr double kSettle = 2;            // seconds, and
constexpr double kSettleFraction = 0.03; // fraction of the work, before the remaining time is shown
constexpr double kFollow = 0.1;          // weight of a new estimate in the remaining time shown

std::atomic<bool> lineVisible = false;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::size_t columns()
{
    const std::size_t width = terminalWidth(stderr);
    return width > 1 ? std::min(width - 1, kMaxColumns) : kMaxColumns;
}

// Escapes control characters and cuts the text to `width` UTF-8 characters, ending with "..." if it was cut.
std::string fitted(const std::string& text, std::size_t width)
{
    std::string clean;
    std::size_t count = 0;
    for (const char c : printable(text)) {
        const bool starts = (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        if (starts && ++count > width)
            break;
        clean += c;
    }
    if (count > width && width >= 3) {
        for (int dropped = 0; dropped < 3; ++dropped) {
            while (!clean.empty() && (static_cast<unsigned char>(clean.back()) & 0xc0) == 0x80)
                clean.pop_back();
            clean.pop_back();
        }
        clean += "...";
    }
    return clean;
}

std::string timeText(double s)
{
    if (s < 90)
        return fmt::format("about {:.0f} s left", s < 10 ? std::ceil(s) : std::round(s / 5) * 5);
    return s < 5400 ? fmt::format("about {:.0f} min left", s / 60) : fmt::format("about {:.1f} h left", s / 3600);
}

} // namespace

ProgressLine::ProgressLine(bool quiet, std::size_t total, std::string what)
    : visible_(!quiet && isTerminal(stderr)), total_(double(total)), what_(std::move(what)), start_(Clock::now()),
      drawn_(start_)
{
    const std::lock_guard lock(mutex_);
    if (visible_)
        draw(start_);
}

ProgressLine::~ProgressLine() { wipeProgress(); }

Progress ProgressLine::within()
{
    return [this](double fraction) {
        const std::lock_guard lock(mutex_);
        if (fraction <= 0 && begun_)
            base_ += 1;
        begun_ = true;
        at(base_ + std::clamp(fraction, 0.0, 1.0));
        return true;
    };
}

void ProgressLine::add(double steps)
{
    const std::lock_guard lock(mutex_);
    base_ += steps;
    at(base_);
}

// The caller holds the lock.
void ProgressLine::at(double done)
{
    if (!visible_)
        return;
    done_ = std::max(done_, std::min(done, total_));
    const auto now = Clock::now();
    if (now - drawn_ >= kBetween)
        draw(now);
}

void ProgressLine::draw(Clock::time_point now)
{
    const double spent = seconds(now - start_), fraction = total_ > 0 ? done_ / total_ : 0;
    std::string tail;
    if (total_ > 0)
        tail = fmt::format(": {:.0f} %", std::min(99.0, std::floor(fraction * 100)));
    if (spent >= kSettle && fraction >= kSettleFraction) {
        const double estimate = spent * (1 - fraction) / fraction;
        left_ = left_ < 0 ? estimate : left_ - seconds(now - drawn_) + kFollow * (estimate - left_);
        left_ = std::max(left_, 0.0);
        tail += ", " + timeText(left_);
    } else if (total_ == 0) {
        tail = " ...";
    }
    drawn_ = now;
    const std::size_t width = columns();
    const std::string line =
        tail.size() < width ? fitted(what_, width - tail.size()) + tail : fitted(what_ + tail, width);
    lineVisible = true;
    std::fputs(("\r\033[K" + line).c_str(), stderr);
}

void wipeProgress()
{
    if (lineVisible.exchange(false))
        std::fputs("\r\033[K", stderr);
}

} // namespace cotan::app
