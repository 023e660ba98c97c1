// Errors for files that cannot be read, found or written, and which files remain afterwards.
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/bytes.hpp"
#include "files/file_registry.hpp"
#include "files/json.hpp"
#include "files/output.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;
using test::readWhole;
using test::TemporaryFolder;

std::string errorIn(const Status& status) { return status ? "done" : status.error().message; }

template<class T> std::string errorIn(const Result<T>& result) { return result ? "done" : result.error().message; }

TEST(FileErrors, statePathAndReasonWithinTheSizeLimit)
{
    TemporaryFolder folder;
    std::ofstream(folder / "five") << "12345";
    std::ofstream(folder / "empty");
    const std::string five = (folder / "five").string(), empty = (folder / "empty").string();
    EXPECT_EQ(errorIn(readFileBytes(five, 4)), five + ": the file has 5 bytes, the limit is 4");
    const auto bytes = readFileBytes(five, 5);
    ASSERT_TRUE(bytes);
    ASSERT_EQ(bytes->size(), 5u);
    EXPECT_EQ((*bytes)[0], std::byte('1'));
    EXPECT_EQ((*bytes)[4], std::byte('5'));
    EXPECT_EQ(*usableFileSize(five, 5), 5u);
    EXPECT_EQ(errorIn(readFileBytes(empty, 4)), empty + ": the file is empty");
    EXPECT_EQ(errorIn(readFileBytes(folder / "none", 4)), (folder / "none").string() + ": no such file");
    EXPECT_EQ(errorIn(readFileBytes(folder.path(), 4)), folder.path().string() + ": expected a file, found a folder");
    EXPECT_EQ(errorIn(readFileBytes("/dev/null", 4)), "/dev/null: expected a regular file");
}

TEST(FileErrors, refuseFilesOutsideTheFolder)
{
    TemporaryFolder temporary;
    const fs::path folder = fs::canonical(temporary.path()) / "in";
    fs::create_directories(folder / "deep");
    std::ofstream(folder / "deep/a.png") << "a";
    std::ofstream(folder.parent_path() / "out.png") << "out";
    std::ofstream(folder.string() + "side.png") << "beside, and its name begins alike";
    fs::create_symlink("../out.png", folder / "link.png");
    bool outside = true;
    for (const std::string request : {"deep/a.png", "deep\\a.png", "./deep/../deep/a.png"}) {
        outside = true;
        EXPECT_EQ(findInFolder(folder, request, outside), folder / "deep/a.png") << request;
        EXPECT_FALSE(outside) << request;
    }
    EXPECT_EQ(findInFolder(folder, (folder / "deep/a.png").string(), outside), folder / "deep/a.png");
    for (const std::string& request : {std::string(), std::string("deep/a.png\0", 11), std::string("none.png"),
                                       std::string("deep"), std::string("a.png")}) {
        outside = true;
        EXPECT_FALSE(findInFolder(folder, request, outside)) << request;
        EXPECT_FALSE(outside) << request;
    }
    for (const std::string& request : {std::string("../out.png"), std::string("..\\out.png"), std::string("link.png"),
                                       folder.string() + "side.png", std::string("/etc/passwd")}) {
        outside = false;
        EXPECT_FALSE(findInFolder(folder, request, outside)) << request;
        EXPECT_TRUE(outside) << request;
    }
}

TEST(OutputErrors, occurUnlessTheFolderExistsOrCanBeMade)
{
    TemporaryFolder folder;
    std::ofstream(folder / "file") << "x";
    const std::string base = folder.path().string();
    EXPECT_EQ(errorIn(checkWritable(folder / "a")), "done");
    EXPECT_EQ(errorIn(checkWritable(folder / "file")), "done");
    EXPECT_EQ(errorIn(checkWritable(folder.path())), base + ": is a folder");
    EXPECT_EQ(errorIn(checkWritable(folder / "no/a")), base + "/no/a: the folder " + base + "/no does not exist");
    EXPECT_EQ(errorIn(checkWritable(folder / "no/deep/a", true)), "done");
    EXPECT_EQ(errorIn(checkWritable(folder / "file/deep/a", true)),
              base + "/file/deep/a: cannot create a folder: " + base + "/file is a file");
    EXPECT_EQ(errorIn(checkWritable(folder / "file/a")), base + "/file/a: the folder " + base + "/file does not exist");
    EXPECT_EQ(errorIn(checkWritable("/dev/null")), "done");
    EXPECT_FALSE(fs::exists(folder / "no"));
    if (::geteuid() != 0) { // root may write anywhere
        ::chmod(base.c_str(), 0500);
        EXPECT_EQ(errorIn(checkWritable(folder / "a")),
                  base + "/a: cannot write in the folder " + base + ": permission denied");
        ::chmod(base.c_str(), 0700);
    }
    EXPECT_EQ(errorIn(OutputFile::begin(folder / "no/a")), base + "/no/a: the folder " + base + "/no does not exist");
    EXPECT_EQ(errorIn(OutputFile::begin(folder.path())), base + ": is a folder");
    EXPECT_EQ(errorIn(makeFolder(folder / "b/c")), "done");
    EXPECT_TRUE(fs::is_directory(folder / "b/c"));
    EXPECT_EQ(errorIn(makeFolder(folder / "b/c")), "done");
    EXPECT_TRUE(errorIn(makeFolder(folder / "file")).starts_with(base + "/file: cannot create this folder: "));
    fs::create_directory(folder / "lost");
    const auto lost = OutputFile::begin(folder / "lost/a");
    ASSERT_TRUE(lost);
    fs::remove(folder / "lost");
    EXPECT_EQ(errorIn(writeBytes(*lost, {})), base + "/lost/a: cannot write: no such file or directory");
    EXPECT_EQ(errorIn(lost->open()), base + "/lost/a: cannot write: no such file or directory");
}

