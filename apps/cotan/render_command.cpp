#include "commands.hpp"

#include <map>
#include <memory>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/geometry.hpp"
#include "parse.hpp"
#include "picture.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

struct RenderCommandOptions {
    CommonOptions common;
    PictureOptions picture;
    std::string frame = "cotangent";
    std::string show = "shaded";
};

const std::map<std::string, Output> kShows = {
    {"shaded", Output::shaded}, {"normal", Output::normal}, {"tangent", Output::tangent},
    {"bitangent", Output::bitangent}, {"uv", Output::uv}, {"depth", Output::depth},
    {"error", Output::normal},
};

bool keepsFloats(const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    return extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff";
}

// A float picture as colours that a PNG can show.
Image asColor(const std::string& show, const Image& image)
{
    if (show == "uv")
        return uvAsColor(image);
    if (show == "depth")
        return depthAsColor(image);
    return directionsAsColor(image);
}

// Angles between the normals of this frame and those of exact per-triangle gradients.
Result<Image> drawError(Painter& painter, View view, bool mapped, const RenderCommandOptions& o, nlohmann::ordered_json& report)
{
    auto normals = painter.draw(view);
    if (!normals)
        return normals;
    view.frame = Frame::exact;
    auto exact = painter.draw(view);
    if (!exact)
        return exact;
    auto degrees = anglesBetween(*normals, *exact);
    if (!mapped)
        degrees.assign(degrees.size(), -1.0f); // no frame has a part in these normals
    const AngleStatistics s = angleStatistics(degrees);
    report["error_against_exact"] = toJson(s);
    say(o.common, fmt::format("{} against exact: {}", o.frame, toText(s)));
    return heatMap(degrees, view.width, view.height);
}

Result<Image> drawPicture(Painter& painter, View view, bool mapped, const RenderCommandOptions& o, nlohmann::ordered_json& report)
{
    if (o.show == "error")
        return drawError(painter, view, mapped, o, report);
    view.linearOutput = o.show == "shaded" && keepsFloats(o.common.output);
    auto image = painter.draw(view);
    if (image && o.show != "shaded" && !keepsFloats(o.common.output))
        return asColor(o.show, *image);
    return image;
}

Status run(const RenderCommandOptions& o)
{
    Stopwatch total;
    if (o.common.output.empty())
        return usageError("render: expected -o FILE; found none");
    const auto frame = parseFrame(o.frame);
    if (!frame)
        return frame.error();
    if (Status fits = checkLighting(o.picture, *frame); !fits)
        return fits;
    if (Status planned = planOutputs(o.common, {{"-o", o.common.output}}); !planned)
        return planned;
    auto picture = openPicture(o.picture, o.common, {*frame, Frame::exact});
    if (!picture)
        return picture.error();
    picture->view.frame = *frame;
    picture->view.output = kShows.at(o.show);

    Stopwatch watch;
    auto painter = openPicturePainter(o.picture, o.common, *picture);
    if (!painter)
        return painter.error();
    const double openSeconds = watch.lap() - (*painter)->uploadSeconds();
    nlohmann::ordered_json report = {{"command", "render"}};
    auto progress = std::make_unique<Progress>(o.common, o.show == "error" ? 2 : 1, "drawing");
    (*painter)->progress = progress->within();
    auto image = drawPicture(**painter, picture->view, drawsNormalMaps(picture->scene) && picture->view.normalMaps, o, report);
    if (!image)
        return image.error();
    progress.reset();
    const double drawSeconds = watch.lap();
    if (Status written = writeImage(o.common.output, *image); !written)
        return written;
    const double writeSeconds = watch.lap();

    report.update(describeScene(o.picture, *picture));
    report["frame"] = o.frame;
    report["view"] = o.show;
    report["shading"] = o.picture.shading;
    report["device"] = (*painter)->device();
    report["output"] = o.common.output.string();
    report["seconds"] = {{"load", picture->loadSeconds}, {"open_device", openSeconds},
                         {"upload", (*painter)->uploadSeconds()}, {"draw", drawSeconds},
                         {"write", writeSeconds}, {"total", total.lap()}};
    say(o.common, fmt::format("{}: {}x{}, {} triangles, frame {}, on {}", o.common.output.string(),
                              picture->view.width, picture->view.height,
                              report["triangles_drawn"].get<std::size_t>(), o.frame, (*painter)->device()));
    return writeReport(o.common, report);
}

} // namespace

Command addRenderCommand(CLI::App& app)
{
    auto options = std::make_shared<RenderCommandOptions>();
    CLI::App* command = app.add_subcommand("render", "draw a model, or the built-in scene, to a picture");
    addCommonOptions(*command, options->common, "picture to write: .png, .jpg, .tga (8 bit); .exr, .tif, .hdr keep floats");
    addPictureOptions(*command, options->picture);
    command->add_option("--frame", options->frame, "frame to apply normal maps with: " + frameNames())
        ->type_name("NAME")->capture_default_str();
    command->add_option("--view", options->show,
                        "shaded, normal, tangent, bitangent, uv, depth, or error: degrees from the frame exact")
        ->check(CLI::IsMember({"shaded", "normal", "tangent", "bitangent", "uv", "depth", "error"}))
        ->type_name("NAME")->capture_default_str();
    addExamples(*command, {"cotan render model.glb -o picture.png --frame cotangent --view normal",
                           "cotan render --size 640x360 -o scene.png"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
