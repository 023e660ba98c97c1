// Reports of cotan.h as text.
#pragma once

#include "call.hpp"
#include "cotan/report/json.hpp"

namespace cotan::c {

inline void giveText(const Json& json, cotan_bytes** to)
{
    if (to)
        giveText(std::string_view(toText(json)), to);
}

} // namespace cotan::c
