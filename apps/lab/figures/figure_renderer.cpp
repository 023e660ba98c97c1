#include "figure_renderer.hpp"

namespace cotan::figures {

void FigureRenderer::show(const Scene& scene)
{
    scene_ = &scene;
    if (error_)
        return;
    if (Status loaded = renderer_.load(scene); !loaded)
        error_ = loaded.error();
}

Image FigureRenderer::orPlaceholder(Result<Image> result, const View& view)
{
    if (result)
        return std::move(*result);
    error_ = result.error();
    const bool bytes = view.output == Output::shaded && !view.linearOutput;
    return makeImage(view.width, view.height, bytes ? PixelType::unorm8 : PixelType::float32);
}

Image FigureRenderer::draw(const View& view)
{
    return orPlaceholder(error_ ? Result<Image>(*error_) : renderer_.draw(view), view);
}

Image FigureRenderer::drawReference(const View& view)
{
    return orPlaceholder(error_ ? Result<Image>(*error_) : renderReference(*scene_, view, threads_), view);
}

Image FigureRenderer::shaded(View view, Frame frame)
{
    view.output = Output::shaded;
    view.frame = frame;
    return draw(view);
}

Image FigureRenderer::vectors(View view, Frame frame, Output output)
{
    view.output = output;
    view.frame = frame;
    return draw(view);
}

} // namespace cotan::figures
