#include "inspect/verify/verify_bake.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compare_views.hpp"
#include "cotan/view.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"

namespace cotan {

namespace {

constexpr double kQuarter = 1.5707963; // radians

constexpr double kMaxOthers = 0.01; // of a view's pixels

} // namespace

bool showsHighSurface(const ComparedViews& compared)
{
    return std::none_of(compared.views.begin(), compared.views.end(), [](const ComparedView& view) {
        return double(view.others) > kMaxOthers * double(view.pixels);
    });
}

Result<ComparedViews> verifyBake(Renderer& renderer, const BakeToVerify& bake, int side)
{
    if (bake.material < -1 || bake.material >= int(bake.scene.materials.size()))
        return usageError(fmt::format("verify: expected a material from -1 to {}; found {}",
                                      int(bake.scene.materials.size()) - 1, bake.material));
    Scene scene = bake.scene;
    putNormalMap(scene, bake.map, bake.format, bake.material);
    deriveVertexFrames(scene, bake.options.frame, bake.tangents);
    const ShownScene shown(renderer, scene);
    if (!shown.status())
        return shown.status().error();
    const Camera front = fitCamera(bounds(scene), side, side);
    ViewComparison comparison(/*mapped*/ true);
    for (int k = 0; k < kBakeViews; ++k) {
        const View view = normalView(turnedAbout(front, k * kQuarter), bake.options.frame, side);
        const auto drawn = renderer.draw(view);
        if (!drawn)
            return drawn.error();
        const auto seen = seeHigh(bake.low, bake.high, bake.options, view);
        if (!seen)
            return seen.error();
        comparison.add(seen->expected, *drawn, *seen);
    }
    return comparison.finish();
}

} // namespace cotan
