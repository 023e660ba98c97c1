// The loops of core/loops.hpp, and map_files/pipeline.hpp.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <vector>

#include "core/loops.hpp"
#include "map_files/pipeline.hpp"

// Counts down to the allocation on this thread that fails; below 0: none.
thread_local int failing = -1;

[[gnu::noinline]] void* operator new(std::size_t size)
{
    if (failing >= 0 && failing-- == 0)
        throw std::bad_alloc();
    if (void* memory = std::malloc(size))
        return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace cotan {

using namespace app;
namespace {

// Lets `size` calls of meet() wait for each other.
class Meeting {
public:
    explicit Meeting(int size) : missing_(size) {}

    // Whether all others have arrived within 20 seconds.
    bool meet()
    {
        std::unique_lock lock(mutex_);
        --missing_;
        all_.notify_all();
        return all_.wait_for(lock, std::chrono::seconds(20), [this] { return missing_ <= 0; });
    }

private:
    std::mutex mutex_;
    std::condition_variable all_;
    int missing_;
};

TEST(ParallelLoops, everyIndexIsVisitedOnceInRangesOfTheGrainOrMore)
{
    for (const int threads : {1, 2, 5})
        for (const int last : {3, 4, 10, 999})
            for (const int grain : {1, 7, 2000}) {
                std::vector<std::atomic<int>> visits(std::size_t(last) + 1);
                withThreads(threads, [&] {
                    parallelRanges(3, last, grain, [&](int begin, int end) {
                        EXPECT_GE(end - begin, std::min(grain, last - 3));
                        for (int i = begin; i < end; ++i)
                            ++visits[std::size_t(i)];
                    });
                });
                for (int i = 0; i <= last; ++i)
                    ASSERT_EQ(visits[std::size_t(i)], i >= 3 && i < last) << i << " of " << last;
            }
    parallelFor(5, 2, [](int) { FAIL(); });
}

TEST(ParallelLoops, threadCountIsTheRequestedOne)
{
    Meeting meeting(3);
    std::atomic<int> met{0}, working{0}, maxWorking{0};
    withThreads(3, [&] {
        EXPECT_EQ(loopThreads(), 3);
        parallelFor(0, 3, [&](int) { met += meeting.meet(); });
        parallelFor(0, 100, [&](int) {
            const int now = ++working;
            for (int before = maxWorking; now > before && !maxWorking.compare_exchange_weak(before, now);) {
            }
            --working;
        });
    });
    EXPECT_EQ(met, 3); // at the same time
    EXPECT_LE(maxWorking, 3);
    EXPECT_EQ(loopThreads(), std::max(1, int(std::thread::hardware_concurrency())));
    EXPECT_EQ(withThreads(2, [] { return withThreads(0, [] { return loopThreads(); }); }), 2);
    withThreads(1, [&] {
        const auto here = std::this_thread::get_id();
        parallelFor(0, 10, [&](int) { EXPECT_EQ(std::this_thread::get_id(), here); });
    });
}

TEST(ParallelLoops, nestedLoopsShareTheRemainingThreads)
{
    withThreads(5, [&] {
        parallelFor(0, 1, [](int) { EXPECT_EQ(loopThreads(), 5); });
        parallelFor(0, 2, [](int) { EXPECT_EQ(loopThreads(), 2); });
        parallelFor(0, 9, [](int) { EXPECT_EQ(loopThreads(), 1); });
        EXPECT_EQ(loopThreads(), 5);
    });
}

TEST(ParallelLoops, exceptionsReachTheCaller)
{
    const auto throwing = [](int i) {
        if (i == 7)
            throw std::runtime_error("seven");
    };
    for (const int threads : {1, 3})
        EXPECT_THROW(withThreads(threads, [&] { parallelFor(0, 50, throwing); }), std::runtime_error);
}

// An exception must not destroy a vector of running threads: that would terminate the process.
TEST(ParallelLoops, allWorkIsDoneIfAThreadCannotStart)
{
    int refused = 0;
    for (int allocation = 0; allocation < 9; ++allocation) {
        std::atomic<int> done{0};
        failing = allocation; // 0: the vector of threads; then one for each thread
        try {
            runTasks(100, 8, [&](std::size_t) { ++done; });
            EXPECT_EQ(done, 100) << allocation;
        } catch (const std::bad_alloc&) {
            ++refused;
            EXPECT_EQ(done, 0) << allocation;
        }
        failing = -1;
    }
    EXPECT_EQ(refused, 1);
}

TEST(ParallelLoops, pipelineKeepsOrderAndWorksInParallel)
{
    for (const std::size_t limit : {0u, 1u, 3u}) {
        int read = 0;
        std::atomic<int> given{0}, met{0};
        Meeting meeting{int(limit)};
        const auto next = [&]() -> std::shared_ptr<int> {
            EXPECT_LE(read - given, std::max(int(limit), 1) - 1);
            return read < 10 ? std::make_shared<int>(read++) : nullptr;
        };
        const auto work = [&](const std::shared_ptr<int>& item) {
            met += *item < int(limit) && meeting.meet();
            *item *= 2;
        };
        const auto give = [&](const std::shared_ptr<int>& item) { EXPECT_EQ(*item, 2 * given++); };
        withThreads(3, [&] { pipeline(limit, next, work, give); });
        EXPECT_EQ(given, 10);
        EXPECT_EQ(met, int(limit));
    }
}

TEST(ParallelLoops, pipelineReadsWhileItGives)
{
    Meeting meeting(2); // of the reader of item 1 and the receiver of item 0
    int read = 0, given = 0;
    bool metInRead = false, metInGive = false;
    const auto next = [&]() -> std::shared_ptr<int> {
        if (read == 1)
            metInRead = meeting.meet();
        return read < 2 ? std::make_shared<int>(read++) : nullptr;
    };
    const auto give = [&](const std::shared_ptr<int>& item) {
        if (*item == 0)
            metInGive = meeting.meet();
        ++given;
    };
    withThreads(2, [&] {
        pipeline(
            4, next, [](const std::shared_ptr<int>&) {}, give);
    });
    EXPECT_TRUE(metInRead && metInGive);
    EXPECT_EQ(given, 2);
}

// Each stage may fail; the others end, whatever they wait for.
TEST(ParallelLoops, exceptionsOfAPipelineReachTheCaller)
{
    for (const int threads : {1, 3})
        for (const int failing : {0, 1, 2}) {
            int read = 0;
            const auto failAt = [&](int stage, int item) {
                if (stage == failing && item == 5)
                    throw std::runtime_error("five");
            };
            const auto next = [&]() -> std::shared_ptr<int> {
                failAt(0, read);
                return read < 50 ? std::make_shared<int>(read++) : nullptr;
            };
            const auto work = [&](const std::shared_ptr<int>& item) { failAt(1, *item); };
            const auto give = [&](const std::shared_ptr<int>& item) { failAt(2, *item); };
            EXPECT_THROW(withThreads(threads, [&] { pipeline(4, next, work, give); }), std::runtime_error)
                << threads << " threads, stage " << failing;
        }
}

} // namespace
} // namespace cotan
