// `cotan map info` and `detect`: nothing is changed.
#include <algorithm>

#include <fmt/format.h>

#include "cotan/map_files/inspect.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

struct InspectOptions : MapOptions {
    std::string file;
};

const char* name(maps::Centre c)
{
    return c == maps::Centre::exact ? "exact" : c == maps::Centre::biased ? "biased" : "unknown";
}

const char* name(maps::Transfer t)
{
    return t == maps::Transfer::srgb ? "srgb" : t == maps::Transfer::linearised ? "linearised" : "linear";
}

const char* name(maps::Swizzle s)
{
    return s == maps::Swizzle::rg ? "rg" : s == maps::Swizzle::greyAlpha ? "grey-alpha" : "alpha-green";
}

std::string centreText(const maps::NormalStatistics& s)
{
    if (s.centre == maps::Centre::exact)
        return fmt::format("128 is zero (exact expansion): lengths err by {:.4f}, with 127.5 by {:.4f}",
                           s.rmsExact, s.rmsBiased);
    if (s.centre == maps::Centre::biased)
        return fmt::format("127.5 is zero (biased expansion, 2c-1): lengths err by {:.4f}, with 128 by {:.4f}",
                           s.rmsBiased, s.rmsExact);
    return "128 or 127.5: cannot be told from the lengths";
}

std::string transferText(maps::Transfer t)
{
    return t == maps::Transfer::srgb
        ? "the values went through the sRGB curve, as if they were colours: lengths are right only after undoing it"
        : "the sRGB curve was undone on values that never had it: flat is near 55 instead of 128";
}

// Whether any texel has a direction: else means and shares are of nothing.
bool measured(const maps::NormalStatistics& s)
{
    return std::any_of(s.tilt.begin(), s.tilt.end(), [](double share) { return share > 0; });
}

void sayInfo(const InspectOptions& o, const maps::SurveyedFile& image)
{
    const maps::NormalStatistics& s = image.statistics;
    const auto line = [&](const std::string& text) { say(o, text); };
    line(fmt::format("{}: {} x {}, {}", o.file, image.width, image.height, maps::bitsName(image.type)));
    line("contents: " + maps::describe(s.content));
    if (s.background > 0)
        line(fmt::format("background (alpha 0, black, white, or fields of a colour that is no normal): {:.2f} %; left out below",
                         s.background * 100));
    if (s.swizzle != maps::Swizzle::rg)
        line(s.swizzle == maps::Swizzle::greyAlpha ? "channels: two (x as grey, y as alpha)"
                                                   : "channels: two (x in alpha, y in green)");
    if (s.content == maps::Content::tangentSpace || s.content == maps::Content::objectSpace)
        line("centre: " + centreText(s));
    if (s.transfer != maps::Transfer::linear)
        line("warning: " + transferText(s.transfer));
    if (s.content == maps::Content::grey)
        return;
    line(fmt::format("invalid (not finite, or no length): {:.2f} %; below the horizon: {:.2f} %; x^2+y^2 over 1: {:.2f} %",
                     s.invalid * 100, s.belowHorizon * 100, s.outsideDisc * 100));
    if (!measured(s)) {
        line("no direction is left to measure");
        return;
    }
    line(fmt::format("length: mean {:.4f}, spread {:.4f}; under 0.9: {:.2f} %", s.meanLength, s.lengthSpread,
                     s.shortened * 100));
    std::string tilt;
    for (std::size_t i = 0; i < s.tilt.size(); ++i)
        tilt += fmt::format("  {}{} {:.1f} %", i * 10, i == 8 ? "+" : "", s.tilt[i] * 100);
    line(fmt::format("tilt from flat: mean {:.2f} degrees; share from", s.meanTilt) + tilt);
    line(fmt::format("mean direction: {:.4f} {:.4f} {:.4f}", s.mean[0], s.mean[1], s.mean[2]));
}

