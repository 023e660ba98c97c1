// Loops that may run on several threads: by oneTBB where the library is built with it, by core/parallel.hpp where not.
// Which thread does what never shows in a result. How many they use, withThreads says, for all that is called inside.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/parallel.hpp"

#ifdef COTAN_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
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
    if (!(first < last))
        return;
    const auto count = std::size_t(last - first);
    const std::size_t threads = threadsFor(SIZE_MAX, 1);
    // Some parts a thread, so that one that is held up does not keep the others waiting.
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

// What work() returns, its loops run on at most that many threads; 0: as many as the caller may use, else all cores.
template<class Work> auto withThreads(int threads, const Work& work)
{
    const ThreadLimit limit(threads > 0 ? threads : threadLimit);
#ifdef COTAN_WITH_TBB
    if (threads > 0) // oneTBB runs no more than there are processors, and warns on standard error where it is asked to
        return oneapi::tbb::task_arena(std::min(threads, oneapi::tbb::info::default_concurrency())).execute(work);
#endif
    return work();
}

// How many threads a loop that is started here may use.
inline int loopThreads()
{
#ifdef COTAN_WITH_TBB
    return oneapi::tbb::this_task_arena::max_concurrency();
#else
    return int(threadsFor(SIZE_MAX, 1));
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
    for (bool more = true; more;) {
        std::vector<Item> items;
        while (items.size() < std::max<std::size_t>(most, 1) && more) {
            Item item = read();
            more = bool(item);
            if (more)
                items.push_back(std::move(item));
        }
        parallelFor(std::size_t(0), items.size(), [&](std::size_t i) { work(items[i]); });
        for (const Item& item : items)
            give(item);
    }
#endif
}

} // namespace cotan
