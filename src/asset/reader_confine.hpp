// The child's side of a sandboxed reader: what it may take and do. Linux.
#pragma once

#include <cstdint>

#include "reader_request.hpp"

namespace cotan {

// Ends this process when `parent`, or the thread of it that started us, ends.
void dieWith(std::int64_t parent);

// Stack, core files, files written: fixed for good. Where the kernel can, also: no change to any file, no new process,
// no program, no signal to others, no socket.
void confine();

// Sets the limits on memory and processor time; they can be raised, never above `most`. Under the address and thread
// sanitizers, which reserve terabytes, memory has no limit and time is twenty times as long.
void limitTo(const ReaderBudget& budget, const ReaderBudget& most);

} // namespace cotan
