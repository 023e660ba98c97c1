// How far long work is, told to the caller, who may stop it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "cotan/result.hpp"

namespace cotan {

// Gets the share that is done, from 0 to 1, and returns whether to go on; empty: nobody wants to know. Work that is
// told to stop ends soon with stoppedError, writes no file and changes nothing that it was given.
using Progress = std::function<bool(double share)>;

inline Error stoppedError() { return {ErrorKind::stopped, "stopped by the caller"}; }

// Steps of one work, counted from any number of threads and told as a share of `total`.
class CountedSteps {
public:
    CountedSteps(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

    // A step is done. Returns whether to go on.
    bool step()
    {
        if (progress_ && !progress_(double(++done_) / double(total_)))
            stopped_ = true;
        return !stopped_;
    }
    bool stopped() const { return stopped_; }

private:
    const Progress& progress_;
    const std::size_t total_;
    std::atomic<std::size_t> done_ = 0;
    std::atomic<bool> stopped_ = false;
};

// The progress of part number `part` of `parts` equal ones, as one of the whole.
inline Progress partOf(const Progress& progress, std::size_t part, std::size_t parts)
{
    if (!progress)
        return {};
    return [&progress, part, parts](double share) { return progress((double(part) + share) / double(parts)); };
}

} // namespace cotan
