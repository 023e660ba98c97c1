// Result: a value or one error; the kinds are the exit codes of the tool.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "cotan/result.hpp"

namespace cotan {
namespace {

TEST(Result, holdsItsValueOrItsError)
{
    Result<int> value(7);
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, 7);
    *value = 8;
    EXPECT_EQ(*std::as_const(value), 8);
    const Result<int> bad(inputError("a.obj: no faces"));
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().message, "a.obj: no faces");
    EXPECT_TRUE(Status(Done{}));
    EXPECT_FALSE(Status(outputError("b.png: no space left")));
}

TEST(Result, aFalseValueIsStillAValue)
{
    const Result<bool> no(false);
    ASSERT_TRUE(no);
    EXPECT_FALSE(*no);
    EXPECT_TRUE(Result<std::unique_ptr<int>>(std::unique_ptr<int>()));
}

TEST(Result, holdsMoveOnlyValues)
{
    Result<std::unique_ptr<int>> owner(std::make_unique<int>(3));
    EXPECT_EQ(*owner->get(), 3);
    const std::unique_ptr<int> moved = *std::move(owner);
    EXPECT_EQ(*moved, 3);
}

TEST(Result, kindsAreTheExitCodes)
{
    EXPECT_EQ(int(usageError("").kind), 1);
    EXPECT_EQ(int(inputError("").kind), 2);
    EXPECT_EQ(int(unavailableError("").kind), 3);
    EXPECT_EQ(int(outputError("").kind), 4);
    EXPECT_EQ(int(ErrorKind::limit), 5);
    EXPECT_EQ(int(Error{}.kind), 2);
    EXPECT_EQ(int(memoryError("").kind), 2);
    EXPECT_TRUE(memoryError("").memory);
    EXPECT_FALSE(inputError("").memory);
}

TEST(Result, errorStatesTheFieldOfItsMessage)
{
    const Error error = about("options.tiles", memoryError("expected fewer"));
    EXPECT_EQ(error.message, "options.tiles: expected fewer");
    EXPECT_EQ(error.field, "options.tiles");
    EXPECT_TRUE(error.memory);
    const Error outer = about("bake", error);
    EXPECT_EQ(outer.message, "bake: options.tiles: expected fewer");
    EXPECT_EQ(outer.field, "bake");
    const Error other = reworded(error, "a.png: too large");
    EXPECT_EQ(other.message, "a.png: too large");
    EXPECT_EQ(other.field, "");
    EXPECT_EQ(other.kind, ErrorKind::input);
    EXPECT_TRUE(other.memory);
}

} // namespace
} // namespace cotan
