#include "studio.hpp"

#include "cotan/render.hpp"

namespace cotan::figures {

void Studio::show(const Scene& scene)
{
    scene_ = &scene;
    if (error_)
        return;
    if (Status loaded = painter_.load(scene); !loaded)
        error_ = loaded.error();
}

Image Studio::kept(Result<Image> result, const View& view)
{
    if (result)
        return std::move(*result);
    error_ = result.error();
    const bool bytes = view.output == Output::shaded && !view.linearOutput;
    return makeImage(view.width, view.height, bytes ? PixelType::unorm8 : PixelType::float32);
}

Image Studio::draw(const View& view) { return kept(error_ ? Result<Image>(*error_) : painter_.draw(view), view); }

Image Studio::drawReference(const View& view)
{
    return kept(error_ ? Result<Image>(*error_) : renderReference(*scene_, view, threads_), view);
}

Image Studio::shaded(View view, Frame frame)
{
    view.output = Output::shaded;
    view.frame = frame;
    return draw(view);
}

Image Studio::vectors(View view, Frame frame, Output output)
{
    view.output = output;
    view.frame = frame;
    return draw(view);
}

} // namespace cotan::figures
