// Where figures are drawn: a renderer, the size of the panels, and the first thing that went wrong.
#pragma once

#include <optional>

#include "cotan/frame.hpp"
#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan::figures {

class FigureRenderer {
public:
    // width, height: of a wide panel, in pixels; square ones are height x height.
    FigureRenderer(Renderer& renderer, int threads, int width, int height)
        : renderer_(renderer), threads_(threads), width_(width), height_(height)
    {
    }

    int width() const { return width_; }
    int height() const { return height_; }

    // Takes a scene; it must live until the next one is shown.
    void show(const Scene& scene);

    // Draws the scene. After an error: a transparent picture of the right size and type.
    Image draw(const View& view);
    Image shaded(View view, Frame frame);
    Image vectors(View view, Frame frame, Output output);
    Image normals(const View& view, Frame frame) { return vectors(view, frame, Output::normal); }

    // The same from the reference renderer, whatever the renderer is.
    Image drawReference(const View& view);

    // The first error, if there was one.
    const std::optional<Error>& error() const { return error_; }

private:
    Image kept(Result<Image> result, const View& view);

    Renderer& renderer_;
    int threads_;
    int width_;
    int height_;
    const Scene* scene_ = nullptr;
    std::optional<Error> error_;
};

} // namespace cotan::figures
