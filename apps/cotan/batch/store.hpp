// A folder that keeps what became of jobs, a file for each. Files appear whole or not at all, so a store is good after
// any interruption, and any number of processes, on any number of machines, may use one at a time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/record.hpp"
#include "cotan/result.hpp"
#include "files/sandbox/process.hpp"

namespace cotan {

// The right to run one job, which one process has at a time; gone with this, and with the process.
class Claim {
public:
    explicit Claim(Descriptor file) : file_(std::move(file)) {}

private:
    Descriptor file_;
};

class Store {
public:
    // Opens a folder, or makes it; what killed processes left in it goes. Errors: ErrorKind::output where nothing can
    // be written there.
    static Result<Store> open(const std::filesystem::path& folder, std::string version);

    // One that is only read. Errors: ErrorKind::input where there is none.
    static Result<Store> openToRead(const std::filesystem::path& folder, std::string version);

    // The record of a job: of these words, run by this version. Nothing where there is none, or only a broken one.
    std::optional<JobRecord> find(const std::vector<std::string>& words) const;

    // Errors: ErrorKind::output.
    Status keep(const std::vector<std::string>& words, const JobRecord& record) const;

    // Nothing while another process has it. On file systems without locks everybody gets it.
    std::optional<Claim> claim(const std::vector<std::string>& words) const;

    // A folder for this process alone, made on the first call.
    Result<std::filesystem::path> workFolder();

    const std::filesystem::path& folder() const { return folder_; }

    Store(Store&&) = default;
    Store& operator=(Store&&) = delete;
    ~Store(); // removes the work folder

private:
    Store(std::filesystem::path folder, std::string version);
    std::filesystem::path fileOf(const std::vector<std::string>& words) const;

    std::filesystem::path folder_, work_;
    std::string version_;
    Descriptor workLock_;
};

} // namespace cotan
