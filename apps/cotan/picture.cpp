#include "picture.hpp"

#include "bake/reports.hpp"
#include "scene/geometry.hpp"

namespace cotan::app {

Result<Picture> loadPicture(const PictureOptions& options, const CommonOptions& common,
                            std::initializer_list<FrameChoice> frames)
{
    Stopwatch watch;
    const auto open = [&] {
        const ProgressLine loading(common.quiet || options.model.empty(), 0, "loading " + options.model);
        return cotan::openPicture(options, common.threads, frames);
    };
    auto picture = open();
    if (!picture)
        return withOptionNames(picture.error());
    for (const std::string& line : picture->scene.warnings)
        warn(common, line);
    picture->loadSeconds = watch.lap();
    return picture;
}

Result<std::unique_ptr<Renderer>> makePictureRenderer(const PictureOptions& options, const CommonOptions& common,
                                                      Picture& picture)
{
    return warnOfNote(cotan::openPictureRenderer(options, picture), common);
}

Json describeScene(const PictureOptions& options, const Picture& picture)
{
    Json report = {{"model",
                    !options.model.empty()       ? options.model
                        : !options.shape.empty() ? options.shape
                                                 : "built-in"},
                   {"size", {picture.view.width, picture.view.height}}};
    if (!options.animation.empty())
        report["pose"] = {{"animation", options.animation}, {"seconds", options.time}};
    report.update(countsOf(picture.scene));
    return report;
}

} // namespace cotan::app
