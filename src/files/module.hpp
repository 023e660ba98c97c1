// Loads parts of the program on demand, because their dependencies are large or may be missing.
#pragma once

#include <functional>

#include "cotan/result.hpp"

namespace cotan {

// Where a module is searched: relative to the installed program; beside this library or in its subfolder `cotan`; where
// it was installed; where it was built.
struct ModuleLocations {
    const char* name;      // file name
    const char* subfolder; // subfolder of the parent of the program's folder
    const char* installed; // folder
    const char* built;     // folder
};

// Returns what the module's entry point returns: a function named `entry` without arguments. Uses the first module
// whose result `fits` accepts; the module stays loaded until the program ends. `what` begins the error message.
// Errors: ErrorKind::unavailable.
Result<const void*> loadModule(const ModuleLocations& locations, const char* entry,
                               const std::function<bool(const void*)>& fits, const char* what);

} // namespace cotan
