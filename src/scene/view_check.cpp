#include "scene/view_check.hpp"
#include "cotan/vector.hpp"

#include <cmath>
#include <optional>
#include <string>

#include <glm/geometric.hpp>

namespace cotan {

namespace {

constexpr float kHalfTurn = 3.14159274f; // radians

// One line, or nothing.
using ViewProblem = std::optional<std::string>;

ViewProblem cameraProblem(const Camera& c)
{
    if (!isFinite(c.eye) || !isFinite(c.target) || !isFinite(c.up))
        return "view.camera: expected finite numbers";
    const glm::dvec3 along = glm::dvec3(c.target) - glm::dvec3(c.eye), up(c.up);
    if (along == glm::dvec3(0))
        return "view.camera: the eye and the target are the same point";
    if (glm::cross(along, up) == glm::dvec3(0))
        return "view.camera: expected a direction up across the line of sight; found one along it, or zero";
    const float lens = c.orthographic ? c.verticalExtent : c.verticalFieldOfView;
    if (!(lens > 0) || !std::isfinite(lens) || (!c.orthographic && lens >= kHalfTurn))
        return std::string("view.camera: expected a ")
            + (c.orthographic ? "verticalExtent over 0; found " : "verticalFieldOfView over 0 and below pi; found ")
            + std::to_string(lens);
    return std::nullopt;
}

ViewProblem numberProblem(const View& view)
{
    if (view.width < 1 || view.height < 1)
        return "view: expected a width and a height from 1 on; found " + std::to_string(view.width) + "x"
            + std::to_string(view.height);
    if (!isFrame(int(view.frame)))
        return "view.frame: expected 0 to " + std::to_string(kFrameCount - 1) + "; found "
            + std::to_string(int(view.frame));
    if (view.samples != 1 && view.samples != 4 && view.samples != 16)
        return "view.samples: expected 1, 4 or 16; found " + std::to_string(view.samples);
    if (!std::isfinite(view.exposure))
        return "view.exposure: expected a finite number; found " + std::to_string(view.exposure);
    if (!(view.shadowSoftness >= 0) || !std::isfinite(view.shadowSoftness))
        return "view.shadowSoftness: expected a number from 0 on; found " + std::to_string(view.shadowSoftness);
    return std::nullopt;
}

} // namespace

Status checkView(const View& view)
{
    for (const ViewProblem& problem : {numberProblem(view), cameraProblem(view.camera)})
        if (problem)
            return usageError(*problem);
    return Done{};
}

} // namespace cotan
