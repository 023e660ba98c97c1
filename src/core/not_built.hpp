// The error for features that this build of the library lacks.
#pragma once

#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Returns "not built with Embree: install libembree-dev and build Cotan again". packages: their names in Debian 12.
inline Error notBuiltWith(const std::string& library, const std::string& packages)
{
    return unavailableError("not built with " + library + ": install " + packages + " and build Cotan again");
}

} // namespace cotan
