#include "commands.hpp"

#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/parse_number.hpp"
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

constexpr double kUsualRate = 24, kUsualGifRate = 25; // GIF stores durations in hundredths of a second

double rateOf(const RenderCommandOptions& o)
{
    if (o.rate > 0)
        return o.rate;
    return animationRate(o.output, kUsualRate) == kUsualRate ? kUsualRate : kUsualGifRate;
}

Result<Image> drawPicture(Renderer& renderer, const Picture& picture, const RenderCommandOptions& o, Json& report)
{
    auto image = drawShow(renderer, picture.scene, picture.view, o.picture.show, keepsFloats(o.output),
                          [&](const AngleStatistics& degrees) {
                              report["error_against_exact"] = toJson(degrees);
                              say(o, "{} against exact: {}", nameOfFrames(picture.frames.front(), picture.scene),
                                  toText(degrees));
                          });
    if (image)
        if (Status laid = layEdges(renderer, picture.view, o.picture, picture.edges, *image); !laid)
            return laid.error();
    return image;
}

// Shared by the images of a sequence: the view of the first image, whose camera covers the whole animation and whose
// environment takes a second to compute, and the animation file, if any.
struct Sequence {
    std::optional<View> view;
    std::unique_ptr<AnimationWriter> animation;
};

// The model with its chosen frame. like: the view of the previous image.
Result<Picture> loadFramed(const RenderCommandOptions& o, FrameChoice frame, const View* like)
{
    auto picture = loadPicture(o.picture, o, {frame, Frame::exact}, like);
    if (!picture)
        return picture;
    picture->view.setFrame(picture->frames.front());
    if (const std::string note = frameNote(picture->scene, picture->frames.front()); !note.empty())
        warn(o, note);
    picture->view.output = outputOf(o.picture.show);
    return picture;
}

// Number of draws per image: errors also need the reference frame.
std::size_t drawsOf(const RenderCommandOptions& o) { return o.picture.show == "error" ? 2 : 1; }

Status writeNext(const RenderCommandOptions& o, const Image& image, Sequence& sequence)
{
    return sequence.animation ? sequence.animation->add(image) : writeImage(o.output, image);
}

