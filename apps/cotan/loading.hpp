// What is read within --memory, and drawn by --device.
#pragma once

#include <filesystem>
#include <memory>

#include "common.hpp"
#include "cotan/convention.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "picture_options.hpp"

namespace cotan::app {

// An error of a part in words of the command line: "options.maxDistance: ..." is "--max-distance: ...", and --memory is
// named where a limit of memory was met.
Error withOptionNames(const Error& error);

// A model and a picture read within so many MiB a picture. Errors: as loadScene and readImage, in words.
Result<Scene> loadSceneWithin(const LoadLimits& limits, const std::filesystem::path& file);
Result<Scene> loadSceneWithin(int memory, const std::filesystem::path& file, Pixels pixels = Pixels::all);
Result<Image> readImageWithin(int memory, const std::filesystem::path& file);

// loadSceneWithin under a line of progress.
Result<Scene> loadWithProgress(const CommonOptions& common, const LoadLimits& limits, const std::string& file);

// Warns of a renderer's note.
Result<std::unique_ptr<Renderer>> warnOfNote(Result<std::unique_ptr<Renderer>> renderer, const CommonOptions& common);

// Opens the device of that name, as openRenderer does; where "auto" falls back to the reference renderer, a warning
// says why. Errors: those of openRenderer.
Result<std::unique_ptr<Renderer>> openDevice(const std::string& device, const CommonOptions& common,
                                             bool validation = false);

} // namespace cotan::app
