// The process that runs one job, from both sides: the same program with a special first argument.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "batch/record.hpp"
#include "cotan/result.hpp"
#include "files/sandbox/process.hpp"

namespace cotan::app {

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
    int status = 0;    // as waitpid gives it
    bool lost = false; // the status is unknown
    bool late = false; // the time limit was exceeded
    JobRecord record;  // with its output, times and memory
};

// The parent's side.
class JobProcess {
public:
    // Starts `program` in a folder, with additional environment variables. After `limitSeconds` of wall-clock time it
    // gets SIGTERM, and two seconds later SIGKILL. Errors: ErrorKind::unavailable.
    static Result<std::unique_ptr<JobProcess>> start(const std::string& program, const std::filesystem::path& folder,
                                                     const ChildRequest& request,
                                                     const std::map<std::string, std::string>& environment,
                                                     double limitSeconds);

    JobProcess(const JobProcess&) = delete;
    JobProcess& operator=(const JobProcess&) = delete;
    ~JobProcess(); // kills the process and all that it started

    pid_t number() const { return process_; }
    // Becomes readable when the process prints or ends; -1: its output is closed.
    int descriptor() const { return messages_.get(); }
    // Reads new output, and returns how the process ended, if it has. Call this when it may have ended, and regularly.
    std::optional<Ending> look();

private:
    using Clock = std::chrono::steady_clock;

    JobProcess(Descriptor messages, std::chrono::duration<double> limit) : messages_(std::move(messages)), limit_(limit)
    {
    }
    void listen();

    pid_t process_ = -1; // -1: none, or reaped
    Descriptor messages_;
    Clock::time_point began_ = Clock::now();
    std::chrono::duration<double> limit_;
    bool terminated_ = false, killed_ = false; // SIGTERM, SIGKILL were sent
    std::string head_, tail_;
    bool cut_ = false; // output between the two was dropped
};

} // namespace cotan::app
