// Names of objects, materials and images as names of files.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/file_names.hpp"

namespace cotan {
namespace {

using Names = std::vector<std::string>;

TEST(FileNames, differWhereNamesOfObjectsDiffer)
{
    EXPECT_EQ(fileNameParts({"a b", "a_b"}), (Names{"a_b-2", "a_b"})) << "the name that needs no change keeps it";
    EXPECT_EQ(fileNameParts({"a/b", "a:b", "a\\b"}), (Names{"a_b", "a_b-2", "a_b-3"}));
    EXPECT_EQ(fileNameParts({"A", "a", "a-2"}), (Names{"A", "a-3", "a-2"})) << "some file systems ignore case";
    EXPECT_EQ(fileNameParts({"lid", "lid", "lid"}), (Names{"lid", "lid-2", "lid-3"}));
    EXPECT_EQ(fileNameParts({"lid", "cup"}, {"LID"}), (Names{"lid-2", "cup"}));
    EXPECT_EQ(fileNameParts({}), Names{});
}

TEST(FileNames, neitherLeaveAFolderNorMeanADevice)
{
    for (const auto& [name, part] : {std::pair("", "unnamed"), // as no file
                                     {"..", "__"},
                                     {".", "_"},
                                     {"../../etc/passwd", "_._.._etc_passwd"},
                                     {".hidden", "_hidden"},
                                     {"lid.", "lid_"},
                                     {"lid ", "lid_"},
                                     {"CON", "_CON"},
                                     {"nul.txt", "_nul.txt"},
                                     {"Com1", "_Com1"},
                                     {"console", "console"},
                                     {"com12", "com12"},
                                     {"a\nb\tc\x7f", "a_b_c_"},
                                     {"wall.001", "wall.001"},
                                     {"-o", "-o"}})
        EXPECT_EQ(fileNamePart(name), part) << name;
    EXPECT_EQ(fileNamePart(std::string("a\0b", 3)), "a_b");
}

TEST(FileNames, areUtf8OfAtMost64Bytes)
{
    EXPECT_EQ(fileNamePart("T\xC3\xBCr \xE6\x88\xB8 \xF0\x9F\x9A\xAA"), "T\xC3\xBCr_\xE6\x88\xB8_\xF0\x9F\x9A\xAA");
    EXPECT_EQ(fileNamePart("T\xFCr"), "T_r") << "Latin-1";
    for (const char* const bad : {"\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xC2\x85"})
        EXPECT_EQ(fileNamePart(bad).find_first_not_of('_'), std::string::npos) << "no UTF-8, or a control character";
    EXPECT_EQ(fileNamePart(std::string(300, 'x')), std::string(64, 'x'));
    EXPECT_EQ(fileNamePart(std::string(63, 'x') + "\xC3\xBC"), std::string(63, 'x')) << "no half of a character";
    const Names two = fileNameParts({std::string(64, 'x') + "1", std::string(64, 'x') + "2"});
    EXPECT_EQ(two[1], std::string(64, 'x') + "-2");
}

} // namespace
} // namespace cotan
