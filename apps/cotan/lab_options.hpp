// Options of `cotan accuracy`, `figures` and `cost`. The tool declares these commands for its help, completion and
// `cotan batch`; the program cotan-lab runs them (apps/lab).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common.hpp"

namespace cotan::app {

struct AccuracyCommandOptions : CommonOptions {
    std::string tables, frames, scene, csv;
    std::string device = "auto";
    std::filesystem::path against;
    bool list = false;
};

inline constexpr const char* kFigureSize = "480x360";

struct FiguresCommandOptions : CommonOptions {
    std::string size = kFigureSize;
    std::string device = "auto";
    std::string only;
};

struct CostCommandOptions : CommonOptions {
    std::vector<std::string> frames;
    std::vector<std::string> devices;
    std::vector<std::string> families;
    bool noTiming = false;
    bool timeCpuDevices = false;
    int repeats = 15;
    std::string csv;
    std::string name;
    std::string cards;
    std::string writeCards;
};

// Each adds a command that calls `run`.
void addAccuracyCommand(Arguments& tool, Status (*run)(const AccuracyCommandOptions&));
void addFiguresCommand(Arguments& tool, Status (*run)(const FiguresCommandOptions&));
void addCostCommand(Arguments& tool, Status (*run)(const CostCommandOptions&));

// The values of --tables, --only and --frames, in the order of the help.
std::vector<std::string> accuracyTableNames();
std::vector<std::string> figureOptionNames();
std::vector<std::string> costRowNames();

} // namespace cotan::app
