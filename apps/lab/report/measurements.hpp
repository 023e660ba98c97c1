// The results of `cotan accuracy` as text, CSV and JSON, and a comparison of two lists of results.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/result.hpp"
#include "files/json.hpp"
#include "truth/measurement.hpp"

namespace cotan {

// One measurement per line after a header line; RFC 4180 quoting; four significant digits.
std::string toCsv(const std::vector<Measurement>& rows);

// Parses the output of toCsv. `name` is the file name for messages. Errors (ErrorKind::input): an unexpected header, a
// wrong number of fields in a line, or an invalid number.
Result<std::vector<Measurement>> measurementsFromCsv(std::string_view text, const std::string& name);

// Reads a file of up to 64 MiB. Errors (ErrorKind::input): those of measurementsFromCsv, or an unreadable file.
Result<std::vector<Measurement>> readMeasurements(const std::filesystem::path& file);

// Values of rows without finite results are null.
Json toJson(const std::vector<Measurement>& rows);

// Markdown tables, one for each table, scene, truth and arithmetic, with a row per frame and a column per setting. Each
// cell has "mean / 95 % / max" in degrees and the fraction of results that are not finite.
std::string toText(const std::vector<Measurement>& rows);

struct Worsening {
    Measurement before, now;
    std::string what; // "mean 0.47 -> 0.61"
};

// Compares rows with the same table, scene, setting, frame, truth and arithmetic; rows in only one list are skipped. A
// row is worse if its mean has grown by more than 2 % plus the rounding differences between compilers (1e-9 degrees for
// double, 1e-5 for float, 1e-3 for half), or by 10 % plus 0.02 degrees for rows measured on a device, or if the
// fraction of results that are not finite has grown by more than 0.002. `compared` receives the number of common rows.
std::vector<Worsening> worsenings(const std::vector<Measurement>& before, const std::vector<Measurement>& now,
                                  std::size_t& compared);

} // namespace cotan
