// What the parts ask of the operating system, beyond C++: system_posix.cpp, or system_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <sys/types.h>

namespace cotan {

// Opens a file as fopen does; child processes do not inherit it. Returns null, with errno set, on failure.
std::FILE* openStream(const std::filesystem::path& file, const char* mode);

// Writes some of the bytes, past the stream's buffer. Returns how many; -1, with errno set, on failure. EINTR: nothing
// was written, ask again.
std::ptrdiff_t writeSome(std::FILE* file, const void* bytes, std::size_t size);

// Whether an errno says that the disk, or the user's part of it, is full.
bool meansFull(int number);

// Whether this process may write the file, or create files in the folder. errno is set if not.
bool mayWrite(const std::filesystem::path& file);

// The device and number of a file or folder, which identify it independently of its name.
using FileNumber = std::pair<std::uint64_t, std::uint64_t>;
enum class FileKind { missing, file, special }; // file: or a folder. special: a pipe or a device
FileKind fileNumber(const std::filesystem::path& file, FileNumber& number);

// Whether the name itself leads to an open file or a device: /dev/stdout.
bool isNameOfDevice(const std::filesystem::path& file);

// Whether this is Windows, with its names of devices and its shell. Also true of WebAssembly that Node.js runs there.
bool onWindows();

pid_t thisProcess();
bool isRunning(pid_t process); // on this machine

// Identifies the numbers of processes: a machine, or a container on it.
std::string machineName();

// The operating system and the kind of processor: "Debian GNU/Linux 12 (bookworm), x86_64", "Windows 10.0.19045,
// x86_64".
std::string systemName();

// Memory in bytes; 0: unknown.
double machineMemory();
double peakMemory(); // the most that this process had

} // namespace cotan
