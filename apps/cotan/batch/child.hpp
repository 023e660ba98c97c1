// The process that runs one job: the same program with a special first argument.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "batch/record.hpp"

namespace cotan {

// Which files get thumbnails: none, images, or also models, which are rendered.
enum class Thumbnails { none, pictures, models };

// What the process is asked to do.
struct ChildRequest {
    std::filesystem::path work;       // an empty folder, absolute, for its answer and the command's report
    std::int64_t parent = 0;          // id of the parent process
    std::size_t megabytes = 0;        // memory limit in MiB; 0: none
    std::size_t processorSeconds = 0; // limit of processor time, which raises SIGXCPU; 0: none
    Thumbnails thumbnails = Thumbnails::pictures;
    std::vector<std::string> words; // of the command line
};

// Converts a request to the arguments of a job process, without the program name. isJobProcess recognises them.
std::vector<std::string> toWords(const ChildRequest& request);
bool isJobProcess(int argc, const char* const* argv);

// The main() of a job process: runs the command, records its inputs and outputs, makes the thumbnail, and returns the
// exit code. command: runs the words of a command line and returns the exit code.
int runJobProcess(int argc, const char* const* argv,
                  const std::function<int(const std::vector<std::string>&)>& command);

// Files of a job process in its work folder.
inline constexpr const char* kReportName = "report.json"; // of the command, unless its words choose another path
inline constexpr const char* kAnswerName = "answer.json";
inline constexpr const char* kThumbnailName = "thumbnail.png";

// The answer of a job process. Files are named as in the command, relative to the folder in which it ran.
struct ChildAnswer {
    std::vector<std::string> inputs, outputs;
    Thumbnail thumbnail;
};

// Reads the answer; empty if there is none or it is damaged.
ChildAnswer readAnswer(const std::filesystem::path& work);

} // namespace cotan
