// Reading in a child process, so that a file that makes a third-party reader crash, hang or take all memory costs that
// process and not ours. The child is a program of the caller's that begins as follows (cotan/model/reader.hpp),
//
//     int main(int argc, char** argv)
//     {
//         if (cotan::isReaderProcess(argc, argv))
//             return cotan::runReaderProcess();
//
// most simply the caller itself: /proc/self/exe; or that calls runReaderProcess by the word of its own arguments. Where
// LoadLimits::sandbox names it, everything that takes LoadLimits reads models other than glTF, and pictures other than
// PNG and JPEG, through such a child.
//
// What holds, on Linux: the child has the limits below, no descriptors of ours but one socket, and no core file. It
// dies with the thread that started it. What it answers is checked, all of it, before it is used. Where the kernel
// offers Landlock and seccomp it can neither change files nor start programs, signal others or open connections. What
// is not promised: it may read every file that the caller may read, and what it reads may end up in the answer.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace cotan {

struct Sandbox {
    std::filesystem::path program;        // empty: everything is read in this process
    std::vector<std::string> arguments{}; // that it is given before the reader's own
    // MiB of memory; 0: 640 (LoadLimits::imageBytes if more), 16 a processor, more for large files, up to 8 GiB or
    // twice that.
    std::size_t megabytes = 0;
    // Seconds of processor; 0: 4, and more likewise, up to an hour. On the wall it may be fifteen times as long.
    double seconds = 0;
};

// What LoadLimits::sandbox is where nobody sets it; at first, reading in this process. Set it in main(), while there is
// one thread: what a program does not trust, it does not trust anywhere.
void sandboxByDefault(Sandbox sandbox);
Sandbox defaultSandbox();

} // namespace cotan
