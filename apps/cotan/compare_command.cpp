#include "commands.hpp"

#include <array>
#include <set>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "cotan/inspect.hpp"
#include "inspect/angles.hpp"
#include "map_files/placed_images.hpp"
#include "parse.hpp"
#include "picture.hpp"
#include "scene/normal_maps.hpp"
#include "scene/parts.hpp"

namespace cotan::app {

namespace {

struct CompareCommandOptions : CommonOptions {
    PictureOptions picture;
    std::string frames = "auto,mikktspace";
};

Result<std::array<FrameChoice, 2>> parsePair(const std::string& text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos)
        return usageError(fmt::format("--frames: expected two names A,B; found '{}'", text));
    const auto a = parseFrameChoice(text.substr(0, comma), "--frames");
    const auto b = parseFrameChoice(text.substr(comma + 1), "--frames");
    for (const auto* frame : {&a, &b})
        if (!*frame)
            return frame->error();
    return std::array{*a, *b};
}

// All possible file names, since `auto` may become any frame.
std::vector<std::string> comparedFiles(const std::array<FrameChoice, 2>& pair)
{
    std::set<std::string> names = {"difference.png", std::string(kAutoFrame) + ".png"};
    for (const FrameChoice& choice : pair)
        for (const FrameInfo& frame : cotan::frames())
            if (!choice || *choice == frame.frame)
                names.insert(std::string(frame.name) + ".png");
    return {names.begin(), names.end()};
}

Status run(const CompareCommandOptions& o)
{
    if (o.output.empty())
        return usageError("compare needs -o FOLDER");
    COTAN_TRY(pair, parsePair(o.frames));
    // Before the model is read, so that none of its files is replaced.
    COTAN_CHECK(beginOutputs(o, plannedIn("-o", o.output, comparedFiles(*pair))));
    COTAN_TRY(picture, loadPicture(o.picture, o, {(*pair)[0], (*pair)[1]}));
    COTAN_CHECK(limitCoverage(picture->scene, picture->view, 2));
    const std::array<std::optional<Frame>, 2> frames = {picture->frames[0], picture->frames[1]};
    const std::string a = nameOf(frames[0]), b = nameOf(frames[1]);
    for (const std::optional<Frame>& frame : frames)
        if (const std::string note = frameNote(picture->scene, frame); !note.empty())
            warn(o, note);
    COTAN_TRY(renderer, makePictureRenderer(o.picture, o, *picture));
    Stopwatch watch;
    const std::size_t pictures = kComparedFramesImages + (o.picture.edges != Edges::none ? 2 : 0);
    COTAN_TRY(compared, drawWithProgress(o, **renderer, pictures, "drawing", [&]() -> Result<ComparedFrames> {
                  auto drawn = compareFrames(**renderer, picture->scene, picture->view, frames);
                  if (drawn)
                      for (Image& image : drawn->shaded)
                          COTAN_CHECK(layEdges(**renderer, picture->view, o.picture, picture->edges, image));
                  return drawn;
              }));
    const double drawSeconds = watch.lap();

    COTAN_CHECK(makeFolder(o.output));
    std::vector<PlacedImage> files{{o.output / (a + ".png"), &compared->shaded[0]},
                                   {o.output / "difference.png", &compared->difference}};
    if (b != a)
        files.push_back({o.output / (b + ".png"), &compared->shaded[1]});
    COTAN_CHECK(writeTogether(files));

    Json report = {{"command", "compare"}};
    report.update(describeScene(o.picture, *picture));
    report["frames"] = {a, b};
    report["device"] = (*renderer)->device();
    report["normals"] = toJson(compared->normals);
    report["tangents_opposed"] = compared->tangentsOpposed;
    report["bitangents_opposed"] = compared->bitangentsOpposed;
    report["verdict"] = compared->verdict;
    report["seconds"] = {{"load", picture->loadSeconds}, {"draw", drawSeconds}, {"write", watch.lap()}};
    say(o, "{} against {}, {} pixels: {}", a, b, compared->normals.count, toText(*compared));
    say(o, compared->verdict);
    say(o,
        "images in {}: {}.png, {}.png, difference.png (black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees)",
        o.output.string(), a, b);
    return writeReport(o, report);
}

void declare(Arguments& a, CompareCommandOptions& o)
{
    addPictureOptions(a, o.picture);
    a.option("--frames", o.frames,
             "the two frames: auto, " + usefulFrameNames() + ", or historical ones of --list-frames")
        .in("A,B")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
}

} // namespace

void addCompareCommand(Arguments& tool)
{
    addCommand<CompareCommandOptions>(
        tool,
        {"compare",
         "Draw a model with two frames and measure the difference in degrees.",
         "folder for both images and the heat map",
         {"cotan compare model.glb -o difference",
          "cotan compare model.glb --frames orthonormal,mikktspace --size 480x360 -o difference"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
