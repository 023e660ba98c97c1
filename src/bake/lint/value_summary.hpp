// A set of values in short, as reports of lint and convert say it.
#pragma once

#include "core/value_statistics.hpp"
#include "cotan/lint.hpp"

namespace cotan {

// Takes it by value, because a percentile sorts.
inline ValueSummary summaryOf(ValueStatistics values)
{
    return {values.count(), values.mean(), values.percentile(0.95), values.maximum()};
}

} // namespace cotan
