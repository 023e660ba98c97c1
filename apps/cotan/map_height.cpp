#include "map_height.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace cotan::app {

Result<std::pair<double, double>> parseMetres(const std::string& text, int texelsX, int texelsY)
{
    // from_chars, as strtod reads "0x1" as one number.
    double width = 0, height = 0;
    const char* const last = text.data() + text.size();
    const char* end = std::from_chars(text.data(), last, width).ptr;
    height = width * texelsY / texelsX;
    if (end != last && *end == 'x')
        end = std::from_chars(end + 1, last, height).ptr;
    if (end != last || !(width > 0) || !(height > 0) || !std::isfinite(width * height))
        return usageError(fmt::format("--metres: expected metres as W or WxH, each over 0; found '{}'", text));
    return std::pair(width, height);
}

std::optional<maps::Kernel> kernelFromName(const std::string& name)
{
    using enum maps::Kernel;
    for (const auto& [word, kernel] : {std::pair("spectral", spectral), {"forward", forward}, {"central", central},
                                       {"sobel", sobel}, {"scharr", scharr}})
        if (name == word)
            return kernel;
    return std::nullopt;
}

} // namespace cotan::app
