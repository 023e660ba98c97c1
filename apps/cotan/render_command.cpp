#include "commands.hpp"

#include <map>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/geometry.hpp"
#include "cotan/verify/frames.hpp"
#include "parse.hpp"
#include "picture.hpp"

namespace cotan::app {

namespace {

struct RenderCommandOptions : CommonOptions {
    PictureOptions picture;
    std::string frame = "cotangent";
    std::string show = "shaded";
};

const std::map<std::string, Output> kShows = {
    {"shaded", Output::shaded},       {"normal", Output::normal}, {"tangent", Output::tangent},
    {"bitangent", Output::bitangent}, {"uv", Output::uv},         {"depth", Output::depth},
    {"error", Output::normal},
};

bool keepsFloats(const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    return extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff";
}

Result<Image> drawPicture(Painter& painter, const Picture& picture, const RenderCommandOptions& o, Json& report)
{
    View view = picture.view;
    if (o.show == "error") {
        auto error = errorAgainstExact(painter, picture.scene, view);
        if (!error)
            return error.error();
        report["error_against_exact"] = toJson(error->degrees);
        say(o, "{} against exact: {}", o.frame, toText(error->degrees));
        return std::move(error->difference);
    }
    view.linearOutput = o.show == "shaded" && keepsFloats(o.output);
    auto image = painter.draw(view);
    if (image && o.show != "shaded" && !keepsFloats(o.output))
        return asColor(view.output, *image);
    return image;
}

Status run(const RenderCommandOptions& o)
{
    Stopwatch total;
    if (o.output.empty())
        return usageError("render: expected -o FILE; found none");
    const auto frame = parseFrame(o.frame);
    if (!frame)
        return frame.error();
    if (Status fits = checkLighting(o.picture, *frame); !fits)
        return fits;
    if (Status planned = planOutputs(o, {{"-o", o.output}}); !planned)
        return planned;
    auto picture = openPicture(o.picture, o, {*frame, Frame::exact});
    if (!picture)
        return picture.error();
    picture->view.frame = *frame;
    picture->view.output = kShows.at(o.show);

    Stopwatch watch;
    auto painter = openPicturePainter(o.picture, o, *picture);
    if (!painter)
        return painter.error();
    const double openSeconds = watch.lap() - (*painter)->uploadSeconds();
    Json report = {{"command", "render"}};
    const auto image = withProgress(o, o.show == "error" ? 2 : 1, "drawing", [&](Progress progress) {
        (*painter)->progress = std::move(progress);
        return drawPicture(**painter, *picture, o, report);
    });
    if (!image)
        return image.error();
    const double drawSeconds = watch.lap();
    if (Status written = writeImage(o.output, *image); !written)
        return written;
    const double writeSeconds = watch.lap();

    report.update(describeScene(o.picture, *picture));
    report["frame"] = o.frame;
    report["view"] = o.show;
    report["shading"] = o.picture.shading;
    report["device"] = (*painter)->device();
    report["output"] = o.output.string();
    report["seconds"] = {
        {"load", picture->loadSeconds}, {"open_device", openSeconds}, {"upload", (*painter)->uploadSeconds()},
        {"draw", drawSeconds},          {"write", writeSeconds},      {"total", total.lap()}};
    say(o, "{}: {}x{}, {} triangles, frame {}, on {}", o.output.string(), picture->view.width, picture->view.height,
        trianglesDrawn(picture->scene), o.frame, (*painter)->device());
    return writeReport(o, report);
}

void declare(Arguments& a, RenderCommandOptions& o)
{
    addPictureOptions(a, o.picture);
    a.option("--frame", o.frame, "frame to apply normal maps with: " + frameNames()).in("NAME");
    a.option("--view", o.show, "shaded, normal, tangent, bitangent, uv, depth, or error: degrees from the frame exact")
        .from({"shaded", "normal", "tangent", "bitangent", "uv", "depth", "error"})
        .in("NAME");
}

} // namespace

void addRenderCommand(Arguments& tool)
{
    addCommand<RenderCommandOptions>(tool,
                                     {"render",
                                      "draw a model, or the built-in scene, to a picture",
                                      "picture to write: .png, .jpg, .tga (8 bit); .exr, .tif, .hdr keep floats",
                                      {"cotan render model.glb -o picture.png --frame cotangent --view normal",
                                       "cotan render --size 640x360 -o scene.png"}},
                                     declare, run);
}

} // namespace cotan::app
