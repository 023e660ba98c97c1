// The error for features that this build of the library lacks.
#pragma once

#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Returns "not built with Embree: install libembree-dev and build Cotan again". packages: their names in Debian 12.
// The builds for Windows and for npm come as they are.
inline Error notBuiltWith(const std::string& library, [[maybe_unused]] const std::string& packages)
{
#ifdef _WIN32
    return unavailableError("not in this build for Windows: " + library);
#elif defined(COTAN_NPM_TOOL)
    return unavailableError("not in the npm package: " + library + "; the native tool has it");
#else
    return unavailableError("not built with " + library + ": install " + packages + " and build Cotan again");
#endif
}

} // namespace cotan
