// Loops that may run on several threads: by oneTBB where the library is built with it, one step after the other where
// not. Which thread does what never shows in a result.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#ifdef COTAN_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace cotan {

// Calls work(begin, end) for parts of [first, last), each of at least `grain` items but for the last. Throws what a
// call has thrown, after all have ended.
template<class Index, class Work> void parallelRanges(Index first, Index last, Index grain, const Work& work)
{
#ifdef COTAN_WITH_TBB
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<Index>(first, last, std::size_t(grain)),
        [&](const oneapi::tbb::blocked_range<Index>& range) { work(range.begin(), range.end()); });
#else
    static_cast<void>(grain);
    if (first < last)
        work(first, last);
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

// What work() returns, its loops run on at most that many threads; 0: as many as the caller may use, else all cores.
template<class Work> auto withThreads(int threads, const Work& work)
{
#ifdef COTAN_WITH_TBB
    if (threads > 0)
        return oneapi::tbb::task_arena(threads).execute(work);
#endif
    static_cast<void>(threads);
    return work();
}

// How many threads a loop that is started here may use.
inline int loopThreads()
{
#ifdef COTAN_WITH_TBB
    return oneapi::tbb::this_task_arena::max_concurrency();
#else
    return 1;
#endif
}

// What is made in order, worked on in any order, and taken in order: items are pointers. read() gives the next one,
// null at the end; work(item) changes it; give(item) takes it. At most `most` items are under way.
template<class Read, class Work, class Give>
void pipeline(std::size_t most, const Read& read, const Work& work, const Give& give)
{
    using Item = decltype(read());
#ifdef COTAN_WITH_TBB
    namespace tbb = oneapi::tbb;
    const auto source = [&](tbb::flow_control& control) -> Item {
        Item item = read();
        if (!item)
            control.stop();
        return item;
    };
    const auto stage = [&](Item item) -> Item {
        work(item);
        return item;
    };
    const auto sink = [&](Item item) -> void { give(item); };
    tbb::parallel_pipeline(std::max<std::size_t>(most, 1),
                           tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, source)
                               & tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, stage)
                               & tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, sink));
#else
    static_cast<void>(most);
    while (Item item = read()) {
        work(item);
        give(item);
    }
#endif
}

} // namespace cotan
