#include <gtest/gtest.h>

#include "truth/random.hpp"

namespace cotan {
namespace {

TEST(Random, isSplitmix64)
{
    // The first outputs for seed 1234567, as published with the generator.
    Random random(1234567);
    EXPECT_EQ(random.bits(), 6457827717110365317ull);
    EXPECT_EQ(random.bits(), 3203168211198807973ull);
    EXPECT_EQ(random.bits(), 9817491932198370423ull);
}

} // namespace
} // namespace cotan
