// The process that runs one job, from both sides: the same program with a special first argument.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "batch/record.hpp"
#include "cotan/result.hpp"

namespace cotan::app {

// Which files get thumbnails: none, images, or also models, which are rendered.
enum class Thumbnails { none, pictures, models };

// What the process is asked to do.
struct ChildRequest {
    std::filesystem::path work;       // an empty folder, absolute, for its answer and the command's report
    std::int64_t parent = 0;          // id of the parent process
    std::size_t megabytes = 0;        // memory limit in MiB; 0: none
    std::size_t processorSeconds = 0; // limit of processor time; 0: none
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

// The command's report in the work folder, unless its words choose another path.
inline constexpr const char* kReportName = "report.json";

// The answer of a job process. Files are named as in the command, relative to the folder in which it ran.
struct ChildAnswer {
    std::vector<std::string> inputs, outputs;
    Thumbnail thumbnail;
};

// Reads the answer; empty if there is none or it is damaged.
ChildAnswer readAnswer(const std::filesystem::path& work);

// How a process ended.
struct Ending {
    std::optional<int> code; // exit code; none: something ended it
    int signal = 0;          // the signal that ended it; 0: none
    std::string crash;       // how the system names its end: "signal 11, Segmentation fault"
    bool lost = false;       // it ended, but how is unknown
    bool late = false;       // the time limit was exceeded
    bool overWorked = false; // the limit of processor time was exceeded
    bool killed = false;     // the system or somebody killed it
    JobRecord record;        // with its output, times and memory
};

// Both sides of the process as the system has it: job_process_posix.cpp, job_process_windows.cpp.

// The parent's side.
class JobProcess {
public:
    // Starts `program` in a folder, with additional environment variables. After `limitSeconds` of wall-clock time it
    // is asked to end where the system can, and is ended two seconds later. Errors: ErrorKind::unavailable.
    static Result<std::unique_ptr<JobProcess>> start(const std::filesystem::path& program,
                                                     const std::filesystem::path& folder, const ChildRequest& request,
                                                     const std::map<std::string, std::string>& environment,
                                                     double limitSeconds);

    JobProcess(const JobProcess&) = delete;
    JobProcess& operator=(const JobProcess&) = delete;
    ~JobProcess(); // kills the process and all that it started

    pid_t number() const;
    // Reads new output, and returns how the process ended, if it has. Call this when it may have ended, and regularly.
    std::optional<Ending> look();
    // Waits until one of the processes prints or ends, 50 ms at most.
    static void waitForOne(std::span<JobProcess* const> processes);

private:
    struct System;
    explicit JobProcess(std::unique_ptr<System> system);

    std::unique_ptr<System> system_;
};

// The process itself: ends when its parent does, leaves no memory in files, and takes the limits of the request that
// the parent cannot watch.
void limitJobProcess(const ChildRequest& request);

// Keeps the beginning and the end of what a process prints.
class KeptOutput {
public:
    void add(std::string_view text);
    std::string text() const { return cut_ ? head_ + "\n...\n" + tail_ : head_ + tail_; }

private:
    std::string head_, tail_;
    bool cut_ = false; // output between the two was dropped
};

} // namespace cotan::app
