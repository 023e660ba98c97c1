// The process that one job runs in: the same program, told by its first word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "batch/record.hpp"

namespace cotan {

// Of which pictures thumbnails are made.
enum class Thumbnails { none, pictures, models };

// What the process is told.
struct ChildRequest {
    std::filesystem::path work;       // an empty folder, absolute: for its answer, and for the command's report
    std::int64_t parent = 0;          // the process that asks
    std::size_t megabytes = 0;        // MiB that it may take; 0: no limit
    std::size_t processorSeconds = 0; // that it may take; then it gets SIGXCPU. 0: no limit
    Thumbnails thumbnails = Thumbnails::pictures;
    std::vector<std::string> words; // of the command line
};

// The words for a program that is to be such a process, without its name, and back.
std::vector<std::string> toWords(const ChildRequest& request);
bool isJobProcess(int argc, const char* const* argv);

// What a job process's main() returns: runs the command, notes what it reads and writes, makes the thumbnail. command:
// runs the words of a command line and returns the exit code.
int runJobProcess(int argc, const char* const* argv,
                  const std::function<int(const std::vector<std::string>&)>& command);

// What the process leaves in its work folder.
inline constexpr const char* kReportName = "report.json"; // of the command, where its words do not say another place
inline constexpr const char* kAnswerName = "answer.json";
inline constexpr const char* kThumbnailName = "thumbnail.png";

// What the answer says. Files are as the command named them, relative to the folder that it ran in.
struct ChildAnswer {
    std::vector<std::string> inputs, outputs;
    Thumbnail thumbnail;
};

// An empty one where there is none.
ChildAnswer readAnswer(const std::filesystem::path& work);

} // namespace cotan
