// Reports of cotan.h as text.
#pragma once

#include "call.hpp"
#include "files/report/json.hpp"

namespace cotan::c {

// format: of files/report/json.hpp.
inline void giveText(std::string_view format, const Json& json, cotan_bytes** to)
{
    if (to)
        giveText(std::string_view(toText(versioned(format, json))), to);
}

} // namespace cotan::c
