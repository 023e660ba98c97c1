// The parent's side of a job process.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include <sys/types.h>

#include "batch/child.hpp"
#include "cotan/result.hpp"
#include "files/sandbox/process.hpp"

namespace cotan {

// How a process ended. megabytes: maximum resident memory in MiB. late: the time limit was exceeded.
struct Ending {
    int status = 0;    // as waitpid gives it
    bool lost = false; // the status is unknown
    bool late = false;
    std::string output; // beginning and end of its output
    double seconds = 0, processorSeconds = 0;
    double megabytes = 0;
};

class JobProcess {
public:
    // Starts `program` in a folder, with additional environment variables. After `limitSeconds` of wall-clock time it
    // gets SIGTERM, and two seconds later SIGKILL. Errors: ErrorKind::unavailable.
    static Result<JobProcess> start(const std::string& program, const std::filesystem::path& folder,
                                    const ChildRequest& request, const std::map<std::string, std::string>& environment,
                                    double limitSeconds);

    JobProcess(JobProcess&& other) noexcept;
    JobProcess& operator=(JobProcess&&) = delete;
    ~JobProcess(); // kills the process and all that it started

    pid_t number() const { return process_; }
    // Becomes readable when the process prints or ends; -1: its output is closed.
    int descriptor() const { return messages_.get(); }
    // Reads new output, and returns how the process ended, if it has. Call this when it may have ended, and regularly.
    std::optional<Ending> look();

private:
    using Clock = std::chrono::steady_clock;

    JobProcess(pid_t process, Descriptor messages, double limitSeconds);
    void listen();

    pid_t process_ = -1; // -1: none, or reaped
    Descriptor messages_;
    Clock::time_point began_ = Clock::now(), deadline_;
    bool terminated_ = false, killed_ = false; // SIGTERM, SIGKILL were sent
    std::string head_, tail_;
    bool cut_ = false; // output between the two was dropped
};

} // namespace cotan
