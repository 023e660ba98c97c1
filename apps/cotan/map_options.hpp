// What the subcommands of `cotan map` share: maps in and out, and conventions by words.
#pragma once

#include <filesystem>
#include <string>

#include "common.hpp"
#include "cotan/asset/load.hpp"
#include "cotan/convention.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::app {

struct MapOptions {
    CommonOptions common;
    int memory = 640; // MiB, of one decoded picture
};

void addMapOptions(CLI::App& command, MapOptions& options, const std::string& outputHelp);

// A convention in words separated by commas: a preset's name, then what differs from it, such as
// "unity,xyz" or "opengl,biased". `option` is for the message.
Result<Convention> parseConvention(const std::string& text, const std::string& option);

// All words that parseConvention knows, for help texts.
std::string conventionWords();

// Reads a picture within the memory limit. Errors: as readImage.
Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options);

// The same for a map with this convention: pictures of two channels are brought to red and green.
Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options,
                      const Convention& convention);

// The type to write: "auto", "8", "16" or "float", checked against what the file's format holds.
// auto: the input's, as far as the format holds it.
Result<PixelType> parseBits(const std::string& bits, PixelType input, const std::filesystem::path& file);

// "8 bit", "16 bit" or "float".
std::string bitsName(PixelType type);

// Says what is missing when no -o was given.
Status needOutput(const MapOptions& options, const std::string& command);

} // namespace cotan::app
