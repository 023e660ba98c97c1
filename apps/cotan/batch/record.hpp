// What became of a job, and how that is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/digest.hpp"

namespace cotan {

// The better ones first.
enum class JobState {
    done,
    limit,   // done, and over a limit that its words ask for: exit code 5
    notRun,  // nobody has run it yet, or not with these inputs
    skipped, // a job that it waits for failed
    failed,  // ended with another exit code
    late,    // took longer than its limit
    memory,  // wanted more memory than its limit
    crashed, // ended by a signal
};

// "done", "over limit", "not run", "skipped", "failed", "too slow", "out of memory", "crashed".
std::string_view name(JobState state);

struct Degrees {
    double mean = 0;
    std::string of; // what they measure, in a few words
};

struct Thumbnail {
    int width = 0, height = 0; // pixels
    std::string jpeg;          // its file in base64; empty: none
};

struct JobRecord {
    JobState state = JobState::notRun;
    std::optional<int> code;   // exit code; none where it did not run, or was ended by a signal
    std::optional<int> signal; // that ended it
    int runs = 0;              // how often it was started until then
    std::string reason;        // one line, why it is not done
    std::string said;          // what it printed, the beginning and the end of it
    double seconds = 0, processorSeconds = 0;
    double megabytes = 0; // most memory at a time
    std::optional<Degrees> degrees;
    Thumbnail thumbnail;
    std::vector<FileState> inputs, outputs;
    std::int64_t at = 0; // when the files' states were taken: nanoseconds since 1970
};

// Whether a run that ended so ends so again with the same inputs: what limits, signals and the machine ended may not.
bool repeatable(const JobRecord& record);

// One line of JSON with the words and the version beside it, for people who look into a store.
std::string toText(const JobRecord& record, const std::vector<std::string>& words, const std::string& version);

// Nothing for what is no whole record of this format.
std::optional<JobRecord> parseRecord(std::string_view text);

// The degrees in the JSON report of a command; nothing where it has none.
std::optional<Degrees> degreesIn(std::string_view report);

} // namespace cotan
