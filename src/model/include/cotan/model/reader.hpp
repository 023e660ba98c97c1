// The child's side of reading in a process of its own: see cotan/files/sandbox.hpp.
#pragma once

namespace cotan {

// Whether this process was started to read for another one.
bool isReaderProcess(int argc, const char* const* argv);

// Reads what the parent asks for, and answers. Returns the exit code where there is no parent; else it does not return.
int runReaderProcess();

} // namespace cotan
