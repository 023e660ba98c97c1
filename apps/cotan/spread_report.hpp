// A Spread in texts and reports.
#pragma once

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cotan/lint/spread.hpp"

namespace cotan::app {

// "mean / 95 % / maximum".
inline std::string toText(const Spread& s) { return fmt::format("{:.2f} / {:.2f} / {:.2f}", s.mean, s.percentile95, s.maximum); }

inline nlohmann::ordered_json toJson(const Spread& s)
{
    return {{"mean", s.mean}, {"percentile95", s.percentile95}, {"maximum", s.maximum}};
}

} // namespace cotan::app
