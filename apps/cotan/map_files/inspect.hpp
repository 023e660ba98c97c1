// Properties of map files, and the angles between two maps.
#pragma once

#include <string>
#include <vector>

#include "cotan/maps.hpp"
#include "files/json.hpp"
#include "inspect/angles.hpp"
#include "map_files/map_file.hpp"

namespace cotan::app {

struct SurveyedFile {
    int width = 0, height = 0;
    PixelType type = PixelType::unorm8;
    maps::NormalStatistics statistics;
    std::string frame = {}; // as Image::frame
    int channels = 4;       // as Image::channels
};

// Reads a file once or twice and collects its statistics. Errors: as openRows; ErrorKind::stopped.
Result<SurveyedFile> surveyFile(const std::filesystem::path& map, const FileOptions& files = {});

// The survey as sentences and for a report; file: its name.
std::vector<std::string> linesOf(const SurveyedFile& survey, const std::string& file);
Json toJson(const SurveyedFile& survey);

struct GreenOfFile {
    maps::GreenVerdict verdict;
    std::size_t patches = 0; // evaluated patches
};

// Determines the direction of green, after undoing the damage. Errors: as openRows; ErrorKind::stopped.
Result<GreenOfFile> greenOfFile(const std::filesystem::path& map, const FileOptions& files = {},
                                const Damage& damage = {});

// The verdict as sentences and for a report; file: its name.
std::vector<std::string> linesOf(const GreenOfFile& found, const std::string& file);
Json toJson(const GreenOfFile& found);

struct ComparedFiles {
    AngleStatistics angles;              // degrees between the two, over the texels with a direction in both
    std::size_t skipped = 0;             // other texels that the mask does not leave out
    std::size_t masked = 0;              // texels that it leaves out
    Convention a{}, b{};                 // how the maps were read
    std::vector<std::string> notes = {}; // what contradicts a stated convention, one line each
};

// Compares two maps of the same size, each with its own convention. heat: an image of the angles in the colours of
// heatMap; empty: none. mask: an image of the same size, whose black texels are left out; empty: none. Errors: as
// openRows and createRows; ErrorKind::usage: "options.from: " (of a), "options.to: " (of b); ErrorKind::input:
// different sizes; ErrorKind::stopped.
Result<ComparedFiles> compareFiles(const std::filesystem::path& a, const StatedConvention& statedA,
                                   const std::filesystem::path& b, const StatedConvention& statedB,
                                   const std::filesystem::path& heat = {}, const FileOptions& files = {},
                                   const std::filesystem::path& mask = {});

} // namespace cotan::app
