#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cotan/maps.hpp"
#include "map_files/inspect.hpp"
#include "terminal/shell_words.hpp"

namespace cotan::app {

using namespace maps;

namespace {

const char* name(Centre c) { return c == Centre::exact ? "exact" : c == Centre::biased ? "biased" : "unknown"; }

const char* name(Transfer t)
{
    return t == Transfer::srgb ? "srgb" : t == Transfer::linearised ? "linearised" : "linear";
}

const char* name(Swizzle s) { return s == Swizzle::rg ? "rg" : s == Swizzle::greyAlpha ? "grey-alpha" : "alpha-green"; }

std::string centreText(const NormalStatistics& s)
{
    if (s.centre == Centre::exact)
        return fmt::format("128 is zero (exact expansion): length error {:.4f}, with 127.5 {:.4f}", s.rmsExact,
                           s.rmsBiased);
    if (s.centre == Centre::biased)
        return fmt::format("127.5 is zero (biased expansion, 2c-1): length error {:.4f}, with 128 {:.4f}", s.rmsBiased,
                           s.rmsExact);
    return "128 or 127.5: undecidable from the lengths";
}

std::string fixCommand(const std::vector<Fault>& faults, const NormalStatistics& s, const std::filesystem::path& file)
{
    return fmt::format("cotan map convert {} {} -o {}", quoted(file.string()), fixOptions(faults, s),
                       quoted(file.stem().string() + "-fixed.png"));
}

Json faultsJson(const std::vector<Fault>& faults)
{
    Json list = Json::array();
    for (const Fault& fault : faults)
        list.push_back({{"kind", name(fault.kind)}, {"text", fault.text}});
    return list;
}

Json noteJson(const NormalStatistics& s)
{
    const std::string note = noteOf(s);
    return note.empty() ? Json(nullptr) : Json(note);
}

// Whether any texel has a direction; otherwise means and fractions are undefined.
bool measured(const NormalStatistics& s)
{
    return std::any_of(s.tilt.begin(), s.tilt.end(), [](double fraction) { return fraction > 0; });
}

std::string verdictText(const GreenVerdict& v)
{
    if (v.green == Green::undecidable)
        return "green: undecidable; " + v.reason;
    const bool up = v.green == Green::up;
    std::string text = fmt::format("green: {} ({}), {}", up ? "up" : "down", up ? "+Y, OpenGL, glTF" : "-Y, Direct3D",
                                   name(v.confidence));
    if (v.swapped == Swapped::yes)
        text += "; red and green are exchanged (the answer is for the map with them exchanged back)";
    if (v.swapped == Swapped::undecidable)
        text += "; this relief does not show whether red and green are exchanged";
    return text;
}

} // namespace

std::vector<std::string> linesOf(const SurveyedFile& image, const std::string& file)
{
    std::vector<std::string> lines;
    const NormalStatistics& s = image.statistics;
    const auto line = [&](std::string text) { lines.push_back(std::move(text)); };
    line(fmt::format("{}: {} x {}, {}", file, image.width, image.height, bitsName(image.type)));
    line("contents: " + describe(s.content));
    if (image.channels == 2)
        line("the file stores two channels");
    if (!image.frame.empty())
        line("made for the frame: " + image.frame);
    if (s.background > 0)
        line(fmt::format(
            "background (alpha 0, black, white, or areas of a colour that is not a normal): {:.2f} %; left out below",
            s.background * 100));
    if (s.swizzle != Swizzle::rg)
        line(s.swizzle == Swizzle::greyAlpha ? "channels: two (x as grey, y as alpha)"
                                             : "channels: two (x in alpha, y in green)");
    if (s.content == Content::tangentSpace || s.content == Content::objectSpace)
        line("centre: " + centreText(s));
    const std::vector<Fault> faults = faultsOf(s);
    for (const Fault& fault : faults)
        line("wrong: " + fault.text);
    if (!faults.empty())
        line("to fix it: " + fixCommand(faults, s, file));
    if (const std::string note = noteOf(s); !note.empty())
        line("note: " + note);
    if (s.content == Content::grey)
        return lines;
    line(fmt::format(
        "invalid (not finite, or no length): {:.2f} %; below the horizon: {:.2f} %; x^2+y^2 over 1: {:.2f} %",
        s.invalid * 100, s.belowHorizon * 100, s.outsideDisc * 100));
    if (!measured(s)) {
        line("no texel has a direction to measure");
        return lines;
    }
    line(fmt::format("length: mean {:.4f}, standard deviation {:.4f}; under 0.9: {:.2f} %", s.meanLength,
                     s.lengthDeviation, s.shortened * 100));
    std::string tilt;
    for (std::size_t i = 0; i < s.tilt.size(); ++i)
        tilt += fmt::format("  {}{} {:.1f} %", i * 10, i == 8 ? "+" : "", s.tilt[i] * 100);
    line(fmt::format("tilt from flat: mean {:.2f} degrees; fraction from", s.meanTilt) + tilt);
    line(fmt::format("mean direction: {:.4f} {:.4f} {:.4f}", s.mean[0], s.mean[1], s.mean[2]));
    return lines;
}

Json toJson(const SurveyedFile& image)
{
    const NormalStatistics& s = image.statistics;
    Json j = {{"width", image.width},
              {"height", image.height},
              {"bits", bitsName(image.type)},
              {"stored_channels", image.channels},
              {"contents", describe(s.content)},
              {"channels", name(s.swizzle)},
              {"centre", name(s.centre)},
              {"transfer", name(s.transfer)},
              {"signed", s.signedStored},
              {"mean_length", s.meanLength},
              {"length_deviation", s.lengthDeviation},
              {"shortened", s.shortened},
              {"background", s.background},
              {"invalid", s.invalid},
              {"below_horizon", s.belowHorizon},
              {"outside_disc", s.outsideDisc},
              {"mean", s.mean},
              {"lowest", s.lowest},
              {"highest", s.highest},
              {"mean_tilt_degrees", s.meanTilt},
              {"tilt_by_10_degrees", s.tilt}};
    const std::vector<Fault> faults = faultsOf(s);
    j["faults"] = faultsJson(faults);
    j["fix"] = faults.empty() ? Json(nullptr) : Json(fixOptions(faults, s));
    j["note"] = noteJson(s);
    if (!image.frame.empty())
        j["frame"] = image.frame;
    if (!measured(s)) // undefined figures
        for (const char* figure :
             {"mean_length", "length_deviation", "shortened", "mean", "mean_tilt_degrees", "tilt_by_10_degrees"})
            j[figure] = nullptr;
    return j;
}

std::vector<std::string> linesOf(const GreenOfFile& found, const std::string& file)
{
    const GreenVerdict& v = found.verdict;
    std::vector<std::string> lines;
    lines.push_back(verdictText(v));
    const std::vector<Fault> faults = faultsOf(v.statistics, &v);
    for (const Fault& fault : faults)
        lines.push_back("wrong: " + fault.text);
    if (!faults.empty())
        lines.push_back("to fix it: " + fixCommand(faults, v.statistics, file));
    if (const std::string note = noteOf(v.statistics); !note.empty())
        lines.push_back("note: " + note);
    if (v.sampled < 1)
        lines.push_back(fmt::format("judged by {} patches of 128 x 128 texels, evenly distributed: {:.2g} % of the "
                                    "image",
                                    found.patches, 100 * v.sampled));
    if (v.used > 0)
        lines.push_back(
            fmt::format("agreement {:+.2f} ({:.0f} times its uncertainty; exchanged {:+.2f}); the other way "
                        "leaves {:.3g} times as much unexplained; {:.0f} % of the image agrees",
                        v.agreement, v.deviations, v.exchanged, v.residualRatio, v.votes * 100));
    if (v.green != Green::undecidable)
        lines.push_back(
            "bumps and dents look alike in a normal map: this assumes that red points right, as every convention does");
    return lines;
}

Json toJson(const GreenOfFile& found)
{
    const GreenVerdict& v = found.verdict;
    const std::vector<Fault> faults = faultsOf(v.statistics, &v);
    return {{"green", name(v.green)},
            {"faults", faultsJson(faults)},
            {"fix", faults.empty() ? Json(nullptr) : Json(fixOptions(faults, v.statistics))},
            {"note", noteJson(v.statistics)},
            {"confidence", name(v.confidence)},
            {"exchanged", name(v.swapped)},
            {"reason", v.reason},
            {"contents", describe(v.statistics.content)},
            {"background", v.statistics.background},
            {"agreement", v.agreement},
            {"agreement_exchanged", v.exchanged},
            {"deviations", v.deviations},
            {"residual_ratio", v.residualRatio},
            {"votes", v.votes},
            {"used", v.used},
            {"sampled", v.sampled},
            {"bump_or_dent", "cannot be told"}};
}

} // namespace cotan::app
