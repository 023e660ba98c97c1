#include "image/format_table.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "files/bytes.hpp"

namespace cotan {

const ImageFormat* imageFormatOf(const std::filesystem::path& file)
{
    const std::string ending = lowerExtension(file);
    const auto found = std::ranges::find_if(kImageFormats, [&](const ImageFormat& f) {
        return !ending.empty() && std::ranges::find(f.endings, ending) != f.endings.end();
    });
    return found == kImageFormats.end() ? nullptr : &*found;
}

const ImageFormat* imageFormatOf(std::span<const std::byte> bytes)
{
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
    const auto start = std::ranges::find_if(kImageStarts, [&](const ImageStart& s) {
        return head.starts_with(s.before) && head.size() >= s.at && head.substr(s.at).starts_with(s.bytes);
    });
    if (start == kImageStarts.end())
        return nullptr;
    return &*std::ranges::find(kImageFormats, start->format, &ImageFormat::name);
}

Status checkImageName(const std::filesystem::path& file)
{
    if (imageFormatHas(file, &ImageFormat::writes))
        return Done{};
    return usageError(fmt::format("{}: expected the extension {}, found \"{}\"", file.string(),
                                  imageEndings(&ImageFormat::writes, " ", " or "), file.extension().string()));
}

std::string imageEndings(const std::function<bool(const ImageFormat&)>& wanted, std::string_view between,
                         std::string_view last)
{
    std::vector<std::string_view> endings;
    for (const ImageFormat& format : kImageFormats)
        if (wanted(format))
            endings.push_back(format.endings[0]);
    std::string text;
    for (std::size_t i = 0; i < endings.size(); ++i) {
        if (i > 0)
            text += i + 1 == endings.size() && !last.empty() ? last : between;
        text += endings[i];
    }
    return text;
}

std::string readableFormatNames()
{
    std::string names;
    for (const ImageFormat& format : kImageFormats)
        if (format.reads)
            names.append(names.empty() ? "" : ", ").append(format.name);
    return names;
}

} // namespace cotan