TEST(OutputErrors, ofAFailedRenameStateTheReasonAndLeaveNothing)
{
    TemporaryFolder folder;
    {
        auto output = OutputFile::begin(folder / "a.png");
        ASSERT_TRUE(output && writeBytes(*output, {}));
        EXPECT_EQ(output->destination(), folder / "a.png");
        fs::create_directories(folder / "a.png/full");
        EXPECT_EQ(errorIn(output->commit()), (folder / "a.png").string() + ": cannot write: is a directory");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    // The writer's error, or the system's if nothing can be written.
    fs::create_directory(folder / "gone");
    auto lost = OutputFile::begin(folder / "gone/a.png");
    ASSERT_TRUE(lost);
    EXPECT_EQ(lost->failed(outputError("a library failed")).message, "a library failed");
    EXPECT_TRUE(fs::exists(lost->path())); // the part of the trial
    fs::remove_all(folder / "gone");
    EXPECT_EQ(lost->failed(outputError("a library failed")).message,
              (folder / "gone/a.png").string() + ": cannot write: no such file or directory");
    auto full = OutputFile::begin("/dev/full"); // devices have no part to try
    ASSERT_TRUE(full);
    EXPECT_EQ(full->path(), "/dev/full");
    EXPECT_EQ(full->failed(outputError("a library failed")).message, "a library failed");
}

TEST(OutputErrors, doNotReplaceAPipe)
{
    TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    {
        auto output = OutputFile::begin(pipe);
        ASSERT_TRUE(output);
        EXPECT_EQ(output->path(), pipe);
    }
    EXPECT_TRUE(fs::is_fifo(pipe));
    auto output = OutputFile::begin(pipe);
    EXPECT_EQ(errorIn(output->commit()), "done");
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(OutputErrors, leaveNoNewFileOfSeveral)
{
    TemporaryFolder folder;
    const auto begun = [&](const char* name) {
        auto output = OutputFile::begin(folder / name);
        EXPECT_TRUE(output && writeBytes(*output, {std::as_bytes(std::span("new", 3))}));
        return *std::move(output);
    };
    {
        std::vector<OutputFile> files;
        for (const char* const name : {"a", "b", "c"})
            files.push_back(begun(name));
        EXPECT_EQ(errorIn(commitTogether(files)), "done");
    }
    for (const char* const name : {"a", "b", "c"})
        EXPECT_EQ(readWhole(folder / name), "new") << name;
    std::ofstream(folder / "a") << "old";
    fs::remove(folder / "b"), fs::remove(folder / "c");
    {
        std::vector<OutputFile> files;
        for (const char* const name : {"a", "b", "c", "d"})
            files.push_back(begun(name));
        fs::create_directories(folder / "c/full");
        EXPECT_EQ(errorIn(commitTogether(files)), (folder / "c").string() + ": cannot write: is a directory");
    }
    EXPECT_EQ(readWhole(folder / "a"), "new"); // a replaced file keeps its new contents
    EXPECT_FALSE(fs::exists(folder / "b"));
    EXPECT_FALSE(fs::exists(folder / "d"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST(OutputErrors, haveReasonsInLowerCase)
{
    EXPECT_EQ(reasonOf(EFBIG), "no space left: the file would exceed the file size limit (ulimit -f)");
    EXPECT_EQ(reasonOf(ENOENT), "no such file or directory");
    EXPECT_EQ(reasonOf(EISDIR), "is a directory");
}

// The record of files read and written; errors give both names.
TEST(FileRecord, refusesInOneSentenceAndKeepsTheFirstError)
{
    TemporaryFolder folder;
    std::ofstream(folder / "in.png") << "in";
    guardInputs(/*overwrite*/ false);
    const std::string in = (folder / "in.png").string(), out = (folder / "out.png").string();
    std::vector<fs::path> read, written;
    watchInputs([&](const fs::path& file) { read.push_back(file); });
    watchOutputs([&](const fs::path& file) { written.push_back(file); });
    EXPECT_TRUE(noteInput(in));
    EXPECT_FALSE(firstRefusal());
    EXPECT_EQ(errorIn(planOutput("-o", in)),
              "-o " + in + " would overwrite " + in
                  + ", which is an input; expected another name, "
                    "or --overwrite");
    EXPECT_TRUE(planOutput("-o", out));
    EXPECT_EQ(errorIn(planOutput("", out)),
              "-o " + out + " and " + out + " are the same file; expected different names");
    ASSERT_TRUE(firstRefusal());
    EXPECT_NE(firstRefusal()->message.find("which is an input"), std::string::npos);
    EXPECT_TRUE(writeFileWhole(out, "new"));
    EXPECT_TRUE(noteInput(out)); // writing has finished
    EXPECT_EQ(read, (std::vector<fs::path>{in, out}));
    EXPECT_EQ(written, std::vector<fs::path>{out});
    guardInputs(/*overwrite*/ false); // starts a new record
    EXPECT_FALSE(firstRefusal());
    EXPECT_TRUE(planOutput("-o", in));
    watchInputs({}), watchOutputs({});
    guardInputs(/*overwrite*/ true);
}

TEST(JsonText, keepsTheOrderOfMembersAndEveryKindOfValue)
{
    Json json = {{"b", 1}, {"a", {1.5, "x", nullptr, true}}, {"pair", Json::array()}};
    json["a"].push_back(std::uint64_t(18446744073709551615u));
    json["new"]["deep"] = -7;
    json["list"].push_back("only");
    json.update({{"b", false}, {"last", Json::object()}});
    json["gone"] = 1, json["nan"] = std::numeric_limits<double>::quiet_NaN();
    json["far"] = std::numeric_limits<double>::infinity(), json["bytes"] = "\xff";
    json.erase("gone"), json.erase("never there");
    EXPECT_EQ(toText(json),
              "{\n  \"b\": false,\n  \"a\": [\n    1.5,\n    \"x\",\n    null,\n    true,\n    "
              "18446744073709551615\n  ],\n  \"pair\": [],\n  \"new\": {\n    \"deep\": -7\n  },\n  "
              "\"list\": [\n    \"only\"\n  ],\n  \"last\": {},\n  \"nan\": null,\n  \"far\": null,\n  "
              "\"bytes\": \"\xef\xbf\xbd\"\n}\n");
    EXPECT_EQ(toText(Json({1, 2})), "[\n  1,\n  2\n]\n");
    EXPECT_EQ(toText(Json({"a", "b"})), "[\n  \"a\",\n  \"b\"\n]\n");
    EXPECT_EQ(toText(std::array<float, 2>{0.5f, -1}), "[\n  0.5,\n  -1.0\n]\n");
    EXPECT_EQ(
        toText(versioned({{"command", "map detect"}, {"x", 1}})),
        "{\n  \"format\": \"cotan-map-detect\",\n  \"version\": 1,\n  \"command\": \"map detect\",\n  \"x\": 1\n}\n");
    EXPECT_EQ(toText(versioned("cotan-convert-result", {{"x", 2}})),
              "{\n  \"format\": \"cotan-convert-result\",\n  \"version\": 1,\n  \"x\": 2\n}\n");
}

TEST(JsonText, oldNamesOfFieldsStayBesideTheNewOnes)
{
    const Json report = versioned({{"command", "lint"}, {"problem_areas", {{{"fraction", 0.5}}, {{"fraction", 1}}}}});
    EXPECT_EQ(report["problem_areas"][0], (Json{{"fraction", 0.5}, {"share", 0.5}}));
    EXPECT_EQ(report["problem_areas"][1], (Json{{"fraction", 1}, {"share", 1}}));
    EXPECT_EQ(report["hot_spots"], report["problem_areas"]);
    EXPECT_EQ(versioned({{"command", "tangents"}, {"whole", {{"reversed", 0.25}}}})["whole"],
              (Json{{"reversed", 0.25}, {"turned", 0.25}}));
}

} // namespace
} // namespace cotan
