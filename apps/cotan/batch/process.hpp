// The parent's side of a job's process.
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

// How it ended.
struct Ending {
    int status = 0; // as wait gives it
    bool late = false;
    std::string said; // the beginning and the end of what it printed
    double seconds = 0, processorSeconds = 0;
    double megabytes = 0;
};

class JobProcess {
public:
    // Starts `program` in a folder, with these variables besides ours; after `limitSeconds` on the wall it is asked to
    // end, and two seconds later it is made to. Errors: ErrorKind::unavailable.
    static Result<JobProcess> start(const std::string& program, const std::filesystem::path& folder,
                                    const ChildRequest& request, const std::map<std::string, std::string>& environment,
                                    double limitSeconds);

    JobProcess(JobProcess&& other) noexcept;
    JobProcess& operator=(JobProcess&&) = delete;
    ~JobProcess(); // kills it, with all that it started

    pid_t number() const { return process_; }
    // What becomes readable when it prints or ends; -1: nothing any more.
    int descriptor() const { return messages_.get(); }
    // Looks whether it has ended, and takes what it printed. To be called when it may have, and now and then.
    std::optional<Ending> look();

private:
    using Clock = std::chrono::steady_clock;

    JobProcess(pid_t process, Descriptor messages, double limitSeconds);
    void listen();

    pid_t process_ = -1; // -1: none, or waited for
    Descriptor messages_;
    Clock::time_point began_ = Clock::now(), deadline_;
    bool asked_ = false, made_ = false; // to end
    std::string head_, tail_;
    bool cut_ = false; // between the two
};

} // namespace cotan
