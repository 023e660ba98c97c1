// PNG where there is no libpng.
#include "codecs.hpp"
#include "core/not_built.hpp"
#include "cotan/image.hpp"

namespace cotan {

namespace {

Error noPng(const std::string& name)
{
    const Error error = notBuiltWith("libpng", "libpng-dev");
    return reworded(error, name + ": " + error.message);
}

} // namespace

Result<Image> readPng(std::span<const std::byte>, const std::string& name, const LoadLimits&) { return noPng(name); }
Status writePng(const std::filesystem::path&, const Image&, const std::string& name) { return noPng(name); }
Result<std::vector<std::byte>> encodePng(const Image& image) { return noPng(image.name); }

std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, File,
                                                              const LoadLimits&)
{
    return noPng(file.string());
}

Result<std::unique_ptr<RowWriter>> createPngRows(const std::filesystem::path&, const RowFormat&,
                                                 const std::string& name)
{
    return noPng(name);
}

} // namespace cotan
