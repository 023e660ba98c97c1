// Loops over several threads: every item runs once for any number of threads, and exceptions of tasks arrive. Also the
// search for equal keys that runs on these threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <stdexcept>
#include <vector>

#include "../src/core/tangents_mesh.hpp"

namespace {

TEST(Parallel, partsCoverEveryItemOnceAndInOrder)
{
    for (const std::size_t count : {0u, 1u, 2u, 7u, 63u, 64u, 65u, 1000u})
        for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
            std::vector<std::atomic<int>> visits(count);
            cotan::runParts(count, threads, [&](std::size_t begin, std::size_t end) {
                ASSERT_LE(begin, end);
                for (std::size_t i = begin; i < end; ++i)
                    ++visits[i];
            });
            for (std::size_t i = 0; i < count; ++i)
                ASSERT_EQ(visits[i], 1) << i << " of " << count << " on " << threads;
        }
}

TEST(Parallel, partsOfFourBillionItemsDoNotOverflow)
{
    // The products exceed 32 bits, the width of size_t on some targets.
    EXPECT_EQ(cotan::partBegin(4000000000u, 63, 64), 3937500000u);
    EXPECT_EQ(cotan::partBegin(4000000000u, 64, 64), 4000000000u);
    EXPECT_EQ(cotan::partBegin(10, 0, 3), 0u);
    EXPECT_EQ(cotan::partBegin(10, 1, 3), 3u);
    EXPECT_EQ(cotan::partBegin(10, 2, 3), 6u);
}

TEST(Parallel, threadCountIsLimitedByTheWork)
{
    EXPECT_EQ(cotan::threadsFor(100, 10, 4), 4u);
    EXPECT_EQ(cotan::threadsFor(39, 10, 4), 3u);
    EXPECT_EQ(cotan::threadsFor(9, 10, 4), 1u);
    EXPECT_EQ(cotan::threadsFor(0, 10, 4), 1u);
    EXPECT_GE(cotan::threadsFor(100000, 1, 0), 1u);
    EXPECT_EQ(cotan::threadsFor(100000, 1, 0), std::max(1u, std::thread::hardware_concurrency()));
}

TEST(Parallel, exceptionsAreRethrownAfterAllTasksEnd)
{
    for (const std::size_t threads : {1u, 4u}) {
        std::atomic<int> running{0};
        EXPECT_THROW(cotan::runTasks(16, threads,
                                     [&](std::size_t i) {
                                         ++running;
                                         if (i == 3) {
                                             --running;
                                             throw std::runtime_error("three");
                                         }
                                         --running;
                                     }),
                     std::runtime_error);
        EXPECT_EQ(running, 0);
    }
}

TEST(FirstEqual, collidingHashesAreDistinguished)
{
    // Of 300,000 keys, about ten pairs share their 32-bit hash. Every tenth key repeats the previous one.
    std::mt19937 random(9);
    std::vector<std::array<std::uint32_t, 2>> keys;
    for (std::uint32_t i = 0; i < 300000; ++i)
        keys.push_back(i % 10 == 9 ? keys.back() : std::array{std::uint32_t(random()), std::uint32_t(random())});
    for (const std::size_t threads : {1u, 3u}) {
        const auto first = cotan::tangents::firstEqual(
            300000, [&](std::uint32_t i) { return keys[i]; }, threads);
        for (std::uint32_t i = 0; i < 300000; ++i)
            ASSERT_EQ(first[i], i % 10 == 9 ? i - 1 : i);
    }
}

} // namespace
