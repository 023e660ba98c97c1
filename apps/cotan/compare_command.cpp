#include "commands.hpp"

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/geometry.hpp"
#include "parse.hpp"
#include "picture.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

struct CompareCommandOptions {
    CommonOptions common;
    PictureOptions picture;
    std::string frames = "cotangent,mikktspace";
};

Result<std::array<Frame, 2>> parsePair(const std::string& text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos)
        return usageError(fmt::format("--frames: expected two names A,B; found '{}'", text));
    const auto a = parseFrame(text.substr(0, comma));
    const auto b = parseFrame(text.substr(comma + 1));
    for (const auto* frame : {&a, &b})
        if (!*frame)
            return usageError("--frames: " + frame->error().message);
    return std::array{*a, *b};
}

// Everything that is compared about one frame.
struct Drawn {
    Image shaded, normal, tangent, bitangent;
};

Result<Drawn> drawAll(Painter& painter, View view, Frame frame)
{
    Drawn drawn;
    view.frame = frame;
    for (auto [output, image] : {std::pair(Output::shaded, &drawn.shaded), {Output::normal, &drawn.normal},
                                 {Output::tangent, &drawn.tangent}, {Output::bitangent, &drawn.bitangent}}) {
        view.output = output;
        auto result = painter.draw(view);
        if (!result)
            return result.error();
        *image = std::move(*result);
    }
    return drawn;
}

// What tells an inverted or turned tangent from a small difference.
std::string tangentVerdict(double tOpposed, double bOpposed)
{
    if (std::isnan(tOpposed) || std::isnan(bOpposed))
        return "no pixel has tangents of both frames: nothing was compared";
    if (tOpposed < 0.02 && bOpposed < 0.02)
        return "tangents and bitangents point the same way";
    if (tOpposed < 0.02 && bOpposed > 0.98)
        return "bitangents are reversed everywhere: TANGENT.w is inverted";
    return fmt::format("tangents are reversed on {:.1f} % and bitangents on {:.1f} % of the pixels",
                       tOpposed * 100, bOpposed * 100);
}

Status run(const CompareCommandOptions& o)
{
    if (o.common.output.empty())
        return usageError("compare: expected -o FOLDER; found none");
    const auto pair = parsePair(o.frames);
    if (!pair)
        return pair.error();
    for (Frame frame : *pair)
        if (Status fits = checkLighting(o.picture, frame); !fits)
            return fits;
    const std::string a(name((*pair)[0])), b(name((*pair)[1]));
    std::vector<std::string> names = {a + ".png", "difference.png"};
    if (a != b)
        names.push_back(b + ".png");
    if (Status planned = planOutputs(o.common, plannedIn("-o", o.common.output, names)); !planned)
        return planned;
    auto picture = openPicture(o.picture, o.common, {(*pair)[0], (*pair)[1]});
    if (!picture)
        return picture.error();
    auto painter = openPicturePainter(o.picture, o.common, *picture);
    if (!painter)
        return painter.error();
    Stopwatch watch;
    std::array<Drawn, 2> drawn;
    Progress progress(o.common, 8, "drawing"); // four pictures each
    (*painter)->progress = progress.within();
    for (std::size_t k = 0; k < 2; ++k) {
        auto d = drawAll(**painter, picture->view, (*pair)[k]);
        if (!d)
            return d.error();
        drawn[k] = std::move(*d);
    }
    const double drawSeconds = watch.lap();

    auto degrees = anglesBetween(drawn[0].normal, drawn[1].normal);
    const bool mapped = drawsNormalMaps(picture->scene) && picture->view.normalMaps;
    if (!mapped)
        degrees.assign(degrees.size(), -1.0f); // no frame has a part in these normals
    const AngleStatistics s = angleStatistics(degrees);
    const double tOpposed = shareOpposed(anglesBetween(drawn[0].tangent, drawn[1].tangent));
    const double bOpposed = shareOpposed(anglesBetween(drawn[0].bitangent, drawn[1].bitangent));
    const std::string verdict = tangentVerdict(tOpposed, bOpposed);

    if (Status made = makeFolder(o.common.output); !made)
        return made;
    const Image heat = heatMap(degrees, picture->view.width, picture->view.height);
    const std::map<std::string, const Image*> files = {
        {a + ".png", &drawn[0].shaded}, {b + ".png", &drawn[1].shaded}, {"difference.png", &heat}};
    for (const auto& [file, image] : files)
        if (Status written = writeImage(o.common.output / file, *image); !written)
            return written;

    nlohmann::ordered_json report = {{"command", "compare"}};
    report.update(describeScene(o.picture, *picture));
    report["frames"] = {a, b};
    report["device"] = (*painter)->device();
    report["normals"] = toJson(s);
    report["tangents_opposed"] = tOpposed;
    report["bitangents_opposed"] = bOpposed;
    report["verdict"] = verdict;
    report["seconds"] = {{"load", picture->loadSeconds}, {"draw", drawSeconds}, {"write", watch.lap()}};
    const std::string normals = mapped ? toText(s) : "nothing was compared: no normal map is drawn";
    say(o.common, fmt::format("{} against {}, {} pixels: {}", a, b, s.count, normals));
    say(o.common, verdict);
    say(o.common, fmt::format("pictures in {}: {}.png, {}.png, difference.png (black 0, blue 0.5, "
                              "green 2, yellow 5, red 15, white 45 degrees)", o.common.output.string(), a, b));
    return writeReport(o.common, report);
}

} // namespace

Command addCompareCommand(CLI::App& app)
{
    auto options = std::make_shared<CompareCommandOptions>();
    CLI::App* command = app.add_subcommand("compare", "draw a model with two frames and measure the difference in degrees");
    addCommonOptions(*command, options->common, "folder for both pictures and the heat map");
    addPictureOptions(*command, options->picture);
    command->add_option("--frames", options->frames, "the two frames, from: " + frameNames())
        ->type_name("A,B")->capture_default_str();
    addExamples(*command, {"cotan compare model.glb --frames cotangent,mikktspace -o difference",
                           "cotan compare model.glb --frames orthonormal,mikktspace --size 480x360 -o difference"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
