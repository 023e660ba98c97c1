// A pipeline that reads in order, works in parallel and writes in order: by oneTBB in builds that have it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/loops.hpp"

#ifdef COTAN_WITH_TBB
#include <oneapi/tbb/parallel_pipeline.h>
#endif

namespace cotan::app {

// The number of threads that a loop started here may use.
inline int loopThreads()
{
#ifdef COTAN_WITH_TBB
    return oneapi::tbb::this_task_arena::max_concurrency();
#else
    return int(threadsFor(SIZE_MAX, 1));
#endif
}

// Runs a pipeline of pointers: read() returns the next item, null at the end; work(item) changes it, in any order and
// in parallel; give(item) takes the items in order. At most `maxItems` items are in flight.
template<class Read, class Work, class Give>
void pipeline(std::size_t maxItems, const Read& read, const Work& work, const Give& give)
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
    tbb::parallel_pipeline(std::max<std::size_t>(maxItems, 1),
                           tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, source)
                               & tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, stage)
                               & tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, sink));
#else
    for (bool more = true; more;) {
        std::vector<Item> items;
        while (items.size() < std::max<std::size_t>(maxItems, 1) && more) {
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

} // namespace cotan::app
