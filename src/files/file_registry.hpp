// What this process reads and what it writes, so that no file is replaced that it reads and no two outputs go to one
// place. Off until a program turns it on; the command line does, a library's user may read and write as he likes.
//
//     guardInputs(/*overwrite*/ false);
//     planOutput("-o", "a.png");      // before work: fails where -o is one file with another output, or with an input
//     readImage("./a.png");           // fails: -o would replace it
//     writeImage("b.png", image);     // fails where b.png was read or written before
//
// One file is one file by any name: links, "..", symbolic links of folders. Pipes and devices are never counted.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Starts the registry, empty. overwrite: everything is allowed, and the registry only forgets.
void guardInputs(bool overwrite);

// Says what will be written. `option` names it in messages. Errors: ErrorKind::usage where it is a file that was read
// or that another planned output is.
Status planOutput(const std::string& option, const std::filesystem::path& file);

// To be called by all that read files, before they do. Errors: ErrorKind::usage where an output that is planned or
// being written would replace the file. Outputs that are finished may be read again.
Status noteInput(const std::filesystem::path& file);

// Tells the watcher of every input, whether the registry is on or not: how a process that reads for another one can
// tell that one. Set it while there is one thread.
void watchInputs(std::function<void(const std::filesystem::path&)> watcher);

// The same for every output that is in its place.
void watchOutputs(std::function<void(const std::filesystem::path&)> watcher);

// Called when writing begins and when the file is in its place; OutputFile does it. Errors of the first: as planOutput,
// for a file that was not planned; ErrorKind::usage where it was written before.
Status beginOutput(const std::filesystem::path& file);
void endOutput(const std::filesystem::path& file);

// The first refusal. Readers wrap errors in their own words, or read on without a file: the caller asks here what was
// the matter.
std::optional<Error> refusal();

} // namespace cotan
