// Draws models of the test data.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "cotan/model.hpp"
#include "cotan/render.hpp"
#include "inspect/angles.hpp"
#include "scene/geometry.hpp"
#include "test_data.hpp"

namespace cotan::test {

inline Scene loadModel(const char* file)
{
    auto scene = loadScene(dataFile(file));
    if (!scene) {
        ADD_FAILURE() << scene.error().message;
        return {};
    }
    return std::move(*scene);
}

// The renderer of that name; null if it is unavailable (e.g. Vulkan on machines without it).
inline std::unique_ptr<Renderer> rendererFor(const std::string& device)
{
    auto renderer = openRenderer(device);
    return renderer && (*renderer)->note.empty() ? std::move(*renderer) : nullptr;
}

inline Image drawWith(Renderer& renderer, const View& view)
{
    auto image = renderer.draw(view);
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return makeImage(view.width, view.height, PixelType::float32);
    }
    return std::move(*image);
}

// Orthographic view along -z of the rectangle, with `perUnit` pixels per world unit.
inline View frontView(glm::vec2 low, glm::vec2 high, float perUnit)
{
    View view;
    view.width = int((high.x - low.x) * perUnit + 0.5f);
    view.height = int((high.y - low.y) * perUnit + 0.5f);
    view.camera.orthographic = true;
    view.camera.verticalExtent = float(view.height) / perUnit;
    const glm::vec2 centre = (low + high) * 0.5f;
    view.camera.eye = {centre.x, centre.y, 10};
    view.camera.target = {centre.x, centre.y, 0};
    view.output = Output::normal;
    return view;
}

inline glm::dvec3 directionAt(const Image& image, int x, int y)
{
    const float* p = image.floats() + (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
    return p[3] > 0 ? glm::dvec3(p[0], p[1], p[2]) : glm::dvec3(0);
}

} // namespace cotan::test