// Draws one image to o.output, or appends it to the animation file.
Status renderOne(const RenderCommandOptions& o, FrameChoice frame, Sequence& sequence)
{
    std::optional<View>& shared = sequence.view;
    Stopwatch total;
    auto picture = loadFramed(o, frame, shared ? &*shared : nullptr);
    if (!picture)
        return picture.error();

    Stopwatch watch;
    auto renderer = makePictureRenderer(o.picture, o, *picture);
    if (!renderer)
        return renderer.error();
    shared = picture->view;
    const double openSeconds = watch.lap() - (*renderer)->uploadSeconds();
    Json report = {{"command", "render"}};
    const auto image = drawWithProgress(o, **renderer, drawsOf(o), "drawing",
                                        [&] { return drawPicture(**renderer, *picture, o, report); });
    if (!image)
        return image.error();
    const double drawSeconds = watch.lap();
    if (Status written = writeNext(o, *image, sequence); !written)
        return written;
    const double writeSeconds = watch.lap();

    report.update(describeScene(o.picture, *picture));
    report["frame"] = nameOf(picture->frames.front());
    report["view"] = o.picture.show;
    report["shading"] = wordOf(kShadings, o.picture.shading);
    report["device"] = (*renderer)->device();
    report["output"] = o.output.string();
    report["seconds"] = {
        {"load", picture->loadSeconds}, {"open_device", openSeconds}, {"upload", (*renderer)->uploadSeconds()},
        {"draw", drawSeconds},          {"write", writeSeconds},      {"total", total.lap()}};
    say(o, "{}: {}x{}, {} triangles, frame {}, on {}", o.output.string(), picture->view.width, picture->view.height,
        trianglesDrawn(picture->scene), nameOfFrames(picture->frames.front(), picture->scene), (*renderer)->device());
    return writeReport(o, report);
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

// Starts one file for all images.
Status beginAnimation(const RenderCommandOptions& o, std::size_t images, Sequence& sequence)
{
    const double requested = rateOf(o);
    auto animation = createAnimation(o.output, {o.picture.size.width, o.picture.size.height, images, requested});
    if (!animation)
        return animation.error();
    sequence.animation = std::move(*animation);
    if (const double rate = animationRate(o.output, requested); rate != requested)
        warn(o, "{}: GIF counts in hundredths of a second: {:.4g} images per second, not {:g}", o.output.string(), rate,
             requested);
    return Done{};
}

// Completes the animation file, if any.
Status finish(Sequence& sequence) { return sequence.animation ? sequence.animation->finish() : Status(Done{}); }

// Draws the images of --frames: the model is loaded in a new pose for each.
Status renderFrames(const RenderCommandOptions& o, FrameChoice frame, const std::vector<int>& numbers,
                    Sequence& sequence)
{
    RenderCommandOptions one = o;
    for (const int number : numbers) {
        if (!sequence.animation)
            one.output = numbered(o.output, number);
        one.picture.time = number / rateOf(o);
        if (Status drawn = renderOne(one, frame, sequence); !drawn)
            return drawn;
        if (one.quiet && !sequence.animation) // the first image has printed its own line
            say(o, "{}", one.output.string());
        one.quiet = true; // all warnings were printed with the first image
    }
    return finish(sequence);
}

// Draws the images of --turntable: the model is loaded once, its shadow is computed for each image.
Status renderTurn(const RenderCommandOptions& o, FrameChoice frame, const std::vector<int>& numbers, Sequence& sequence)
{
    RenderCommandOptions one = o;
    one.picture.turntable = true;
    auto picture = loadFramed(one, frame, nullptr);
    if (!picture)
        return picture.error();
    auto renderer = makePictureRenderer(one.picture, o, *picture);
    if (!renderer)
        return renderer.error();
    const Turntable table(picture->scene);
    one.quiet = true; // no line per image
    Json none;
    const std::size_t draws = numbers.size() * drawsOf(o);
    const auto drawAll = [&]() -> Status {
        for (const int number : numbers) {
            if (number > 0) {
                table.turn(picture->scene, 360.0 * number / double(numbers.size()));
                if (Status loaded = (*renderer)->load(picture->scene, /*sameImages=*/true); !loaded)
                    return loaded;
                picture->view.ground = groundOf(one.picture, picture->scene, picture->view);
                if (o.picture.edges != Edges::none)
                    picture->edges = surfaceEdges(picture->scene);
            }
            one.output = sequence.animation ? o.output : numbered(o.output, number);
            const auto image = drawPicture(**renderer, *picture, one, none);
            if (!image)
                return image.error();
            if (Status written = writeNext(one, *image, sequence); !written)
                return written;
        }
        return Done{};
    };
    if (Status drawn = drawWithProgress(o, **renderer, draws, "drawing", drawAll); !drawn)
        return drawn;
    if (Status whole = finish(sequence); !whole)
        return whole;
    say(o, "{}: {} images of {}x{}, {} triangles, frame {}, on {}", o.output.string(), numbers.size(),
        picture->view.width, picture->view.height, trianglesDrawn(picture->scene),
        nameOfFrames(picture->frames.front(), picture->scene), (*renderer)->device());
    return Done{};
}

// Refuses a transparent background in formats without alpha, where it would be black.
Status checkBackground(const RenderCommandOptions& o)
{
    if (o.picture.background != Background::none || imageFormatHas(o.output, &ImageFormat::alpha)
        || !imageFormatOf(o.output))
        return Done{};
    return usageError(fmt::format(
        "--background none: {} files keep no transparency; expected {}", o.output.extension().string(),
        imageEndings([](const ImageFormat& f) { return (f.writes || f.animation) && f.alpha; }, ", ", " or ")));
}

Status run(const RenderCommandOptions& o)
{
    if (o.output.empty())
        return usageError("render needs -o FILE");
    const auto frame = parseFrameChoice(o.frame, "--frame");
    if (!frame)
        return frame.error();
    if (Status fits = checkLighting(o.picture, *frame); !fits)
        return fits;
    if (Status keeps = checkBackground(o); !keeps)
        return keeps;
    const auto numbers = imageNumbers(o);
    if (!numbers)
        return numbers.error();
    const bool animated = isAnimation(o.output);
    if (animated && numbers->empty())
        return usageError(fmt::format("-o: {} files hold the images of --turntable or --frames; found neither",
                                      o.output.extension().string()));
    std::vector<PlannedOutput> outputs;
    for (const int number : *numbers)
        if (!animated)
            outputs.push_back({"-o", numbered(o.output, number)});
    if (outputs.empty())
        outputs.push_back({"-o", o.output});
    if (Status planned = beginOutputs(o, outputs); !planned)
        return planned;
    Sequence sequence;
    RenderCommandOptions one = o;
    one.picture.use = o.picture.show != "shaded" ? PictureUse::data
        : keepsFloats(o.output)                  ? PictureUse::radiance
                                                 : PictureUse::shown;
    if (numbers->empty())
        return renderOne(one, *frame, sequence);
    if (animated)
        if (Status begun = beginAnimation(o, numbers->size(), sequence); !begun)
            return begun;
    const auto draw = o.turntable > 0 ? renderTurn : renderFrames;
    if (Status drawn = draw(one, *frame, *numbers, sequence); !drawn)
        return drawn;
    return Done{};
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
