// Loading within --memory, and opening --device.
#pragma once

#include <filesystem>
#include <memory>

#include "common.hpp"
#include "cotan/convention.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "picture_options.hpp"

namespace cotan::app {

// Replaces library names in an error by options: "options.maxDistance: ..." becomes "--max-distance: ...", and exceeded
// memory limits mention --memory.
Error withOptionNames(const Error& error);

// Loads a scene or image with at most `memory` MiB per image. Errors: as loadScene and readImage, with option names.
Result<Scene> loadSceneWithin(const LoadLimits& limits, const std::filesystem::path& file);
Result<Scene> loadSceneWithin(int memory, const std::filesystem::path& file, Pixels pixels = Pixels::all);
Result<Image> readImageWithin(int memory, const std::filesystem::path& file);

// loadSceneWithin with a progress line.
Result<Scene> loadWithProgress(const CommonOptions& common, const LoadLimits& limits, const std::string& file);

// Prints a renderer's note as a warning.
Result<std::unique_ptr<Renderer>> warnOfNote(Result<std::unique_ptr<Renderer>> renderer, const CommonOptions& common);

// Opens a device by openRenderer. If "auto" falls back to the reference renderer, prints a warning with the reason.
// Errors: those of openRenderer.
Result<std::unique_ptr<Renderer>> openDevice(const std::string& device, const CommonOptions& common);

} // namespace cotan::app
