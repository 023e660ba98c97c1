// A Spread in texts and reports.
#pragma once

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cotan/lint/spread.hpp"

namespace cotan::app {

// "mean / 95 % / maximum"; "nothing to measure" for an empty set.
inline std::string toText(const Spread& s)
{
    return s.count > 0 ? fmt::format("{:.2f} / {:.2f} / {:.2f}", s.mean, s.percentile95, s.maximum) : "nothing to measure";
}

// The figures of an empty set are null when it is written.
inline nlohmann::ordered_json toJson(const Spread& s)
{
    return {{"count", s.count}, {"mean", s.mean}, {"percentile95", s.percentile95}, {"maximum", s.maximum}};
}

} // namespace cotan::app
