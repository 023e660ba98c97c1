// What the subcommands of `cotan map` share: maps in and out, and conventions by words.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common.hpp"
#include "cotan/convention_words.hpp"
#include "cotan/image/rows.hpp"
#include "cotan/model/load.hpp"
#include "cotan/convention.hpp"
#include "cotan/maps/texels.hpp"
#include "cotan/scene/scene.hpp"
#include "memory_limit.hpp"

namespace cotan::app {

struct MapOptions {
    CommonOptions common;
    int memory = kDefaultMemory; // of one picture that is decoded whole
};

void addMapOptions(CLI::App& command, MapOptions& options, const std::string& outputHelp);

// conventionFromWords with the option in front of its message.
Result<Convention> parseConvention(const std::string& text, const std::string& option);

// Reads a picture within the memory limit. Errors: as readImage.
Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options);

// The same for a map with this convention: pictures of two channels are brought to red and green.
Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options,
                      const Convention& convention);

// The same by rows. Pictures whose format cannot be read by rows are decoded within the memory limit.
Result<std::unique_ptr<RowReader>> openMapRows(const std::filesystem::path& file, const MapOptions& options);

// Which components of a file hold a two-channel map; rg where the convention has three channels. Reads files
// that have alpha once through.
Result<maps::Swizzle> swizzleOfFile(const std::filesystem::path& file, const MapOptions& options,
                                    const Convention& convention);

// How components are stored.
struct Bits {
    PixelType type = PixelType::unorm8;
    bool half = false; // float32 here, half floats in the file
};

// The type to write: "auto", "8", "16", "half" or "float", checked against what the file's format holds.
// auto: the input's, as far as the format holds it.
Result<Bits> parseBits(const std::string& bits, PixelType input, const std::filesystem::path& file);

// "8 bit", "16 bit", "half" or "float".
std::string bitsName(PixelType type);
std::string bitsName(const Bits& bits);

// Signed values need floats, in a file that holds negative ones.
Status checkSigned(const Convention& to, const Bits& bits, const std::filesystem::path& file);

// Writes a whole picture.
Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits);

// For the commands that write a map: -o has to be given, and what is written is planned: `file`, the one that -o names
// if empty.
Status needOutput(const MapOptions& options, const std::string& command, const std::filesystem::path& file = {});

} // namespace cotan::app
