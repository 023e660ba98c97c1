// The readers of cotan/model.hpp in a child process: limits.sandbox.program.
#pragma once

#include <filesystem>

#include "cotan/files.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

Result<Scene> loadSandboxed(const std::filesystem::path& file, const LoadLimits& limits);

} // namespace cotan
