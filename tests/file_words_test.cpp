// Names of files where std::filesystem does not know those of Windows: what commands get, and what messages and reports
// show. The other half, names.js, is in tests/web/file_names_test.mjs.
#include <gtest/gtest.h>

#include <algorithm>

#include "terminal/arguments.hpp"
#include "terminal/file_words.hpp"

namespace cotan::app {
namespace {

std::string withSlashes(const std::string& word)
{
    std::string file = word.starts_with("D:") ? "D:/work/" + word.substr(2) : word;
    std::ranges::replace(file, '\\', '/');
    return file;
}

class FileWords : public testing::Test {
protected:
    FileWords() { systemFileOf = withSlashes; }
    ~FileWords() override { systemFileOf = nullptr; }
};

TEST_F(FileWords, optionsOfFilesGetSlashesAndOthersKeepTheirWords)
{
    std::string read, written, plain;
    std::vector<std::string> several;
    Arguments tool{"tool", "what it is", "1"};
    Arguments command = tool.command("do", "what it does");
    command.option("MODEL", read, "a model").reads();
    command.option("-o", written, "a file").in("FILE").writes();
    command.option("--high", several, "files").in("FILE").reads();
    command.option("--object", plain, "a name").in("TEXT");
    command.does([] { return Status(Done{}); });
    ASSERT_TRUE(tool.run(
        {"do", "C:\\a b\\m.glb", "-o", "..\\out.glb", "--high", "x\\1.obj", "--high=x\\2.obj", "--object", "a\\b"},
        [](const std::string&) {}));
    EXPECT_EQ(read, "C:/a b/m.glb");
    EXPECT_EQ(written, "../out.glb");
    EXPECT_EQ(several, (std::vector<std::string>{"x/1.obj", "x/2.obj"}));
    EXPECT_EQ(plain, "a\\b");
}

TEST_F(FileWords, messagesShowNamesAsTheyWereTyped)
{
    for (const char* const word :
         {"C:\\my maps\\a.png", "maps\\b.png", "..\\c.png", "\\\\server\\share\\d.png", "D:far.png", "e.png"})
        fileOfWord(word);
    EXPECT_EQ(asTyped("C:/my maps/a.png: no such file"), "C:\\my maps\\a.png: no such file");
    EXPECT_EQ(asTyped("-o maps/b.png would overwrite ../c.png"), "-o maps\\b.png would overwrite ..\\c.png");
    EXPECT_EQ(asTyped("//server/share/d.png: \"//server/share/d.png\""),
              "\\\\server\\share\\d.png: \"\\\\server\\share\\d.png\"");
    EXPECT_EQ(asTyped("D:/work/far.png and e.png"), "D:far.png and e.png");
}

TEST_F(FileWords, otherNamesInTheSameFoldersGetBackslashes)
{
    fileOfWord("C:\\out\\sub\\map.png");
    EXPECT_EQ(asTyped("the folder C:/out/sub does not exist"), "the folder C:\\out\\sub does not exist");
    EXPECT_EQ(asTyped("C:/out/sub/map-ao.png, C:/out/x/y.png: 3/4"),
              "C:\\out\\sub\\map-ao.png, C:\\out\\x\\y.png: 3/4");
    fileOfWord("D:near\\map.png");
    EXPECT_EQ(asTyped("D:/work/near/map-ao.png in D:/work/far"), "D:near\\map-ao.png in D:/work/far");
    EXPECT_EQ(asTyped("/E:/whole/name.bin: cut"), "E:\\whole\\name.bin: cut");
}

TEST_F(FileWords, reportsEscapeBackslashes)
{
    fileOfWord("r\\map.png");
    EXPECT_EQ(asTyped("{\"file\": \"r/map.png\", \"other\": \"r/map-ao.png\"}", /*json*/ true),
              "{\"file\": \"r\\\\map.png\", \"other\": \"r\\\\map-ao.png\"}");
}

TEST_F(FileWords, partsOfOtherWordsStay)
{
    fileOfWord("a\\b.png");
    EXPECT_EQ(asTyped("data/b.png, xa/b.png, 1/2 and https://a/b.png"),
              "data/b.png, xa/b.png, 1/2 and https://a/b.png");
}

TEST(FileWordsElsewhere, namesStay)
{
    EXPECT_EQ(fileOfWord("C:\\not a drive here"), "C:\\not a drive here");
    EXPECT_EQ(asTyped("/x:/y and C:/z"), "/x:/y and C:/z");
}

} // namespace
} // namespace cotan::app
