// The readers of load.hpp, image_file.hpp and image_rows.hpp, each in a child process: limits.sandbox.program.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "cotan/asset/image_rows.hpp"
#include "cotan/asset/load.hpp"

namespace cotan {

Result<Scene> loadSandboxed(const std::filesystem::path& file, const LoadLimits& limits);
Result<Image> decodeSandboxed(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);
Result<std::unique_ptr<RowReader>> openRowsSandboxed(const std::filesystem::path& file, const LoadLimits& limits);

} // namespace cotan
