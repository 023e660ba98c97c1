// PNG files by rows, through libpng.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "files/output.hpp"

namespace cotan {

struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, Close>;

// As openRows, from the start of the file. Nothing: it cannot be read by rows.
std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, File stream,
                                                              const LoadLimits& limits);

// As createRows, for components of 8 or 16 bits. name: for messages.
Result<std::unique_ptr<RowWriter>> createPngRows(OutputFile output, const RowFormat& format, const std::string& name);

} // namespace cotan
