// Removes unfinished files when a signal ends the program.
#pragma once

#include <cstddef>
#include <filesystem>

namespace cotan {

// Makes SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGXCPU remove the unfinished files of all OutputFiles and then end the
// program by that signal, so that a shell sees the cause. Ignored signals (nohup) stay ignored. A closed pipe and a
// file over the shell's limit become write errors. For programs: a library installs no handlers. May be called again.
void removePartsOnInterrupt();

// Delays these signals while an object exists, for steps that belong together. Any number may exist, on any thread.
class InterruptsHeld {
public:
    InterruptsHeld();
    ~InterruptsHeld();
    InterruptsHeld(const InterruptsHeld&) = delete;
    InterruptsHeld& operator=(const InterruptsHeld&) = delete;
};

// A file that a signal removes while the object exists: at most kMaxParts, with names of up to 4095 bytes.
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

// Blocks forever if a signal on another thread is ending the program: its unfinished files are already removed, and an
// error message about that would only mislead.
void blockWhileEnding();

} // namespace cotan
