// Confines the child process of a sandboxed reader: confine_linux.cpp, confine_windows.cpp.
#pragma once

#include <cstdint>

#include "files/sandbox/request.hpp"

namespace cotan {

// The address and thread sanitizers reserve terabytes, and have threads and signal handlers of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define COTAN_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define COTAN_SANITIZED true
#endif
#endif
#ifndef COTAN_SANITIZED
#define COTAN_SANITIZED false
#endif
inline constexpr bool kSanitized = COTAN_SANITIZED;

// Makes the kernel send this process `signal` when `parent`, or the thread of it that started us, ends.
void dieWith(std::int64_t parent, int signal = 9 /*SIGKILL*/);

// Disables core files, including those piped to a program, and prevents other processes from attaching to this one.
// Windows: a crash opens no window.
void leaveNoCore();

// Sets the soft and hard limits of a resource of this process, such as RLIMIT_DATA. Never raises the hard limit.
void setLimit(int resource, std::uint64_t soft, std::uint64_t hard);

// Limits the stack and forbids core files and file writes for good. Where the kernel supports it, also forbids changes
// to the file system, new processes, programs, signals to others, and sockets.
void confine();

// Limits memory and processor time to `budget`; may be raised later up to `maximum`. With sanitizers memory is
// unlimited, times are 20 times as long, and no system call is forbidden.
void limitTo(const ReaderBudget& budget, const ReaderBudget& maximum);

} // namespace cotan
