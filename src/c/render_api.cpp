// cotan.h: the image that `cotan render` makes.
#include "bake/reports.hpp"
#include "core/loops.hpp"
#include "cotan/picture.hpp"
#include "inspect/angles.hpp"
#include "model_files.hpp"
#include "picture/option_table.hpp"
#include "scene/normal_maps.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

struct Wanted {
    PictureOptions picture;
    std::string frame{kAutoFrame};
};

// Parses the words, with the same checks as on the command line.
Wanted readWords(const cotan_render_options& o)
{
    Wanted wanted;
    require(o.word_count == 0 || o.words, "options.words: expected an array, found null");
    std::vector<std::string> words;
    for (std::size_t i = 0; i < o.word_count; ++i)
        words.emplace_back(word(o.words[i], "options.words"));
    valueOf(readPictureWords(words, wanted.picture, wanted.frame));
    wanted.picture.use = !showsLight(wanted.picture.show) ? PictureUse::data
        : o.floats != 0                                   ? PictureUse::radiance
                                                          : PictureUse::shown;
    return wanted;
}

// Makes the options read the model's bytes instead of a file.
void readFrom(const ModelFiles& source, PictureOptions& options)
{
    if (!options.model.empty() || !options.shape.empty())
        fail(ErrorKind::usage, "model: expected bytes or a file or a shape, found also '", options.model, options.shape,
             "'");
    const LoadLimits limits = source.limits();
    options.model = source.name();
    options.readFile = limits.readFile;
    options.decode = limits.decode;
}

Image draw(const Wanted& wanted, const cotan_render_options& o, Json& report)
{
    const FrameChoice frame = valueOf(parseFrameChoice(wanted.frame));
    Picture picture = valueOf(openPicture(wanted.picture, o.threads, {frame}));
    picture.view.setFrame(picture.frames.front());
    picture.view.output = outputOf(wanted.picture.show);
    const auto renderer = valueOf(openPictureRenderer(wanted.picture, picture));
    renderer->progress = progressOf(o.progress, o.user);
    report = {{"frame", nameOf(picture.frames.front())}, {"view", wanted.picture.show}, {"device", renderer->device()}};
    report.update(countsOf(picture.scene));
    if (!renderer->note.empty())
        report["note"] = renderer->note;
    if (const std::string note = frameNote(picture.scene, picture.frames.front()); !note.empty())
        report["frame_note"] = note;
    Image image = valueOf(drawShow(*renderer, picture.scene, picture.view, wanted.picture.show, o.floats != 0,
                                   picture.meant, [&](const AngleStatistics& degrees) {
                                       report["frame_error"] = toJson(degrees);
                                       report["frame_error_against"] = name(picture.meant);
                                   }));
    valueOf(layEdges(*renderer, picture.view, wanted.picture, picture.edges, image));
    return image;
}

} // namespace

cotan_status cotan_render(const void* model, size_t model_size, const cotan_model_files* files,
                          const cotan_render_options* options, cotan_image** image, cotan_bytes** json, char* message,
                          size_t message_size)
{
    return call(message, message_size, [&] {
        require(image, "image: expected a pointer, found null");
        const cotan_render_options o = optionsOf(options, "options");
        require(o.threads >= 0, "options.threads: expected 0 or more");
        Wanted wanted = readWords(o);
        const ModelFiles source(model, model_size, files);
        if (model)
            readFrom(source, wanted.picture);
        Json report;
        auto made = std::make_unique<cotan_image>();
        withThreads(o.threads, [&] { made->image = draw(wanted, o, report); });
        giveText("cotan-render-result", report, json);
        *image = made.release();
    });
}
