// The results of `cotan accuracy`, and the tables that produce them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/value_statistics.hpp"
#include "cotan/frame.hpp"
#include "cotan/result.hpp"

namespace cotan {

// Error of a frame in one setting, as degrees between unit normals.
struct Measurement {
    std::string table;      // "flat", "curved", ...
    std::string scene;      // the subject: "stretch 2:1", "sphere"
    std::string setting;    // the circumstances: "orthographic 60", "32 regular"
    std::string frame;      // a name of cotan::frames(), or a stand-in in brackets: "(no map)"
    std::string truth;      // "S" scale invariant, "E" metric, or another reference
    std::string arithmetic; // "double", "float", "half", "vulkan", ...
    std::size_t samples = 0;
    double mean = 0; // mean, percentile95 and maximum are those of valid results; 0 if none is valid
    double percentile95 = 0;
    double maximum = 0;
    double invalid = 0; // fraction in [0,1] of results that are not finite
};

// Collects angles one by one. Values that are not finite count as invalid.
class AngleCollector {
public:
    void add(double degrees);
    // Returns the statistics with the names of `row`.
    Measurement finish(Measurement row);

private:
    ValueStatistics angles_;
    std::size_t invalid_ = 0;
};

// What to measure. The random samples do not depend on the selection, so a row has the same results whether it is
// measured alone or with all others.
struct AccuracySelection {
    std::vector<Frame> frames; // empty: all that are meaningful in a table
    std::string scene;         // empty: all; otherwise only this Measurement::scene
    bool wants(Frame frame) const;
    bool wantsScene(std::string_view name) const { return scene.empty() || scene == name; }
};

struct AccuracyTable {
    std::string_view name;
    std::string_view summary; // one line
    std::vector<Measurement> (*measure)(const AccuracySelection& selection);
};

// All tables that need no GPU, in the order of the documentation.
const std::vector<AccuracyTable>& accuracyTables();

// Measures tables in parallel on `threads` threads (0: all cores). The rows are in the order of the tables. Errors:
// ErrorKind::stopped, between two tables.
Result<std::vector<Measurement>> measureTables(const std::vector<const AccuracyTable*>& tables,
                                               const AccuracySelection& selection, int threads = 0,
                                               const Progress& progress = {});

} // namespace cotan
