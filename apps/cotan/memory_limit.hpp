// --memory: how much one picture may take.
#pragma once

#include <filesystem>

#include <CLI/CLI.hpp>

#include "cotan/model/load.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan::app {

inline constexpr int kDefaultMemory = 640; // MiB

// Adds --memory MIB.
void addMemoryOption(CLI::App& command, int& memory);

// The limits of reading with so many MiB for one picture, and as much for all of a model together where that is more
// than is usual.
LoadLimits limitsFor(int memory, Pixels pixels = Pixels::all);

// An error of reading, with the option that helps where a limit of memory was met.
Error withMemoryHint(const Error& error);

// A model and a picture read within so many MiB a picture. Errors: as loadScene and readImage, with the hint.
Result<Scene> loadSceneWithin(int memory, const std::filesystem::path& file, Pixels pixels = Pixels::all);
Result<Image> readImageWithin(int memory, const std::filesystem::path& file);

} // namespace cotan::app
