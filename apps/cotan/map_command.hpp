// The subcommands of `cotan map`, a file for each group.
#pragma once

#include "common.hpp"

namespace cotan::app {

Command addMapInfo(CLI::App& map);
Command addMapDetect(CLI::App& map);
Command addMapConvert(CLI::App& map);
Command addMapDiff(CLI::App& map);
Command addMapFromHeight(CLI::App& map);
Command addMapToHeight(CLI::App& map);
Command addMapBlend(CLI::App& map);
Command addMapMips(CLI::App& map);

// Runs work with at most `threads` threads (0: all cores).
Status withThreads(int threads, const std::function<Status()>& work);

} // namespace cotan::app
