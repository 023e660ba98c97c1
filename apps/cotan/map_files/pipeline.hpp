// A pipeline that reads in order, works in parallel and writes in order.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

#include "core/loops.hpp"

namespace cotan::app {

// The number of threads that a loop started here may use.
inline int loopThreads() { return int(threadsFor(SIZE_MAX, 1)); }

// Runs a pipeline of pointers: read() returns the next item, null at the end; work(item) changes it, in any order and
// in parallel; give(item) takes the items in order. At most `maxItems` items are in flight. Reading, work and giving
// overlap. Rethrows an exception of a call after all calls have ended.
template<class Read, class Work, class Give>
void pipeline(std::size_t maxItems, const Read& read, const Work& work, const Give& give)
{
    using Item = decltype(read());
    const std::size_t most = std::max<std::size_t>(maxItems, 1), threads = threadsFor(SIZE_MAX, 1);
    std::mutex mutex; // of what follows; not held during calls
    std::condition_variable changed;
    std::map<std::size_t, Item> worked; // that wait to be given, by their number
    std::size_t readItems = 0, givenItems = 0;
    bool reading = false, giving = false, ended = false, failed = false;

    // Takes whatever can be done next, until nothing is left.
    const auto run = [&](std::unique_lock<std::mutex>& lock) {
        while (!failed)
            if (!giving && worked.contains(givenItems)) {
                giving = true;
                const Item item = std::move(worked.extract(givenItems).mapped());
                lock.unlock();
                give(item);
                lock.lock();
                giving = false;
                ++givenItems;
                changed.notify_all();
            } else if (!ended && !reading && readItems - givenItems < most) {
                reading = true;
                lock.unlock();
                Item item = read();
                lock.lock();
                reading = false;
                ended |= !item;
                const std::size_t number = item ? readItems++ : readItems;
                changed.notify_all();
                if (!item)
                    continue;
                lock.unlock();
                work(item);
                lock.lock();
                worked.emplace(number, std::move(item));
                changed.notify_all();
            } else if (ended && !reading && readItems == givenItems) {
                return;
            } else {
                changed.wait(lock);
            }
    };
    runTasks(threads, threads, [&](std::size_t) {
        std::unique_lock lock(mutex);
        try {
            run(lock);
        } catch (...) {
            if (!lock.owns_lock())
                lock.lock();
            failed = true;
            changed.notify_all();
            throw;
        }
    });
}

} // namespace cotan::app
