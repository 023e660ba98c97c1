#include "map_options.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "cotan/asset/image_file.hpp"
#include "cotan/maps/texels.hpp"

namespace cotan::app {

namespace {

std::string extensionOf(const std::filesystem::path& file)
{
    std::string e = file.extension().string();
    std::ranges::transform(e, e.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return e;
}

struct Word {
    const char* name;
    void (*apply)(Convention&);
};

constexpr Word kWords[] = {
    {"green-up", [](Convention& c) { c.greenUp = true; }},
    {"green-down", [](Convention& c) { c.greenUp = false; }},
    {"exact", [](Convention& c) { c.expansion = Expansion::exact; }},
    {"biased", [](Convention& c) { c.expansion = Expansion::biased; }},
    {"signed", [](Convention& c) { c.expansion = Expansion::signedValues; }},
    {"xyz", [](Convention& c) { c.channels = Channels::xyz; }},
    {"orthographic", [](Convention& c) { c.channels = Channels::orthographic; }},
    {"stereographic", [](Convention& c) { c.channels = Channels::stereographic; }},
    {"slope", [](Convention& c) { c.channels = Channels::slope; }},
};

bool applyWord(const std::string& text, Convention& convention)
{
    const auto word = std::ranges::find_if(kWords, [&](const Word& w) { return text == w.name; });
    if (word == std::end(kWords))
        return false;
    word->apply(convention);
    return true;
}

LoadLimits limitsOf(const MapOptions& options)
{
    LoadLimits limits;
    limits.imageBytes = std::size_t(options.memory) << 20;
    limits.imageSide = 1 << 20; // the memory limit decides
    return limits;
}

} // namespace

void addMapOptions(CLI::App& command, MapOptions& options, const std::string& outputHelp)
{
    addCommonOptions(command, options.common, outputHelp);
    command.add_option("--memory", options.memory, "MiB that one decoded picture may take")
        ->check(CLI::Range(1, 1 << 16))->capture_default_str();
}

std::string conventionWords()
{
    std::string words;
    for (const ConventionPreset& p : conventionPresets())
        words += (words.empty() ? "" : " ") + std::string(p.name);
    words += "; then, after commas,";
    for (const Word& w : kWords)
        words += std::string(" ") + w.name;
    return words;
}

Result<Convention> parseConvention(const std::string& text, const std::string& option)
{
    Convention convention;
    std::stringstream words(text);
    std::string word;
    for (bool first = true; std::getline(words, word, ','); first = false) {
        const auto preset = first ? conventionFromName(word) : std::nullopt;
        if (preset)
            convention = *preset;
        else if (!applyWord(word, convention))
            return usageError(fmt::format("{}: expected {}; found '{}'", option, conventionWords(), word));
    }
    if (text.empty())
        return usageError(fmt::format("{}: expected {}; found nothing", option, conventionWords()));
    return convention;
}

Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options)
{
    auto image = readImage(file, limitsOf(options));
    if (!image && image.error().message.find("the limit is") != std::string::npos)
        return Error{image.error().kind, image.error().message + " (--memory raises it)"};
    return image;
}

Result<Image> openMap(const std::filesystem::path& file, const MapOptions& options,
                      const Convention& convention)
{
    auto image = openMap(file, options);
    if (image && convention.channels != Channels::xyz)
        maps::unswizzle(*image, maps::swizzleOf(*image));
    return image;
}

std::string bitsName(PixelType type)
{
    return type == PixelType::unorm8 ? "8 bit" : type == PixelType::unorm16 ? "16 bit" : "float";
}

Result<PixelType> parseBits(const std::string& bits, PixelType input, const std::filesystem::path& file)
{
    const std::string extension = extensionOf(file);
    const bool floats = extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff";
    const bool only8 = extension == ".jpg" || extension == ".jpeg" || extension == ".tga";
    const bool onlyFloat = extension == ".exr" || extension == ".hdr";
    PixelType type = input;
    if (bits == "8")
        type = PixelType::unorm8;
    else if (bits == "16")
        type = PixelType::unorm16;
    else if (bits == "float")
        type = PixelType::float32;
    else if (bits != "auto")
        return usageError(fmt::format("--bits: expected auto, 8, 16 or float; found '{}'", bits));
    else if (onlyFloat)
        type = PixelType::float32;
    else if (only8)
        type = PixelType::unorm8;
    else if (type == PixelType::float32 && !floats)
        type = PixelType::unorm16;
    if ((type == PixelType::float32 && !floats) || (type != PixelType::float32 && onlyFloat)
        || (type != PixelType::unorm8 && only8))
        return usageError(fmt::format("--bits: {} files cannot hold {}", extension, bitsName(type)));
    return type;
}

Status needOutput(const MapOptions& options, const std::string& command)
{
    if (options.common.output.empty())
        return usageError(fmt::format("map {}: expected -o FILE; found none", command));
    return Done{};
}

} // namespace cotan::app