Json toJson(const InspectOptions& o, const maps::SurveyedFile& image)
{
    const maps::NormalStatistics& s = image.statistics;
    Json j = {{"command", "map info"}, {"file", o.file}, {"width", image.width}, {"height", image.height},
            {"bits", maps::bitsName(image.type)}, {"contents", maps::describe(s.content)},
            {"channels", name(s.swizzle)}, {"centre", name(s.centre)}, {"transfer", name(s.transfer)},
            {"signed", s.signedStored}, {"mean_length", s.meanLength}, {"length_spread", s.lengthSpread},
            {"shortened", s.shortened}, {"background", s.background}, {"invalid", s.invalid}, {"below_horizon", s.belowHorizon},
            {"outside_disc", s.outsideDisc}, {"mean", s.mean}, {"lowest", s.lowest}, {"highest", s.highest},
            {"mean_tilt_degrees", s.meanTilt}, {"tilt_by_10_degrees", s.tilt}};
    if (!measured(s)) // figures of nothing
        for (const char* figure : {"mean_length", "length_spread", "shortened", "mean", "mean_tilt_degrees", "tilt_by_10_degrees"})
            j[figure] = nullptr;
    return j;
}

Status runInfo(const InspectOptions& o)
{
    if (Status planned = planOutputs(o, {}); !planned)
        return planned;
    const auto image = onFiles(o, o.file, [&](const maps::FileOptions& files) { return maps::surveyFile(o.file, files); });
    if (!image)
        return image.error();
    sayInfo(o, *image);
    return writeReport(o, toJson(o, *image));
}

std::string verdictText(const maps::GreenVerdict& v)
{
    if (v.green == maps::Green::undecidable)
        return "green: undecidable; " + v.reason;
    const bool up = v.green == maps::Green::up;
    std::string text = fmt::format("green: {} ({}), {}", up ? "up" : "down",
                                   up ? "+Y, OpenGL, glTF" : "-Y, Direct3D", name(v.confidence));
    if (v.swapped == maps::Swapped::yes)
        text += "; red and green are exchanged (the answer is for the map with them put right)";
    if (v.swapped == maps::Swapped::undecidable)
        text += "; whether red and green are exchanged cannot be told from this relief";
    return text;
}

Status runDetect(const InspectOptions& o)
{
    if (Status planned = planOutputs(o, {}); !planned)
        return planned;
    const auto found = onFiles(o, o.file, [&](const maps::FileOptions& files) { return maps::greenOfFile(o.file, files); });
    if (!found)
        return found.error();
    const maps::GreenVerdict& v = found->verdict;
    say(o, verdictText(v));
    if (v.sampled < 1)
        say(o, fmt::format("judged by {} patches of 128 x 128 texels, spread evenly: {:.2g} % of the picture",
                                      found->patches, 100 * v.sampled));
    if (v.used > 0)
        say(o, fmt::format("agreement {:+.2f} ({:.0f} times its uncertainty; exchanged {:+.2f}); the other way "
                                      "leaves {:.3g} times as much unexplained; {:.0f} % of the picture votes so",
                                      v.agreement, v.deviations, v.exchanged, v.residualRatio, v.votes * 100));
    if (v.green != maps::Green::undecidable)
        say(o, "bump or dent cannot be told from a normal map: this takes red to point right, as every convention does");
    return writeReport(o,
                       {{"command", "map detect"}, {"file", o.file}, {"green", name(v.green)},
                        {"confidence", name(v.confidence)}, {"exchanged", name(v.swapped)}, {"reason", v.reason},
                        {"contents", maps::describe(v.statistics.content)}, {"background", v.statistics.background}, {"agreement", v.agreement},
                        {"agreement_exchanged", v.exchanged}, {"deviations", v.deviations},
                        {"residual_ratio", v.residualRatio}, {"votes", v.votes}, {"used", v.used}, {"sampled", v.sampled},
                        {"bump_or_dent", "cannot be told"}});
}

void declare(Arguments& a, InspectOptions& o)
{
    addMemoryOption(a, o.memory);
    a.option("FILE", o.file, "the map").required();
}

} // namespace

void addMapInfo(Arguments& map)
{
    addCommand<InspectOptions>(map, {"info", "what a map is: lengths, tilt, centre, channels, what is wrong", "",
                     {"cotan map info rocks.png", "cotan map info rocks.png --json rocks.json"}},
               declare, runInfo);
}

void addMapDetect(Arguments& map)
{
    addCommand<InspectOptions>(map, {"detect", "which way green points, and how sure that is", "",
                     {"cotan map detect rocks.png", "cotan map detect rocks.png --json rocks.json"}},
               declare, runDetect);
}

} // namespace cotan::app
