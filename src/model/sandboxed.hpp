// The readers of cotan/model/load.hpp in a child process: limits.sandbox.program.
#pragma once

#include <filesystem>

#include "cotan/files/limits.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

Result<Scene> loadSandboxed(const std::filesystem::path& file, const LoadLimits& limits);

} // namespace cotan
