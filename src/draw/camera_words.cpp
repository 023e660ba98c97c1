#include "cotan/draw/camera_words.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <glm/geometric.hpp>

#include "cotan/parse_number.hpp"
#include "cotan/scene/front_camera.hpp"
#include "cotan/scene/geometry.hpp"

namespace cotan {

namespace {

Result<Camera> lookingFromTo(const std::string& text)
{
    std::array<float, 6> v{};
    std::size_t start = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const std::size_t comma = text.find(',', start);
        const bool last = i + 1 == v.size();
        if ((comma == std::string::npos) != last
            || !parseNumber(std::string_view(text).substr(start, last ? std::string::npos : comma - start), v[i])
            || !std::isfinite(v[i]))
            return usageError("expected fit, front, the number of a camera, or six numbers ex,ey,ez,tx,ty,tz; found '"
                              + text + "'");
        start = comma + 1;
    }
    Camera camera;
    camera.eye = {v[0], v[1], v[2]};
    camera.target = {v[3], v[4], v[5]};
    const glm::vec3 forward = camera.target - camera.eye;
    if (glm::length(forward) == 0)
        return usageError("the eye and the target are the same point");
    const bool vertical = glm::length(glm::cross(forward, camera.up)) < 1e-4f * glm::length(forward);
    if (vertical)
        camera.up = {0, 0, -1};
    return camera;
}

} // namespace

Result<Camera> cameraFromWords(const std::string& text, const Scene& scene, int width, int height)
{
    if (text == "fit")
        return fitCamera(bounds(scene), width, height);
    if (text == "front")
        return frontCamera(scene, width, height);
    int number = 0;
    if (!parseNumber(std::string_view(text), number))
        return lookingFromTo(text);
    if (number < 0 || std::size_t(number) >= scene.cameras.size())
        return usageError("expected a camera of the model, it has " + std::to_string(scene.cameras.size()) + "; found "
                          + std::to_string(number));
    return scene.cameras[std::size_t(number)];
}

} // namespace cotan
