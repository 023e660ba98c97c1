// Loops over several threads, by std::thread. Which thread does what never shows in a result.
//
// This is all that there is where the library is built without oneTBB, and the core is: its packages need GLM and
// nothing else. Other parts include core/loops.hpp, whose loops are oneTBB's where it is there, because they lie inside
// one another and are many: its threads are started once and help each other.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace cotan {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
inline constexpr bool kHasThreads = false;
#else
inline constexpr bool kHasThreads = true;
#endif

// How many threads a loop that is started on this thread may use; 0: as many as there are cores.
inline thread_local int threadLimit = 0;

// Another limit while it lives.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads) : before_(std::exchange(threadLimit, threads)) {}
    ~ThreadLimit() { threadLimit = before_; }
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    int before_;
};

// How many threads are worth starting for `count` items, of which one thread should get at least
// `least`. wanted 0: as many as this thread may use.
inline std::size_t threadsFor(std::size_t count, std::size_t least, int wanted = 0)
{
    if (!kHasThreads)
        return 1;
    const std::size_t most = wanted > 0 ? std::size_t(wanted)
        : threadLimit > 0               ? std::size_t(threadLimit)
                                        : std::max(1u, std::thread::hardware_concurrency());
    return std::clamp<std::size_t>(count / least, 1, most);
}

// Calls run(i) for all i < tasks, on `threads` threads, this one among them. Where a thread cannot
// be started the others do its work. Loops inside of tasks share the threads that are left over.
// Throws what a task has thrown, after all threads have ended.
template<class Run> void runTasks(std::size_t tasks, std::size_t threads, const Run& run)
{
    if constexpr (!kHasThreads) {
        for (std::size_t i = 0; i < tasks; ++i)
            run(i);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr problem;
    std::mutex guard;
    const std::size_t used = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(tasks, 1));
    const auto work = [&] {
        const ThreadLimit inside(int(std::max<std::size_t>(threads / used, 1)));
        try {
            for (std::size_t i; (i = next.fetch_add(1)) < tasks;)
                run(i);
        } catch (...) {
            const std::lock_guard lock(guard);
            problem = std::current_exception();
        }
    };
    std::vector<std::thread> others;
    others.reserve(used);
    try {
        for (std::size_t i = 1; i < used; ++i)
            others.emplace_back(work);
    } catch (const std::exception&) {
        // no more threads to be had, or no memory for one
    }
    work();
    for (std::thread& t : others)
        t.join();
    if (problem)
        std::rethrow_exception(problem);
}

// Where part i of [0, count) begins; i = parts: its end. The product needs 64 bits everywhere.
inline std::size_t partBegin(std::size_t count, std::size_t i, std::size_t parts)
{
    return static_cast<std::size_t>(std::uint64_t(count) * i / parts);
}

// Calls run(begin, end) for consecutive parts of [0, count).
template<class Run> void runParts(std::size_t count, std::size_t threads, const Run& run)
{
    // Some parts a thread, so that one that is held up does not keep the others waiting.
    const std::size_t parts = threads == 1 ? 1 : std::min(count, threads * 8);
    runTasks(parts, threads, [&](std::size_t i) { run(partBegin(count, i, parts), partBegin(count, i + 1, parts)); });
}

// Whom to tell the share that is done, if anyone; they return whether to go on. A plain pointer, since std::function
// weighs more than what it is for here.
struct Listener {
    bool (*hear)(const void* who, double share) = nullptr;
    const void* who = nullptr;

    bool operator()(double share) const { return !hear || hear(who, share); }
};

// As runParts, and tells the shares from `from` to 1 after each of at most 65536 items, from any thread. Returns
// false where the listener has said to stop; the rest is not done then.
template<class Run>
bool runPartsWithProgress(std::size_t count, std::size_t threads, const Listener& listener, double from, const Run& run)
{
    const std::size_t usual = threads == 1 ? 1 : std::min(count, threads * 8);
    const std::size_t parts = listener.hear ? std::max(usual, count / 65536) : usual;
    std::atomic<std::size_t> done{0};
    std::atomic<bool> stopped{false};
    runTasks(parts, threads, [&](std::size_t i) {
        if (stopped)
            return;
        run(partBegin(count, i, parts), partBegin(count, i + 1, parts));
        if (!listener(from + (1 - from) * double(++done) / double(parts)))
            stopped = true;
    });
    return !stopped;
}

} // namespace cotan
