// Writes a bumpy sphere as .glb for bench/scans: scan_model MILLION_TRIANGLES MAP_SIDE FILE.glb [tangents].
#include <cmath>
#include <cstdlib>
#include <string>

#include "scan_model.hpp"

int main(int count, char** words)
{
    if (count < 4)
        return 1;
    cotan::test::ScanOptions o;
    o.rows = int(std::lround(std::sqrt(std::atof(words[1]) * 1e6 / 4)));
    o.mapSide = std::atoi(words[2]);
    o.tangents = count > 4 && std::string(words[4]) == "tangents";
    cotan::test::writeScan(words[3], o);
    return testing::Test::HasFatalFailure() ? 1 : 0;
}
