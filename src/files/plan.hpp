// All that a program will write, looked at before long work.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// A file that will be written.
struct PlannedOutput {
    std::string option; // that asked for it, for messages
    std::filesystem::path file;
    bool makesFolder = false; // its folder will be made
};

// The files of these names in a folder that an option names.
std::vector<PlannedOutput> plannedIn(const std::string& option, const std::filesystem::path& folder,
                                     const std::vector<std::string>& names);

// Plans each (see planOutput) and looks whether it can come to be there (see checkWritable); empty names are left out.
// Returns a sentence about each folder in which a killed run left unfinished files. Errors: those of the two.
Result<std::vector<std::string>> planOutputs(std::vector<PlannedOutput> files);

// Makes a folder and those above it. Errors: ErrorKind::output.
Status makeFolder(const std::filesystem::path& folder);

} // namespace cotan
