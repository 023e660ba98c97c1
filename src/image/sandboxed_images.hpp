// The readers of file.hpp and rows.hpp, each in a child process: limits.sandbox.program.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "cotan/files.hpp"
#include "cotan/image.hpp"

namespace cotan {

Result<Image> decodeSandboxed(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);
Result<std::unique_ptr<RowReader>> openRowsSandboxed(const std::filesystem::path& file, const LoadLimits& limits);

} // namespace cotan
