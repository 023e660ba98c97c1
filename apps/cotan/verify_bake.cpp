#include "verify_bake.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

#include <fmt/format.h>

#include "core/try.hpp"
#include "high_view.hpp"
#include "inspect/angles.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/parts.hpp"

namespace cotan::app {

namespace {

// The view with the high surface as expected image, and in the heat map magenta for pixels that show another surface.
ComparedView compareView(const HighView& seen, const Image& drawn, const std::vector<float>& degrees)
{
    constexpr std::uint8_t kOtherColor[4] = {255, 0, 255, 255};
    ComparedView view{angleStatistics(degrees),
                      asColor(Output::normal, seen.normals),
                      asColor(Output::normal, drawn),
                      heatMap(degrees, drawn.width, drawn.height),
                      seen.others,
                      seen.compared};
    for (std::size_t i = 0; i < seen.other.size(); ++i)
        if (seen.other[i])
            std::copy_n(kOtherColor, 4, view.difference.bytes8() + 4 * i);
    return view;
}

// Views from all sides.
std::vector<View> viewsOf(const Scene& scene, const BakeToVerify& bake, int side)
{
    constexpr double kQuarter = 1.5707963; // radians
    View view;
    view.width = view.height = side;
    view.frame = bake.options.frame;
    view.output = Output::normal;
    std::vector<View> views(kBakeViews, view);
    const Camera front = fitCamera(bounds(scene), side, side);
    for (int k = 0; k < kBakeViews; ++k)
        views[std::size_t(k)].camera = orbitedCamera(front, k * kQuarter);
    return views;
}

// Draws and compares all views. views: of the loaded scene.
Result<ComparedViews> compareAround(Renderer& renderer, const std::vector<View>& views, const BakeToVerify& bake)
{
    ComparedViews compared;
    compared.mapped = true;
    AngleCounter all;
    for (const View& view : views) {
        COTAN_TRY(drawn, renderer.draw(view));
        COTAN_TRY(seen, renderHighView(bake.low, bake.high, bake.options, view));
        const std::vector<float> degrees = interiorAngles(seen->expected, *drawn);
        compared.views.push_back(compareView(*seen, *drawn, degrees));
        compared.others += seen->others;
        compared.pixels += seen->compared;
        for (const float d : degrees)
            all.add(d);
    }
    compared.all = all.statistics();
    return compared;
}

} // namespace

bool showsHighSurface(const ComparedViews& compared)
{
    constexpr double kMaxOthers = 0.01; // fraction of a view's pixels
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
    const std::vector<View> views = viewsOf(scene, bake, side);
    for (const View& view : views)
        COTAN_CHECK(limitCoverage(scene, view));
    const auto forget = [](Renderer* drawing) { drawing->forget(); }; // the scene goes out of scope here
    const std::unique_ptr<Renderer, decltype(forget)> unloadAtEnd(&renderer, forget);
    COTAN_CHECK(renderer.load(scene));
    return compareAround(renderer, views, bake);
}

} // namespace cotan::app
