// Parses the output of GoogleTest programs.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace cotan::bench {

struct TestOutcome {
    std::string name;
    std::string result;    // passed, skipped or failed; a test that did not end has failed
    std::size_t cases = 0; // number of printed lines such as | name | language | 1.2e-04 |
    double worst = 0;      // maximum of these lines, degrees
    std::string worstCase;
};

std::vector<TestOutcome> readTestLog(std::istream& log);

} // namespace cotan::bench
