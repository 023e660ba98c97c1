// Draws the panels of figures: a renderer, the size of the panels, and the first error.
#pragma once

#include <optional>

#include "cotan/frame.hpp"
#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan::figures {

class FigureRenderer {
public:
    // width, height: size of a wide panel in pixels; square panels are height x height.
    FigureRenderer(Renderer& renderer, int threads, int width, int height)
        : renderer_(renderer), threads_(threads), width_(width), height_(height)
    {
    }

    int width() const { return width_; }
    int height() const { return height_; }

    // Loads a scene, which must live until the next call.
    void show(const Scene& scene);

    // Draws the scene. After an error, returns a transparent image of the right size and type.
    Image draw(const View& view);
    Image shaded(View view, Frame frame);
    Image vectors(View view, Frame frame, Output output);
    Image normals(const View& view, Frame frame) { return vectors(view, frame, Output::normal); }

    // Draws with the reference renderer, whatever the renderer is.
    Image drawReference(const View& view);

    // The first error, if any.
    const std::optional<Error>& error() const { return error_; }

private:
    Image orPlaceholder(Result<Image> result, const View& view);

    Renderer& renderer_;
    int threads_;
    int width_;
    int height_;
    const Scene* scene_ = nullptr;
    std::optional<Error> error_;
};

} // namespace cotan::figures
