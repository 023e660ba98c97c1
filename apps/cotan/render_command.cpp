#include "commands.hpp"

#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/parse_number.hpp"
#include "core/try.hpp"
#include "cotan/image.hpp"
#include "cotan/inspect.hpp"
#include "cotan/picture.hpp"
#include "image/format_table.hpp"
#include "inspect/angles.hpp"
#include "parse.hpp"
#include "picture.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"

namespace cotan::app {

namespace {

struct RenderCommandOptions : CommonOptions {
    PictureOptions picture;
    std::string frame{kAutoFrame};
    std::string frames; // "A..B"
    int turntable = 0;  // number of images of a full rotation; 0: no rotation
    double rate = 0;    // images per second; 0: the usual rate of the file
};

// One image.
struct Shot {
    std::filesystem::path file;
    double at = 0; // seconds of the animation, or degrees on the turntable
};

// What the options ask for.
struct RenderJob {
    CommonOptions common;
    PictureOptions picture;
    FrameChoice frame;
    std::vector<Shot> shots; // one or more
    double rate = 0;         // images per second of one file for all shots; 0: each has its own
};

// What was drawn. The error is that of the first image.
struct Rendered {
    Json scene;
    std::size_t triangles = 0;
    std::string frame, frames, meant, device;
    std::optional<AngleStatistics> error;
    double loadSeconds = 0, openSeconds = 0, uploadSeconds = 0, drawSeconds = 0, writeSeconds = 0, totalSeconds = 0;
};

// ---- from the options to the job -------------------------------------------------------------

constexpr double kUsualRate = 24, kUsualGifRate = 25; // GIF stores durations in hundredths of a second

double rateOf(const RenderCommandOptions& o)
{
    if (o.rate > 0)
        return o.rate;
    return animationRate(o.output, kUsualRate) == kUsualRate ? kUsualRate : kUsualGifRate;
}

constexpr int kMaxFrames = 100000;

// The image numbers of --frames or --turntable; empty without either.
Result<std::vector<int>> imageNumbers(const RenderCommandOptions& o)
{
    std::vector<int> frames;
    if (o.turntable > 0) {
        if (!o.frames.empty() || !o.json.empty())
            return usageError("--turntable: expected neither --frames nor --json with it");
        frames.resize(std::size_t(o.turntable));
        std::iota(frames.begin(), frames.end(), 0);
        return frames;
    }
    if (o.frames.empty())
        return frames;
    const std::size_t dots = o.frames.find("..");
    int first = 0, last = 0;
    const std::string_view text = o.frames;
    if (dots == std::string::npos || !parseNumber(text.substr(0, dots), first)
        || !parseNumber(text.substr(dots + 2), last) || first < 0 || last < first || last - first >= kMaxFrames)
        return usageError(fmt::format("--frames: expected A..B, numbers from 0 up, at most {} images; found '{}'",
                                      kMaxFrames, o.frames));
    if (o.picture.animation.empty() || o.picture.time > 0 || !o.json.empty())
        return usageError("--frames: expected --animation with it, and neither --time nor --json");
    frames.resize(std::size_t(last - first + 1));
    std::iota(frames.begin(), frames.end(), first);
    return frames;
}

// out.png with number 7: out-0007.png.
std::filesystem::path numbered(std::filesystem::path file, int number)
{
    const std::string name = fmt::format("{}-{:04}{}", file.stem().string(), number, file.extension().string());
    return file.replace_filename(name);
}

// Refuses a transparent background in formats without alpha, where it would be black.
Status checkBackground(const PictureOptions& picture, const std::filesystem::path& output)
{
    if (picture.background != Background::none || imageFormatHas(output, &ImageFormat::alpha) || !imageFormatOf(output))
        return Done{};
    return usageError(fmt::format(
        "--background none: {} files keep no transparency; expected {}", output.extension().string(),
        imageEndings([](const ImageFormat& f) { return (f.writes || f.animation) && f.alpha; }, ", ", " or ")));
}

Result<RenderJob> jobOf(const RenderCommandOptions& o)
{
    if (o.output.empty())
        return usageError("render needs -o FILE");
    COTAN_TRY(frame, parseFrameChoice(o.frame, "--frame"));
    COTAN_CHECK(checkBackground(o.picture, o.output));
    COTAN_TRY(numbers, imageNumbers(o));
    const bool animated = isAnimation(o.output), turns = o.turntable > 0;
    if (animated && numbers->empty())
        return usageError(fmt::format("-o: {} files hold the images of --turntable or --frames; found neither",
                                      o.output.extension().string()));
    const double rate = rateOf(o);
    RenderJob job{o, o.picture, *frame, {}, animated ? rate : 0};
    job.picture.turntable = turns;
    job.picture.use = !showsLight(o.picture.show) ? PictureUse::data
        : keepsFloats(o.output)                   ? PictureUse::radiance
                                                  : PictureUse::shown;
    for (const int number : *numbers)
        job.shots.push_back({animated ? o.output : numbered(o.output, number),
                             turns ? 360.0 * number / double(numbers->size()) : number / rate});
    if (job.shots.empty())
        job.shots = {{o.output, o.picture.time}};
    else if (!turns)
        job.picture.time = job.shots.front().at;
    return job;
}

std::vector<PlannedOutput> outputsOf(const RenderJob& job)
{
    std::vector<PlannedOutput> outputs;
    for (const Shot& shot : job.shots)
        if (outputs.empty() || job.rate == 0)
            outputs.push_back({"-o", shot.file});
    return outputs;
}

// ---- from the job to the report --------------------------------------------------------------

// Starts the file for all images; null if each has its own.
Result<std::unique_ptr<AnimationWriter>> beginAnimation(const RenderJob& job)
{
    if (job.rate == 0)
        return std::unique_ptr<AnimationWriter>();
    const std::filesystem::path& file = job.shots.front().file;
    auto animation =
        createAnimation(file, {job.picture.size.width, job.picture.size.height, job.shots.size(), job.rate});
    if (const double rate = animationRate(file, job.rate); animation && rate != job.rate)
        warn(job.common, "{}: GIF counts in hundredths of a second: {:.4g} images per second, not {:g}", file.string(),
             rate, job.rate);
    return animation;
}

Result<Image> drawShot(const RenderJob& job, const Picture& picture, Renderer& renderer, Rendered& done)
{
    auto image =
        drawShow(renderer, picture.scene, picture.view, job.picture.show, keepsFloats(job.shots.front().file),
                 picture.meant, [&](const AngleStatistics& degrees) { done.error = done.error.value_or(degrees); });
    if (image)
        COTAN_CHECK(layEdges(renderer, picture.view, job.picture, picture.edges, *image));
    return image;
}

// Reads the model once and opens the renderer once, for all images.
Result<Rendered> render(const RenderJob& job)
{
    Stopwatch total, watch;
    COTAN_TRY(animation, beginAnimation(job));
    COTAN_TRY(picture, loadPicture(job.picture, job.common, {job.frame}));
    const std::optional<Frame> frame = picture->frames.front();
    picture->view.setFrame(frame);
    picture->view.output = outputOf(job.picture.show);
    if (const std::string note = frameNote(picture->scene, frame); !note.empty())
        warn(job.common, note);
    Rendered done;
    done.scene = describeScene(job.picture, *picture);
    done.triangles = trianglesDrawn(picture->scene);
    done.frame = nameOf(frame);
    done.frames = nameOfFrames(frame, picture->scene);
    done.meant = name(picture->meant);
    done.loadSeconds = picture->loadSeconds;
    watch.lap();
    COTAN_TRY(renderer, makePictureRenderer(job.picture, job.common, *picture));
    done.device = (*renderer)->device();
    done.uploadSeconds = (*renderer)->uploadSeconds();
    done.openSeconds = watch.lap() - done.uploadSeconds;
    const auto drawAll = [&]() -> Status {
        for (std::size_t i = 0; i < job.shots.size(); ++i) {
            if (i > 0)
                COTAN_CHECK(movePicture(job.picture, job.shots[i].at, *picture, **renderer));
            COTAN_TRY(image, drawShot(job, *picture, **renderer, done));
            done.drawSeconds += watch.lap();
            if (Status written = *animation ? (*animation)->add(*image) : writeImage(job.shots[i].file, *image);
                !written)
                return written;
            done.writeSeconds += watch.lap();
        }
        return *animation ? (*animation)->finish() : Done{};
    };
    const std::size_t draws = job.picture.show == "error" ? 2 : 1; // errors also need the reference frame
    COTAN_CHECK(drawWithProgress(job.common, **renderer, draws * job.shots.size(), "drawing", drawAll));
    done.totalSeconds = total.lap();
    return done;
}

// ---- from the report to lines and JSON -------------------------------------------------------

Status tell(const RenderJob& job, const Rendered& done)
{
    const std::string first = job.shots.front().file.string(), last = job.shots.back().file.string();
    if (done.error)
        say(job.common, "{} against {}: {}", done.frames, done.meant, toText(*done.error));
    say(job.common, "{}: {}{}x{}, {} triangles, frame {}, on {}", first == last ? first : first + " to " + last,
        job.shots.size() > 1 ? fmt::format("{} images of ", job.shots.size()) : "", job.picture.size.width,
        job.picture.size.height, done.triangles, done.frames, done.device);
    Json report = {{"command", "render"}};
    if (done.error)
        report.update({{"frame_error", toJson(*done.error)}, {"frame_error_against", done.meant}});
    report.update(done.scene);
    report["frame"] = done.frame;
    report["view"] = job.picture.show;
    report["shading"] = wordOf(kShadings, job.picture.shading);
    report["device"] = done.device;
    report["output"] = first;
    report["seconds"] = {{"load", done.loadSeconds}, {"open_device", done.openSeconds}, {"upload", done.uploadSeconds},
                         {"draw", done.drawSeconds}, {"write", done.writeSeconds},      {"total", done.totalSeconds}};
    return writeReport(job.common, report);
}

Status run(const RenderCommandOptions& o)
{
    COTAN_TRY(job, jobOf(o));
    COTAN_CHECK(beginOutputs(job->common, outputsOf(*job)));
    const auto done = render(*job);
    return done ? tell(*job, *done) : done.error();
}

void declare(Arguments& a, RenderCommandOptions& o)
{
    addPictureOptions(a, o.picture);
    addFrameOption(a, o.frame);
    addShowOption(a, o.picture);
    a.group(HelpGroup::output);
    a.option("--frames", o.frames,
             "images A to B of --animation, all with one camera, written as NAME-0000.png and so on, or into one "
                 + imageEndings(&ImageFormat::animation, ", ", " or "))
        .in("A..B");
    a.option("--turntable", o.turntable,
             "turn the model once around, counter-clockwise from above, in N images, written like those of --frames")
        .within(2, 3600)
        .in("N")
        .withoutDefault();
    a.option("--rate", o.rate, "images of --frames or --turntable per second (default: 24; in GIF 25)")
        .above0()
        .in("N")
        .withoutDefault();
}

} // namespace

void addRenderCommand(Arguments& tool)
{
    addCommand<RenderCommandOptions>(
        tool,
        {"render",
         "Draw a model, or the built-in scene, to an image file.",
         fmt::format("image to write: {} (8 bit); {} (floats); {} (all of --turntable or --frames)",
                     imageEndings([](const ImageFormat& f) { return f.writes && !f.floats; }, ", "),
                     imageEndings([](const ImageFormat& f) { return f.writes && f.floats; }, ", "),
                     imageEndings(&ImageFormat::animation, ", ")),
         {"cotan render model.glb -o picture.png --frame cotangent --view normal",
          "cotan render --size 640x360 -o scene.png",
          "cotan render --shape teapot --turntable 4 --size 160x120 -o turning.gif"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
