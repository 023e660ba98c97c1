#include "truth/measurement.hpp"

#include <algorithm>
#include <cmath>

namespace cotan {

void AngleCollector::add(double degrees)
{
    if (std::isfinite(degrees))
        angles_.add(degrees);
    else
        ++invalid_;
}

Measurement AngleCollector::finish(Measurement row)
{
    row.samples = angles_.count() + invalid_;
    row.invalid = row.samples == 0 ? 0 : double(invalid_) / double(row.samples);
    if (angles_.count() > 0) {
        row.mean = angles_.mean();
        row.percentile95 = angles_.percentile(0.95);
        row.maximum = angles_.maximum();
    }
    return row;
}

bool AccuracySelection::wants(Frame frame) const
{
    return frames.empty() || std::find(frames.begin(), frames.end(), frame) != frames.end();
}

} // namespace cotan
