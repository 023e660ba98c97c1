#include "cotan/render.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/named_values.hpp"
#include "core/parse_number.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

constexpr double kRadians = std::numbers::pi / 180;

std::vector<std::string_view> splitAtCommas(std::string_view text)
{
    std::vector<std::string_view> parts;
    for (std::size_t end = 0; (end = text.find(',')) != std::string_view::npos; text.remove_prefix(end + 1))
        parts.push_back(text.substr(0, end));
    parts.push_back(text);
    return parts;
}

bool finite(std::string_view text, float& value) { return parseNumber(text, value) && std::isfinite(value); }

// Parses the seventh part. Degrees are double, so that a formatted lens in float radians is restored exactly.
bool lensOf(std::string_view text, Camera& camera)
{
    camera.orthographic = text.starts_with('h');
    if (camera.orthographic)
        return finite(text.substr(1), camera.verticalExtent) && camera.verticalExtent > 0;
    double degrees = 0;
    if (!parseNumber(text, degrees) || !(degrees > 0 && degrees < 180))
        return false;
    camera.verticalFieldOfView = float(degrees * kRadians);
    return true;
}

Result<Camera> lookingFromTo(const std::string& text)
{
    const std::vector<std::string_view> parts = splitAtCommas(text);
    std::array<float, 10> v{}; // the seventh goes to `camera` instead
    Camera camera;
    bool good = parts.size() == 6 || parts.size() == 7 || parts.size() == 10;
    for (std::size_t i = 0; good && i < parts.size(); ++i)
        good = i == 6 ? lensOf(parts[i], camera) : finite(parts[i], v[i]);
    if (!good)
        return usageError("expected front, left, right, top, bottom, back, fit, orbit:AZ,EL, the number of a camera, "
                          "or ex,ey,ez,tx,ty,tz, optionally followed by a field of view and an up direction; found '"
                          + text + "'");
    camera.eye = {v[0], v[1], v[2]};
    camera.target = {v[3], v[4], v[5]};
    if (parts.size() == 10)
        camera.up = {v[7], v[8], v[9]};
    const glm::vec3 forward = camera.target - camera.eye;
    if (glm::length(forward) == 0)
        return usageError("the eye and the target are the same point");
    const bool vertical =
        glm::length(glm::cross(forward, camera.up)) <= 1e-4f * glm::length(forward) * glm::length(camera.up);
    if (vertical && parts.size() > 7)
        return usageError("the up direction is parallel to the view direction, or zero");
    if (vertical)
        camera.up = {0, 0, -1};
    return camera;
}

// Azimuth and elevation, in degrees.
constexpr Named<glm::dvec2> kSides[] = {
    {"left", {-90, 0}}, {"right", {90, 0}}, {"top", {0, 90}}, {"bottom", {0, -90}}, {"back", {180, 0}}};
constexpr std::string_view kOrbit = "orbit:";

Result<Camera> orbiting(const std::string& text, const Scene& scene, int width, int height)
{
    const std::vector<std::string_view> parts = splitAtCommas(std::string_view(text).substr(kOrbit.size()));
    double azimuth = 0, elevation = 0;
    if (parts.size() != 2 || !parseNumber(parts[0], azimuth) || !parseNumber(parts[1], elevation)
        || !(std::abs(azimuth) <= 360 && std::abs(elevation) <= 90))
        return usageError("expected orbit:AZ,EL, degrees around (-360 to 360) and above the horizon (-90 to 90); "
                          "found '"
                          + text + "'");
    return orbitCamera(scene, azimuth, elevation, width, height);
}

template<class Number> std::string digitsOf(Number value)
{
    std::array<char, 64> digits{};
    return {digits.data(),
            std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr}; // shortest exact form
}

// An angle in degrees, with as few digits as give it back: 45 instead of 45.00000000522092.
std::string degreesOf(float radians)
{
    const double degrees = double(radians) / kRadians;
    const std::string few = digitsOf(float(degrees));
    double read = 0;
    return parseNumber(std::string_view(few), read) && float(read * kRadians) == radians ? few : digitsOf(degrees);
}

} // namespace

Result<Camera> parseCamera(const std::string& text, const Scene& scene, int width, int height)
{
    if (text == "fit")
        return fitCamera(framedBounds(scene), width, height);
    if (text == "front")
        return frontCamera(scene, width, height);
    if (const auto side = valueOf(kSides, text))
        return orbitCamera(scene, side->x, side->y, width, height);
    if (text.starts_with(kOrbit))
        return orbiting(text, scene, width, height);
    int number = 0;
    if (!parseNumber(std::string_view(text), number))
        return lookingFromTo(text);
    if (number < 0 || std::size_t(number) >= scene.cameras.size())
        return usageError("expected a camera number below " + std::to_string(scene.cameras.size()) + "; found "
                          + std::to_string(number));
    return scene.cameras[std::size_t(number)];
}

std::string formatCamera(const Camera& camera)
{
    std::string text;
    const auto add = [&](const std::string& digits) {
        text += (text.empty() || text.back() == 'h' ? "" : ",") + digits;
    };
    for (const glm::vec3& point : {camera.eye, camera.target})
        for (int i = 0; i < 3; ++i)
            add(digitsOf(point[i]));
    if (camera.orthographic) {
        text += ",h";
        add(digitsOf(camera.verticalExtent));
    } else {
        add(degreesOf(camera.verticalFieldOfView));
    }
    const glm::vec3 forward = camera.target - camera.eye;
    const bool vertical = glm::length(glm::cross(forward, {0, 1, 0})) <= 1e-4f * glm::length(forward);
    if (camera.up != (vertical ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0)))
        for (int i = 0; i < 3; ++i)
            add(digitsOf(camera.up[i]));
    return text;
}

} // namespace cotan
