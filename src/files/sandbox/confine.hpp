// The child's side of a sandboxed reader: what it may take and do. Linux.
#pragma once

#include <csignal>
#include <cstdint>

#include "files/sandbox/request.hpp"

namespace cotan {

// The address and thread sanitizers reserve terabytes and bring threads and signal handlers of their own.
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

// Ends this process by `signal` when `parent`, or the thread of it that started us, ends.
void dieWith(std::int64_t parent, int signal = SIGKILL);

// No core file, whoever would write it; other processes cannot look into this one.
void leaveNoCore();

// Limits a resource of this process, such as RLIMIT_DATA, to `now`, which may be raised to `most`; no limit is raised.
void setLimit(int what, std::uint64_t now, std::uint64_t most);

// Stack, core files, files written: fixed for good. Where the kernel can, also: no change to any file, no new process,
// no program, no signal to others, no socket.
void confine();

// Sets the limits on memory and processor time; they can be raised, never above `most`. With sanitizers memory has no
// limit, time is twenty times as long, and no call is forbidden.
void limitTo(const ReaderBudget& budget, const ReaderBudget& most);

} // namespace cotan
