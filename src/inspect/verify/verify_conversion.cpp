#include "cotan/inspect.hpp"

#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "compare_views.hpp"
#include "cotan/view.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

std::vector<Camera> camerasAround(const Scene& scene, int side)
{
    const Camera fit = fitCamera(bounds(scene), side, side);
    std::vector<Camera> cameras = {fit};
    for (int k = 1; k < kConversionViews - 1; ++k)
        cameras.push_back(turnedAbout(fit, float(std::numbers::pi) / 2 * float(k)));
    Camera above = fit;
    above.eye = fit.target + glm::vec3(0, glm::length(fit.eye - fit.target), 0);
    above.up = {0, 0, -1};
    cameras.push_back(above);
    return cameras;
}

} // namespace

Result<DrawnSides> drawSides(Renderer& renderer, ModelInFrame model, std::vector<Camera> cameras, int side)
{
    DrawnSides sides;
    sides.mapped = drawsNormalMaps(model.scene);
    sides.cameras = cameras.empty() ? camerasAround(model.scene, side) : std::move(cameras);
    deriveVertexFrames(model.scene, model.frame, model.tangents);
    const ShownScene shown(renderer, model.scene);
    if (!shown.status())
        return shown.status().error();
    for (const Camera& camera : sides.cameras) {
        auto image = renderer.draw(normalView(camera, model.frame, side));
        if (!image)
            return image.error();
        sides.normals.push_back(std::move(*image));
    }
    return sides;
}

Result<ComparedViews> compareSides(const DrawnSides& before, const DrawnSides& after)
{
    if (before.normals.size() != after.normals.size())
        return usageError(fmt::format("verify: expected as many pictures after as before, {}; found {}",
                                      before.normals.size(), after.normals.size()));
    ViewComparison comparison(before.mapped || after.mapped);
    for (std::size_t k = 0; k < before.normals.size(); ++k) {
        const Image &a = before.normals[k], &b = after.normals[k];
        if (a.width != b.width || a.height != b.height)
            return usageError(fmt::format("verify: expected pictures of one size, {} x {}; found {} x {}", a.width,
                                          a.height, b.width, b.height));
        comparison.add(a, b);
    }
    return comparison.finish();
}

Result<ComparedViews> verifyConversion(Renderer& renderer, ModelInFrame before, ModelInFrame after, int side)
{
    const auto first = drawSides(renderer, std::move(before), {}, side);
    if (!first)
        return first.error();
    const auto second = drawSides(renderer, std::move(after), first->cameras, side);
    if (!second)
        return second.error();
    return compareSides(*first, *second);
}

} // namespace cotan
