// Ctrl-C and its kin remove what is half written.
#pragma once

#include <cstddef>
#include <filesystem>

namespace cotan {

// SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGXCPU remove the unfinished files of all OutputFiles and then end the program
// as they would have done anyway, so that a shell sees why. A signal that is ignored (nohup) stays so. For programs;
// a library installs no handlers. A closed pipe and a file over the shell's limit become errors of writing. May be
// called again.
void removePartsOnInterrupt();

// While one lives, such signals wait: for steps that belong together. Any number may live at a time, on any thread.
class InterruptsHeld {
public:
    InterruptsHeld();
    ~InterruptsHeld();
    InterruptsHeld(const InterruptsHeld&) = delete;
    InterruptsHeld& operator=(const InterruptsHeld&) = delete;
};

// A file that a signal has to remove; up to kMaxParts at a time and with names of up to 4095 bytes, others are left
// alone. The name counts for as long as this lives.
inline constexpr std::size_t kMaxParts = 1024;
class GuardedPart {
public:
    explicit GuardedPart(const std::filesystem::path& file);
    GuardedPart(GuardedPart&& other) noexcept;
    GuardedPart& operator=(GuardedPart&&) = delete;
    ~GuardedPart();

private:
    int slot_; // -1: none
};

// Does not return where a signal on another thread is about to end the program: its parts are gone, and what would be
// said of that is not the user's concern.
void stayWhereEnding();

} // namespace cotan
