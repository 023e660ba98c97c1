// A folder that stores job results, one file each. Files appear complete or not at all, so a store stays valid after
// any interruption, and any number of processes on any number of machines may share one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/file_lock.hpp"
#include "batch/record.hpp"
#include "cotan/result.hpp"

namespace cotan::app {

// The exclusive right to run one job. It ends with this object, and with the process.
using Claim = FileLock;

class Store {
public:
    // Opens or creates a folder, and removes leftovers of killed processes. Errors: ErrorKind::output if it cannot be
    // written.
    static Result<Store> open(const std::filesystem::path& folder, std::string version);

    // Opens a store for reading. Errors: ErrorKind::input if there is none.
    static Result<Store> openToRead(const std::filesystem::path& folder, std::string version);

    // The record of the job with these words, run by this version; nullopt if there is none or it is damaged.
    std::optional<JobRecord> find(const std::vector<std::string>& words) const;

    // Stores a record. Errors: ErrorKind::output.
    Status keep(const std::vector<std::string>& words, const JobRecord& record) const;

    // Returns nullopt while another process holds the claim. Without file locks, every process gets it.
    std::optional<Claim> claim(const std::vector<std::string>& words) const;

    // A folder for this process alone, created by the first call.
    Result<std::filesystem::path> workFolder();

    Store(Store&&) = default;
    Store& operator=(Store&&) = delete;
    ~Store(); // removes the work folder

private:
    Store(std::filesystem::path folder, std::string version);
    std::filesystem::path fileOf(const std::vector<std::string>& words) const;

    std::filesystem::path folder_, work_;
    std::string version_;
    FileLock workLock_;
};

} // namespace cotan::app
