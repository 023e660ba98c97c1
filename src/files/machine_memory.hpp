// The memory of this machine.
#pragma once

#include <unistd.h>

namespace cotan {

// In bytes; 0: unknown.
inline double machineMemory()
{
#ifdef _SC_PHYS_PAGES
    const double pages = double(::sysconf(_SC_PHYS_PAGES)), bytes = double(::sysconf(_SC_PAGESIZE));
    return pages > 0 && bytes > 0 ? pages * bytes : 0;
#else
    return 0;
#endif
}

} // namespace cotan
