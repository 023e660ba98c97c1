// `cotan map info` and `detect`: nothing is changed.
#include "map_command.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cotan/maps/green.hpp"
#include "cotan/maps/normal_statistics.hpp"
#include "map_options.hpp"
#include "map_stream.hpp"

namespace cotan::app {

namespace {

struct InspectOptions {
    MapOptions map;
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

// A file that was read for its statistics.
struct Surveyed {
    int width = 0, height = 0;
    PixelType type = PixelType::unorm8;
    maps::NormalStatistics statistics;
};

// Calls take(strip, first row) for the whole file; with the row below each strip, if that is asked for.
template<class Take> Result<Surveyed> readThrough(const InspectOptions& o, Border border, Take take)
{
    const auto reader = openMapRows(o.file, o.map);
    if (!reader)
        return reader.error();
    RowReader& in = **reader;
    if (Status read = inOrder(o.map.common, in, border, take); !read)
        return read.error();
    return Surveyed{in.width, in.height, in.type, {}};
}

Result<Surveyed> survey(const InspectOptions& o)
{
    maps::MapSurvey found;
    auto first = readThrough(o, Border::none, [&](const Image& strip, int) { found.first(strip); });
    if (!first)
        return first.error();
    if (found.oneColour()) {
        first->statistics = found.finish();
        return first;
    }
    auto second = readThrough(o, Border::none, [&](const Image& strip, int) { found.second(strip); });
    if (second)
        second->statistics = found.finish();
    return second;
}

// Whether any texel has a direction: else means and shares are of nothing.
bool measured(const maps::NormalStatistics& s)
{
    return std::any_of(s.tilt.begin(), s.tilt.end(), [](double share) { return share > 0; });
}

void sayInfo(const InspectOptions& o, const Surveyed& image, const maps::NormalStatistics& s)
{
    const auto line = [&](const std::string& text) { say(o.map.common, text); };
    line(fmt::format("{}: {} x {}, {}", o.file, image.width, image.height, bitsName(image.type)));
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

nlohmann::ordered_json toJson(const InspectOptions& o, const Surveyed& image, const maps::NormalStatistics& s)
{
    nlohmann::ordered_json j = {{"command", "map info"}, {"file", o.file}, {"width", image.width}, {"height", image.height},
            {"bits", bitsName(image.type)}, {"contents", maps::describe(s.content)},
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
    const auto image = survey(o);
    if (!image)
        return image.error();
    const maps::NormalStatistics& s = image->statistics;
    sayInfo(o, *image, s);
    return writeReport(o.map.common, toJson(o, *image, s));
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
    const auto reader = openMapRows(o.file, o.map);
    if (!reader)
        return reader.error();
    RowReader& in = **reader;
    maps::PatchSampler sampler(in.width, in.height, in.type);
    if (Status read = inOrder(o.map.common, in, Border::none, [&](const Image& strip, int row) { sampler.add(strip, row); }); !read)
        return read.error();
    const maps::GreenVerdict v = maps::greenOf(sampler);
    say(o.map.common, verdictText(v));
    if (v.sampled < 1)
        say(o.map.common, fmt::format("judged by {} patches of 128 x 128 texels, spread evenly: {:.2g} % of the picture",
                                      sampler.patches().size(), 100 * v.sampled));
    if (v.used > 0)
        say(o.map.common, fmt::format("agreement {:+.2f} ({:.0f} times its uncertainty; exchanged {:+.2f}); the other way "
                                      "leaves {:.3g} times as much unexplained; {:.0f} % of the picture votes so",
                                      v.agreement, v.deviations, v.exchanged, v.residualRatio, v.votes * 100));
    if (v.green != maps::Green::undecidable)
        say(o.map.common, "bump or dent cannot be told from a normal map: this takes red to point right, as every convention does");
    return writeReport(o.map.common,
                       {{"command", "map detect"}, {"file", o.file}, {"green", name(v.green)},
                        {"confidence", name(v.confidence)}, {"exchanged", name(v.swapped)}, {"reason", v.reason},
                        {"contents", maps::describe(v.statistics.content)}, {"background", v.statistics.background}, {"agreement", v.agreement},
                        {"agreement_exchanged", v.exchanged}, {"deviations", v.deviations},
                        {"residual_ratio", v.residualRatio}, {"votes", v.votes}, {"used", v.used}, {"sampled", v.sampled},
                        {"bump_or_dent", "cannot be told"}});
}

template<class Run> Command inspect(CLI::App* command, std::shared_ptr<InspectOptions> options, Run run)
{
    return {command, [options, run]() -> Status {
                if (Status planned = planOutputs(options->map.common, {}); !planned)
                    return planned;
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace

Command addMapInfo(CLI::App& map)
{
    auto options = std::make_shared<InspectOptions>();
    CLI::App* command = map.add_subcommand("info", "what a map is: lengths, tilt, centre, channels, what is wrong");
    addMapOptions(*command, options->map, "");
    command->add_option("FILE", options->file, "the map")->required();
    addExamples(*command, {"cotan map info rocks.png", "cotan map info rocks.png --json rocks.json"});
    return inspect(command, options, runInfo);
}

Command addMapDetect(CLI::App& map)
{
    auto options = std::make_shared<InspectOptions>();
    CLI::App* command = map.add_subcommand("detect", "which way green points, and how sure that is");
    addMapOptions(*command, options->map, "");
    command->add_option("FILE", options->file, "the map")->required();
    addExamples(*command, {"cotan map detect rocks.png", "cotan map detect rocks.png --json rocks.json"});
    return inspect(command, options, runDetect);
}

} // namespace cotan::app
