#include "parse.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/geometric.hpp>

#include "cotan/scene/geometry.hpp"

namespace cotan::app {

namespace {

// Reads a number that fills the whole text.
template<class Number> bool parseWhole(std::string_view text, Number& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

Result<Camera> lookingFromTo(const std::string& text)
{
    std::array<float, 6> v{};
    std::size_t start = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const std::size_t comma = text.find(',', start);
        const bool last = i + 1 == v.size();
        if ((comma == std::string::npos) != last
            || !parseWhole(std::string_view(text).substr(start, last ? std::string::npos : comma - start), v[i])
            || !std::isfinite(v[i]))
            return usageError(fmt::format(
                "--camera: expected fit, the number of a camera, or six numbers ex,ey,ez,tx,ty,tz; found '{}'", text));
        start = comma + 1;
    }
    Camera camera;
    camera.eye = {v[0], v[1], v[2]};
    camera.target = {v[3], v[4], v[5]};
    const glm::vec3 forward = camera.target - camera.eye;
    if (glm::length(forward) == 0)
        return usageError("--camera: the eye and the target are the same point");
    const bool vertical = glm::length(glm::cross(forward, camera.up)) < 1e-4f * glm::length(forward);
    if (vertical)
        camera.up = {0, 0, -1};
    return camera;
}

} // namespace

Result<std::pair<int, int>> parseSize(const std::string& text)
{
    const std::size_t x = text.find('x');
    int width = 0, height = 0;
    if (x == std::string::npos || !parseWhole(std::string_view(text).substr(0, x), width)
        || !parseWhole(std::string_view(text).substr(x + 1), height) || width < 1 || height < 1 || width > 16384
        || height > 16384)
        return usageError(fmt::format("--size: expected WxH, each from 1 to 16384; found '{}'", text));
    return std::pair(width, height);
}

Result<Frame> parseFrame(const std::string& text)
{
    if (const auto frame = frameFromName(text))
        return *frame;
    return usageError(fmt::format("frame: expected one of {}; found '{}'", frameNames(), text));
}

Result<Camera> parseCamera(const std::string& text, const Scene& scene, int width, int height)
{
    if (text == "fit")
        return fitCamera(bounds(scene), width, height);
    int number = 0;
    if (parseWhole(std::string_view(text), number)) {
        if (number < 0 || std::size_t(number) >= scene.cameras.size())
            return usageError(fmt::format("--camera: expected a camera of the model, it has {}; found {}",
                                          scene.cameras.size(), number));
        return scene.cameras[std::size_t(number)];
    }
    return lookingFromTo(text);
}

std::string frameNames()
{
    std::vector<std::string_view> names;
    for (const FrameInfo& f : frames())
        names.push_back(f.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> splitAtCommas(const std::string& text)
{
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');)
        words.push_back(word);
    return words;
}

Error unknownWord(const std::string& option, const std::vector<std::string_view>& known, const std::string& word)
{
    std::string list;
    for (std::size_t i = 0; i < known.size(); ++i)
        list += (i == 0 ? "" : i + 1 == known.size() ? " or " : ", ") + std::string(known[i]);
    return usageError(fmt::format("{}: expected {}; found '{}'", option, list, word));
}

Error notOneOf(const std::string& option, const std::vector<std::string_view>& known, const std::string& word)
{
    return usageError(fmt::format("{}: expected one of {}; found '{}'", option, fmt::join(known, ", "), word));
}

} // namespace cotan::app
