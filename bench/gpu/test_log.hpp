// What GoogleTest programs printed.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace cotan::bench {

struct TestOutcome {
    std::string name;
    std::string result;    // passed, skipped or failed; failed too where it began and did not end
    std::size_t cases = 0; // lines like | name | language | 1.2e-04 | that it printed
    double worst = 0;      // degrees, of those
    std::string worstCase;
};

std::vector<TestOutcome> readTestLog(std::istream& log);

} // namespace cotan::bench
