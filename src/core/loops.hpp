// Loops on several threads: by oneTBB if the library is built with it, otherwise by core/parallel.hpp. Results do not
// depend on the assignment of work to threads. withThreads limits their number, for all nested calls too.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/parallel.hpp"

#ifdef COTAN_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace cotan {

// Calls work(begin, end) for parts of [first, last), each of at least `grain` items except the last. Rethrows an
// exception of a call after all calls have ended.
template<class Index, class Work> void parallelRanges(Index first, Index last, Index grain, const Work& work)
{
#ifdef COTAN_WITH_TBB
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<Index>(first, last, std::size_t(grain)),
        [&](const oneapi::tbb::blocked_range<Index>& range) { work(range.begin(), range.end()); });
#else
    if (!(first < last))
        return;
    const auto count = std::size_t(last - first);
    const std::size_t threads = threadsFor(SIZE_MAX, 1);
    // Several parts per thread, so that a delayed thread does not keep the others waiting.
    const std::size_t parts = threads == 1 ? 1 : std::clamp<std::size_t>(count / std::size_t(grain), 1, 8 * threads);
    runTasks(parts, threads, [&](std::size_t i) {
        work(Index(first + Index(partBegin(count, i, parts))), Index(first + Index(partBegin(count, i + 1, parts))));
    });
#endif
}

// Calls work(i) for all first <= i < last.
template<class Index, class Work> void parallelFor(Index first, Index last, const Work& work)
{
    parallelRanges(first, last, Index(1), [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
            work(i);
    });
}

// Returns work(); its loops use at most `threads` threads. 0: the caller's limit, otherwise all cores.
template<class Work> auto withThreads(int threads, const Work& work)
{
    const ThreadLimit limit(threads > 0 ? threads : threadLimit);
#ifdef COTAN_WITH_TBB
    if (threads > 0) // oneTBB uses at most one thread per CPU, and prints a warning if more are requested
        return oneapi::tbb::task_arena(std::min(threads, oneapi::tbb::info::default_concurrency())).execute(work);
#endif
    return work();
}

} // namespace cotan
