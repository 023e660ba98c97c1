#include "test_log.hpp"

#include <regex>

namespace cotan::bench {

std::vector<TestOutcome> readTestLog(std::istream& log)
{
    static const std::regex run(R"(\[ RUN      \] (\S+).*)"), end(R"(\[ +(OK|SKIPPED|FAILED) +\] (\S+) \(\d+ ms\).*)"),
        degrees(R"(\| ([^|]*\S) +\| [^|]* \| ([0-9.]+e[+-]\d+) \|.*)");
    std::vector<TestOutcome> all;
    std::smatch found;
    for (std::string line; std::getline(log, line);) {
        if (std::regex_match(line, found, run)) {
            all.push_back({found[1], "failed", 0, 0, {}});
        } else if (!all.empty() && std::regex_match(line, found, end)) {
            all.back().result = found[1] == "OK" ? "passed" : found[1] == "SKIPPED" ? "skipped" : "failed";
        } else if (!all.empty() && std::regex_match(line, found, degrees)) {
            TestOutcome& test = all.back();
            ++test.cases;
            const double d = std::stod(found[2]);
            if (!(d <= test.worst)) {
                test.worst = d;
                test.worstCase = found[1];
            }
        }
    }
    return all;
}

} // namespace cotan::bench
