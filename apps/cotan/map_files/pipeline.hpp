// What is read, worked on by several threads, and written in order: by oneTBB where Cotan is built with it.
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

namespace cotan {

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
