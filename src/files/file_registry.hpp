// Registry of the files that this process reads and writes, so that no input is overwritten and no two outputs are the
// same file. It is off until a program turns it on: the command line does; users of the library may read and write as
// they like.
//
//     guardInputs(/*overwrite*/ false);
//     planOutput("-o", "a.png");      // before work: fails if -o is the same file as another output or an input
//     readImage("./a.png");           // fails: -o would replace it
//     writeImage("b.png", image);     // fails if b.png was read or written before
//
// Files are identified across names: links, "..", symbolic links of folders. Pipes and devices are not registered.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Starts an empty registry. overwrite: inputs may be replaced, and only announced outputs have to differ. again: a
// finished output may be written again, as in a session of the window, unless it was read meanwhile.
void guardInputs(bool overwrite, bool again = false);

// Announces an output, which messages call `option`. Errors: ErrorKind::usage if it was read, or is already planned,
// which overwrite does not allow either.
Status planOutput(const std::string& option, const std::filesystem::path& file);

// The same check of an output that another process will write. Registers nothing.
Status checkOutput(const std::string& option, const std::filesystem::path& file);

// Every reader calls this before it opens a file. Errors: ErrorKind::usage if an output that is planned or being
// written would replace the file. Finished outputs may be read.
Status noteInput(const std::filesystem::path& file);

// Sets a function that is called with every input, even while the registry is off: a reader process uses it to report
// inputs to its parent. Set it while there is only one thread.
void watchInputs(std::function<void(const std::filesystem::path&)> watcher);

// Likewise for every output once it is complete.
void watchOutputs(std::function<void(const std::filesystem::path&)> watcher);

// Called by OutputFile when writing begins, before the file appears, and when it is complete. Errors of beginOutput: as
// planOutput for a file that was not planned; ErrorKind::usage if it was written before. Errors of mayAppear:
// ErrorKind::usage if a reader asked for the file meanwhile and was refused.
Status beginOutput(const std::filesystem::path& file);
Status mayAppear(const std::filesystem::path& file);
void endOutput(const std::filesystem::path& file);

// The first read or output that was refused, if any. Readers may replace its error message or continue without the
// file; callers get the original here.
std::optional<Error> firstRefusal();

} // namespace cotan
