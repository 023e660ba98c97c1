// The figures of `cotan accuracy` as text, CSV and JSON, and what has become worse between two lists.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/result.hpp"
#include "files/report/json.hpp"
#include "truth/measurement.hpp"

namespace cotan {

// One line a measurement under a line of column names; RFC 4180 quoting; four significant digits.
std::string toCsv(const std::vector<Measurement>& rows);

// Reads what toCsv wrote. `name` is for messages.
// Errors (ErrorKind::input): another header, a line with another number of fields, a field that is
// not a number where one is expected.
Result<std::vector<Measurement>> measurementsFromCsv(std::string_view text, const std::string& name);

// The same from a file of up to 64 MiB. Errors (ErrorKind::input): also one that cannot be read.
Result<std::vector<Measurement>> readMeasurements(const std::filesystem::path& file);

// Figures of rows without a finite result are null.
Json toJson(const std::vector<Measurement>& rows);

// Markdown tables, one for each table, scene, truth and arithmetic; frames downwards, settings
// across, in each cell "mean / 95 % / max" in degrees and the share that was not finite.
std::string toText(const std::vector<Measurement>& rows);

// A row that has become worse.
struct Worsening {
    Measurement before, now;
    std::string what; // "mean 0.47 -> 0.61"
};

// Compares rows of the same table, scene, setting, frame, truth and arithmetic; rows that only one
// list has are skipped. Worse means: the mean has grown by more than 2 % and by more than rounding
// differs between compilers (1e-9 degrees for double, 1e-5 for float, 1e-3 for half), or by more than
// 10 % and 0.02 degrees for rows that a device measured; or more results than before are not
// finite (by over 0.2 % of the samples). `compared` receives the number of common rows.
std::vector<Worsening> worsenings(const std::vector<Measurement>& before, const std::vector<Measurement>& now,
                                  std::size_t& compared);

} // namespace cotan
