#include "picture_options.hpp"

#include <fmt/format.h>

#include "core/real_number.hpp"
#include "model/model_formats.hpp"
#include "picture/option_table.hpp"

namespace cotan::app {

std::string usefulFrameNames()
{
    std::string names;
    for (const FrameInfo& f : frames())
        if (f.total)
            names += (names.empty() ? "" : ", ") + std::string(f.name);
    return names;
}

std::string listOfFrames()
{
    std::string useful = "For use; no input gives NaN:\n",
                historical = "Historical forms, to compare with; some input gives NaN:\n";
    for (const FrameInfo& f : frames())
        (f.total ? useful : historical) += fmt::format("  {:<18}{}\n", f.name, f.summary);
    return useful + "\n" + historical;
}

void addListOfFrames(Arguments& a)
{
    a.group(HelpGroup::frame);
    a.answers("--list-frames", "list all frames with a line on each, historical ones too, and exit", listOfFrames);
}

namespace {

// Gives the declared option the facts of the table, but for its name, default and help.
void describe(Argument argument, const PictureOption& option)
{
    argument.under(option.group);
    if (option.flag)
        return;
    argument.in(option.unit);
    if (option.closed)
        argument.from(option.words);
    else
        argument.offers(option.words);
    if (option.check && !option.closed)
        argument.checked(option.check);
    if (option.range)
        argument.shows(textOfReal(option.range->minimum), textOfReal(option.range->maximum));
    if (option.reads)
        argument.reads();
}

void add(Arguments& a, PictureOptions& o, const PictureOption& option)
{
    const auto set = [&o, &option](const std::string& word) -> Status {
        option.set(o, word);
        return Done{};
    };
    const std::string name = "--" + option.name;
    describe(option.flag ? a.flag(name, o.*option.flag, option.help) : a.option(name, option.word(o), set, option.help),
             option);
}

// An option of the table for a variable of another command.
template<class Value> void addLike(Arguments& a, const char* name, Value& value)
{
    const PictureOption& option = *findPictureOption(name);
    describe(a.option("--" + option.name, value, option.help), option);
}

} // namespace

void addMemoryOption(Arguments& a, int& memory, const std::string& also)
{
    describe(a.option("--memory", memory, memoryHelp(also)), *findPictureOption("memory"));
}

void addUpOption(Arguments& a, Up& up, const std::string& what)
{
    a.choice("--up", up, kUps, upHelp(what)).under(HelpGroup::input);
}

void addHighUpOption(Arguments& a, std::optional<Up>& up)
{
    a.choice("--high-up", up, kUps, "up axis of the high mesh only, where it differs: y or z").under(HelpGroup::input);
}

void addTangentsOption(Arguments& a, TangentOrigin& tangents, const std::string& help)
{
    a.choice("--tangents", tangents, kTangentOrigins, help).under(HelpGroup::frame);
}

void addDeviceOption(Arguments& a, std::string& device, const std::string& use)
{
    describe(a.option("--device", device, deviceHelp(use)), *findPictureOption("device"));
}

void addOwnNormalMap(Arguments& a, OwnMaps& maps)
{
    addLike(a, "normal-map", maps.normal);
    addLike(a, "convention", maps.convention);
    addLike(a, "material", maps.material);
}

void addMaxDegreesOption(Arguments& a, double& degrees) { addLike(a, "max-degrees", degrees); }

void addFrameOption(Arguments& a, std::string& frame)
{
    std::vector<std::string> names = frameWords();
    names.insert(names.begin(), std::string(kAutoFrame));
    a.option(
         "--frame", frame,
         "frame to apply normal maps with: auto (for each part of a model the one that it names for its map, else the "
         "cheapest within --max-degrees, or its tangents; cotangent for shapes and repeated images), "
             + usefulFrameNames() + ", or a historical one of --list-frames")
        .in("NAME")
        .offers(names)
        .main();
    addListOfFrames(a);
}

void addShowOption(Arguments& a, PictureOptions& o)
{
    for (const char* name : {"view", "mask"})
        add(a, o, *findPictureOption(name));
}

void addPictureOptions(Arguments& a, PictureOptions& o)
{
    a.group(HelpGroup::input);
    a.option("MODEL", o.model, modelFormats() + " file; the built-in scene if left out").reads();
    for (const PictureOption& option : pictureOptions())
        if (option.name != "view" && option.name != "mask")
            add(a, o, option);
    for (const auto& [removed, why] : removedPictureOptions()) {
        const std::string name = fmt::format("--{}", removed);
        a.option(
             name, "", [](const std::string&) { return Status(Done{}); }, "")
            .unlisted()
            .refused([name, reason = why] { return fmt::format("unknown option {}: {}", name, reason); });
    }
}

} // namespace cotan::app
