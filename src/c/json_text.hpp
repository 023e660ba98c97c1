// Reports of cotan.h as text.
#pragma once

#include <span>

#include "call.hpp"
#include "cotan/report/json.hpp"

namespace cotan::c {

inline void giveText(const Json& json, cotan_bytes** to)
{
    if (!to)
        return;
    const std::string text = toText(json);
    const auto bytes = std::as_bytes(std::span(text));
    *to = new cotan_bytes{{bytes.begin(), bytes.end()}};
}

} // namespace cotan::c
