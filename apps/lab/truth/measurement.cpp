#include "truth/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cotan {

void AngleCollector::add(double degrees)
{
    if (std::isfinite(degrees))
        angles_.push_back(degrees);
    else
        ++invalid_;
}

Measurement AngleCollector::finish(Measurement row)
{
    std::sort(angles_.begin(), angles_.end());
    row.samples = angles_.size() + invalid_;
    row.invalid = row.samples == 0 ? 0 : double(invalid_) / double(row.samples);
    if (!angles_.empty()) {
        row.mean = std::accumulate(angles_.begin(), angles_.end(), 0.0) / double(angles_.size());
        row.percentile95 = angles_[std::size_t(0.95 * double(angles_.size() - 1))];
        row.maximum = angles_.back();
    }
    return row;
}

bool AccuracySelection::wants(Frame frame) const
{
    return frames.empty() || std::find(frames.begin(), frames.end(), frame) != frames.end();
}

} // namespace cotan
