#include "cotan/inspect.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "inspect/angles.hpp"
#include "inspect/verify/verify_bake.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"

namespace cotan {

// ---- what all comparisons share ------------------------------------------------------------

namespace {

// Lets the renderer look at a scene while it lives.
class ShownScene {
public:
    ShownScene(Renderer& renderer, const Scene& scene) : renderer_(renderer), status_(renderer.load(scene)) {}
    ~ShownScene() { renderer_.forget(); }
    ShownScene(const ShownScene&) = delete;
    ShownScene& operator=(const ShownScene&) = delete;

    const Status& status() const { return status_; }

private:
    Renderer& renderer_;
    Status status_;
};

// A square picture of normals.
View normalView(const Camera& camera, Frame frame, int side)
{
    View view;
    view.width = view.height = side;
    view.camera = camera;
    view.frame = frame;
    view.output = Output::normal;
    return view;
}

// The angles as they are where a normal map is drawn; otherwise none, as no frame has a part in the normals.
std::vector<float> mappedAngles(std::vector<float> degrees, bool mapped)
{
    if (!mapped)
        degrees.assign(degrees.size(), -1.0f);
    return degrees;
}

// Collects views and, in the end, the statistics of all. mapped: see ComparedViews.
class ViewComparison {
public:
    explicit ViewComparison(bool mapped) { result_.mapped = mapped; }

    // Two pictures of directions of the same size.
    void add(const Image& expected, const Image& drawn)
    {
        const std::vector<float> degrees = mappedAngles(interiorAngles(expected, drawn), result_.mapped);
        result_.views.push_back({angleStatistics(degrees), asColor(Output::normal, expected),
                                 asColor(Output::normal, drawn), heatMap(degrees, drawn.width, drawn.height)});
        for (const float d : degrees)
            all_.add(d);
    }

    // The same for a bake: the high surface itself is shown, and pixels with another surface are magenta.
    void add(const Image& expected, const Image& drawn, const SeenHigh& seen)
    {
        constexpr std::uint8_t kOtherColor[4] = {255, 0, 255, 255};
        add(expected, drawn);
        ComparedView& view = result_.views.back();
        view.expected = asColor(Output::normal, seen.normals);
        view.others = seen.others;
        view.pixels = seen.compared;
        for (std::size_t i = 0; i < seen.other.size(); ++i)
            if (seen.other[i])
                std::copy_n(kOtherColor, 4, view.difference.bytes8() + 4 * i);
        result_.others += seen.others;
        result_.pixels += seen.compared;
    }

    ComparedViews finish()
    {
        result_.all = all_.statistics();
        return std::move(result_);
    }

private:
    ComparedViews result_;
    AngleCounter all_;
};

// kConversionViews of them.
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

// ---- one model against another -------------------------------------------------------------

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

// ---- a bake against what it was made from ---------------------------------------------------

bool showsHighSurface(const ComparedViews& compared)
{
    constexpr double kMaxOthers = 0.01; // of a view's pixels
    return std::none_of(compared.views.begin(), compared.views.end(), [](const ComparedView& view) {
        return double(view.others) > kMaxOthers * double(view.pixels);
    });
}

Result<ComparedViews> verifyBake(Renderer& renderer, const BakeToVerify& bake, int side)
{
    if (bake.material < -1 || bake.material >= int(bake.scene.materials.size()))
        return usageError(fmt::format("verify: expected a material from -1 to {}; found {}",
                                      int(bake.scene.materials.size()) - 1, bake.material));
    constexpr double kQuarter = 1.5707963; // radians
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

// ---- one frame against another -------------------------------------------------------------

namespace {

Result<Image> drawn(Renderer& renderer, View view, Frame frame, Output output)
{
    view.frame = frame;
    view.output = output;
    return renderer.draw(view);
}

std::string verdictOf(double tOpposed, double bOpposed)
{
    if (std::isnan(tOpposed) || std::isnan(bOpposed))
        return "no pixel has tangents of both frames: nothing was compared";
    if (tOpposed < 0.02 && bOpposed < 0.02)
        return "tangents and bitangents point the same way";
    if (tOpposed < 0.02 && bOpposed > 0.98)
        return "bitangents are reversed everywhere: TANGENT.w is inverted";
    return fmt::format("tangents are reversed on {:.1f} % and bitangents on {:.1f} % of the pixels", tOpposed * 100,
                       bOpposed * 100);
}

} // namespace

bool showsNormalMaps(const Scene& scene, const View& view) { return drawsNormalMaps(scene) && view.normalMaps; }

Result<ComparedFrames> compareFrames(Renderer& renderer, const Scene& scene, View view, std::array<Frame, 2> frames)
{
    std::array<Image, 2> shaded, normal, tangent, bitangent;
    for (std::size_t k = 0; k < 2; ++k)
        for (auto [output, images] : {std::pair(Output::shaded, &shaded),
                                      {Output::normal, &normal},
                                      {Output::tangent, &tangent},
                                      {Output::bitangent, &bitangent}}) {
            auto picture = drawn(renderer, view, frames[k], output);
            if (!picture)
                return picture.error();
            (*images)[k] = std::move(*picture);
        }
    ComparedFrames compared;
    compared.mapped = showsNormalMaps(scene, view);
    const auto degrees = mappedAngles(anglesBetween(normal[0], normal[1]), compared.mapped);
    compared.normals = angleStatistics(degrees);
    compared.difference = heatMap(degrees, view.width, view.height);
    compared.tangentsOpposed = shareOpposed(anglesBetween(tangent[0], tangent[1]));
    compared.bitangentsOpposed = shareOpposed(anglesBetween(bitangent[0], bitangent[1]));
    compared.verdict = verdictOf(compared.tangentsOpposed, compared.bitangentsOpposed);
    compared.shaded = std::move(shaded);
    return compared;
}

std::string toText(const ComparedFrames& c)
{
    return c.mapped ? toText(c.normals) : fmt::format("nothing was compared: {}", kNoNormalMap);
}

Result<FrameError> errorAgainstExact(Renderer& renderer, const Scene& scene, View view)
{
    const auto normals = drawn(renderer, view, view.frame, Output::normal);
    if (!normals)
        return normals.error();
    const auto exact = drawn(renderer, view, Frame::exact, Output::normal);
    if (!exact)
        return exact.error();
    const auto degrees = mappedAngles(anglesBetween(*normals, *exact), showsNormalMaps(scene, view));
    return FrameError{angleStatistics(degrees), heatMap(degrees, view.width, view.height)};
}

} // namespace cotan
