#include "files/system/program.hpp"

namespace cotan {

namespace fs = std::filesystem;

std::vector<std::string> beginProgram(int argc, char** argv) { return {argv, argv + argc}; }

std::string becomeProgram(const fs::path&) { return "it is not in the npm package; the native tool has it"; }

fs::path programFile() { return {}; }

// Empty, so that untrusted files are read in this process: WebAssembly confines it.
fs::path sameProgram() { return {}; }

} // namespace cotan
