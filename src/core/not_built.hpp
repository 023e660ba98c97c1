// What is said where this build of the library lacks something.
#pragma once

#include <string>

#include "cotan/result.hpp"

namespace cotan {

// "not built with Embree: install libembree-dev and build Cotan again". packages: what Debian 12 calls them.
inline Error notBuiltWith(const std::string& library, const std::string& packages)
{
    return unavailableError("not built with " + library + ": install " + packages + " and build Cotan again");
}

} // namespace cotan
