// Parts of a program that are loaded when they are first needed, since what they link is large or may be missing.
#pragma once

#include <functional>

#include "cotan/result.hpp"

namespace cotan {

// Where a module may be: beside an installed program; beside the library that this code is in, or in its subfolder
// `cotan`; where it was installed, where it was built.
struct ModulePlaces {
    const char* name;      // of the file
    const char* subfolder; // of the folder above the program's
    const char* installed; // folder
    const char* built;     // folder
};

// What the entry point of a module returns: a function without arguments by the name of `entry`. The first module
// counts that `fits` says yes to; it stays loaded until the program ends. `what` begins the message.
// Errors: ErrorKind::unavailable.
Result<const void*> loadModule(const ModulePlaces& places, const char* entry,
                               const std::function<bool(const void*)>& fits, const char* what);

} // namespace cotan
