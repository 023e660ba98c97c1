#include "picture/option_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/parse_number.hpp"

namespace cotan {

std::string sizeWord(const PictureSize& size) { return fmt::format("{}x{}", size.width, size.height); }

std::string expectedSize(const std::vector<std::string>& presets, const std::string& found)
{
    return fmt::format("expected WxH, or one number for both, each from 1 to 16384{}{}; found '{}'",
                       presets.empty() ? "" : ", or ", fmt::join(presets, ", "), found);
}

Result<PictureSize> parseSize(const std::string& text)
{
    const std::string_view all = text, first = all.substr(0, all.find('x'));
    const std::string_view second = first.size() < all.size() ? all.substr(first.size() + 1) : first;
    PictureSize size;
    if (parseNumber(first, size.width) && parseNumber(second, size.height) && size.fits())
        return size;
    return usageError("--size: " + expectedSize({}, text));
}

namespace {

constexpr Named<PictureSize> kSizePresets[] = {{"thumbnail", {320, 180}}, {"720p", {1280, 720}},
                                               {"1080p", {1920, 1080}},   {"1440p", {2560, 1440}},
                                               {"2160p", {3840, 2160}},   {"square", {1024, 1024}}};

} // namespace

std::vector<std::string> sizePresetWords() { return wordsOf(kSizePresets); }

std::optional<PictureSize> parsePictureSize(const std::string& text)
{
    if (const auto preset = valueOf(kSizePresets, text))
        return *preset;
    const auto size = parseSize(text);
    return size ? std::optional(*size) : std::nullopt;
}

std::vector<std::string> frameWords()
{
    std::vector<std::string> names;
    for (const FrameInfo& f : frames())
        names.emplace_back(f.name);
    return names;
}

std::string frameNames() { return fmt::format("{}", fmt::join(frameWords(), ", ")); }

Result<FrameChoice> parseFrameChoice(const std::string& text, std::string_view field)
{
    if (text == kAutoFrame)
        return FrameChoice();
    if (const auto frame = frameFromName(text))
        return FrameChoice(*frame);
    return usageError(fmt::format("{}: expected {} or one of {}; found '{}'", field, kAutoFrame, frameNames(), text));
}

} // namespace cotan
