// Loops on several threads, by std::thread; on this thread alone where there are none. Results do not depend on the
// assignment of work to threads. withThreads limits their number, for all nested calls too.
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

// The maximum number of threads for loops started on this thread; 0: one per core.
inline thread_local int threadLimit = 0;

// Sets threadLimit for its lifetime.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads) : before_(std::exchange(threadLimit, threads)) {}
    ~ThreadLimit() { threadLimit = before_; }
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    int before_;
};

// Returns the number of threads worth starting for `count` items if each should get at least `minimum`. wanted: the
// maximum; 0: the limit of this thread.
inline std::size_t threadsFor(std::size_t count, std::size_t minimum, int wanted = 0)
{
    if (!kHasThreads)
        return 1;
    static const unsigned cores = std::thread::hardware_concurrency(); // opens a file each time
    const std::size_t maximum = wanted > 0 ? std::size_t(wanted)
        : threadLimit > 0                  ? std::size_t(threadLimit)
                                           : std::max(1u, cores);
    return std::clamp<std::size_t>(count / minimum, 1, maximum);
}

// Calls run(i) for all i < tasks on `threads` threads, including this one. If a thread cannot be started, the others do
// its work. Loops inside tasks share the remaining threads. Rethrows an exception of a task after all threads have
// ended.
template<class Run> void runTasks(std::size_t tasks, std::size_t threads, const Run& run)
{
    if constexpr (!kHasThreads) {
        for (std::size_t i = 0; i < tasks; ++i)
            run(i);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    std::mutex mutex;
    const std::size_t started = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(tasks, 1));
    const auto work = [&] {
        const ThreadLimit inside(int(std::max<std::size_t>(threads / started, 1)));
        try {
            for (std::size_t i; (i = next.fetch_add(1)) < tasks;)
                run(i);
        } catch (...) {
            const std::lock_guard lock(mutex);
            error = std::current_exception();
        }
    };
    std::vector<std::thread> others;
    others.reserve(started);
    try {
        for (std::size_t i = 1; i < started; ++i)
            others.emplace_back(work);
    } catch (const std::exception&) {
        // No more threads are available, or no memory for one.
    }
    work();
    for (std::thread& t : others)
        t.join();
    if (error)
        std::rethrow_exception(error);
}

// Returns the begin of part i of [0, count); i = parts: the end. The product needs 64 bits on every platform.
inline std::size_t partBegin(std::size_t count, std::size_t i, std::size_t parts)
{
    return static_cast<std::size_t>(std::uint64_t(count) * i / parts);
}

// Calls run(begin, end) for consecutive parts of [0, count), each of at least `grain` items if there are as many.
template<class Run> void runParts(std::size_t count, std::size_t threads, const Run& run, std::size_t grain = 1)
{
    // Several parts per thread, so that a delayed thread does not keep the others waiting.
    const std::size_t parts = threads == 1 ? 1 : std::clamp<std::size_t>(count / grain, 1, threads * 8);
    runTasks(parts, threads, [&](std::size_t i) { run(partBegin(count, i, parts), partBegin(count, i + 1, parts)); });
}

// Calls work(begin, end) for parts of [first, last), each of at least `grain` items if there are as many. Rethrows an
// exception of a call after all calls have ended.
template<class Index, class Work> void parallelRanges(Index first, Index last, Index grain, const Work& work)
{
    if (first < last)
        runParts(
            std::size_t(last - first), threadsFor(SIZE_MAX, 1),
            [&](std::size_t begin, std::size_t end) { work(Index(first + Index(begin)), Index(first + Index(end))); },
            std::size_t(grain));
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
    return work();
}

// An optional callback for the fraction done; it returns whether to continue. A plain pointer, because std::function is
// too heavy here.
struct Listener {
    bool (*notify)(const void* context, double fraction) = nullptr;
    const void* context = nullptr;

    bool operator()(double fraction) const { return !notify || notify(context, fraction); }
};

// Like runParts; reports fractions from `from` to 1 after each part of at most about 65536 items, from any thread.
// Returns false if the listener stops it; the remaining parts are then not run.
template<class Run>
bool runPartsWithProgress(std::size_t count, std::size_t threads, const Listener& listener, double from, const Run& run)
{
    const std::size_t usual = threads == 1 ? 1 : std::min(count, threads * 8);
    const std::size_t parts = listener.notify ? std::max(usual, count / 65536) : usual;
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
