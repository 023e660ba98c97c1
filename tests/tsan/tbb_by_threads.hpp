// What we use of oneTBB, by std::thread: for the thread sanitizer only (the preset `tsan`). The library in Debian is
// not instrumented: the sanitizer does not see how it hands work from thread to thread and reports races where there
// are none, and to suppress its frames would hide ours, which are called from them. These threads it sees. Differences:
// always four threads where not told fewer, also on smaller machines; loops inside of loops run in one thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {

namespace by_threads {

inline constexpr std::size_t kThreads = 4;
inline std::atomic<std::size_t> limit{kThreads}; // of global_control and task_arena
inline thread_local bool inside = false;         // of a loop

// Calls run(i) for all i < tasks.
template<class Run> void runAll(std::size_t tasks, const Run& run)
{
    const std::size_t threads = inside ? 1 : std::min({tasks, limit.load(), kThreads});
    std::atomic<std::size_t> next{0};
    std::exception_ptr problem;
    std::mutex guard;
    const auto work = [&] {
        const bool before = std::exchange(inside, true);
        try {
            for (std::size_t i; (i = next.fetch_add(1)) < tasks;)
                run(i);
        } catch (...) {
            const std::lock_guard lock(guard);
            problem = std::current_exception();
        }
        inside = before;
    };
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < threads; ++i)
        others.emplace_back(work);
    work();
    for (std::thread& t : others)
        t.join();
    if (problem)
        std::rethrow_exception(problem);
}

// A limit while it lives.
class Limited {
public:
    explicit Limited(std::size_t most) : before_(limit.exchange(std::max<std::size_t>(most, 1))) {}
    ~Limited() { limit = before_; }
    Limited(const Limited&) = delete;
    Limited& operator=(const Limited&) = delete;

private:
    std::size_t before_;
};

} // namespace by_threads

template<class Value> class blocked_range {
public:
    blocked_range(Value begin, Value end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
    Value begin() const { return begin_; }
    Value end() const { return end_; }
    std::size_t size() const { return std::size_t(end_ - begin_); }
    bool empty() const { return !(begin_ < end_); }
    std::size_t grainsize() const { return grain_; }

private:
    Value begin_, end_;
    std::size_t grain_;
};

template<class Value, class Body> void parallel_for(const blocked_range<Value>& range, const Body& body)
{
    if (range.empty())
        return;
    // As many parts as the grain allows, so that the threads alternate.
    const std::size_t size = range.size(),
                      parts = std::clamp<std::size_t>(size / std::max<std::size_t>(range.grainsize(), 1), 1, 64);
    by_threads::runAll(parts, [&](std::size_t i) {
        body(blocked_range<Value>(range.begin() + Value(size * i / parts),
                                  range.begin() + Value(size * (i + 1) / parts)));
    });
}

template<class Index, class Body> void parallel_for(Index first, Index last, const Body& body)
{
    parallel_for(blocked_range<Index>(first, last), [&](const blocked_range<Index>& range) {
        for (Index i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

class task_arena {
public:
    static constexpr int automatic = -1;
    explicit task_arena(int threads = automatic) : threads_(threads) {}
    template<class Work> auto execute(const Work& work)
    {
        const by_threads::Limited limited(threads_ > 0 ? std::size_t(threads_) : by_threads::kThreads);
        return work();
    }

private:
    int threads_;
};

class global_control {
public:
    enum parameter { max_allowed_parallelism };
    global_control(parameter, std::size_t most) : limited_(most) {}
    static std::size_t active_value(parameter) { return std::min(by_threads::limit.load(), by_threads::kThreads); }

private:
    by_threads::Limited limited_;
};

namespace this_task_arena {
inline int max_concurrency() { return int(std::min(by_threads::limit.load(), by_threads::kThreads)); }
} // namespace this_task_arena

namespace info {
inline int default_concurrency() { return int(by_threads::kThreads); }
} // namespace info

// ---- a pipeline of three filters: source, stage, sink -----------------------------------------

enum class filter_mode { parallel, serial_in_order, serial_out_of_order };

class flow_control {
public:
    void stop() { stopped = true; }
    bool stopped = false;
};

template<class In, class Out, class Function> struct filter {
    Function function;
};
template<class In, class Out, class Function> auto make_filter(filter_mode, const Function& f)
{
    return filter<In, Out, Function>{f};
}

template<class Item> struct Chain {
    std::function<Item(flow_control&)> source;
    std::function<Item(Item)> stage;
    std::function<void(Item)> sink;
};
template<class Item, class F, class G>
Chain<Item> operator&(const filter<void, Item, F>& source, const filter<Item, Item, G>& stage)
{
    return {source.function, stage.function, {}};
}
template<class Item, class F> Chain<Item> operator&(Chain<Item> chain, const filter<Item, void, F>& sink)
{
    chain.sink = sink.function;
    return chain;
}

template<class Item> void parallel_pipeline(std::size_t most, const Chain<Item>& chain)
{
    for (flow_control control; !control.stopped;) {
        std::vector<Item> items;
        while (items.size() < most) {
            Item item = chain.source(control);
            if (control.stopped)
                break;
            items.push_back(std::move(item));
        }
        by_threads::runAll(items.size(), [&](std::size_t i) { items[i] = chain.stage(items[i]); });
        for (Item& item : items)
            chain.sink(std::move(item));
    }
}

} // namespace tbb

namespace oneapi {
namespace tbb = ::tbb;
}
