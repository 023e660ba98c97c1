#include "cotan/inspect.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/try.hpp"
#include "inspect/angles.hpp"
#include "scene/geometry.hpp"
#include "scene/parts.hpp"

namespace cotan {

namespace {

// The angles if a normal map is drawn; otherwise none, because frames do not affect the normals.
std::vector<float> mappedAngles(std::vector<float> degrees, bool mapped)
{
    if (!mapped)
        degrees.assign(degrees.size(), -1.0f);
    return degrees;
}

std::vector<Camera> camerasAround(const Scene& scene, int side)
{
    const Camera fit = fitCamera(bounds(scene), side, side);
    std::vector<Camera> cameras = {fit};
    for (int k = 1; k < kConversionViews - 1; ++k)
        cameras.push_back(orbitedCamera(fit, float(std::numbers::pi) / 2 * float(k)));
    Camera above = fit;
    above.eye = fit.target + glm::vec3(0, glm::length(glm::dvec3(fit.eye - fit.target)), 0);
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
    View view;
    view.width = view.height = side;
    view.setFrame(model.frame);
    view.output = Output::normal;
    for (const Camera& camera : sides.cameras) {
        view.camera = camera;
        COTAN_CHECK(limitCoverage(model.scene, view));
    }
    const auto forget = [](Renderer* drawing) { drawing->forget(); }; // the scene is destroyed on return
    const std::unique_ptr<Renderer, decltype(forget)> guard(&renderer, forget);
    COTAN_CHECK(renderer.load(model.scene));
    for (const Camera& camera : sides.cameras) {
        view.camera = camera;
        COTAN_TRY(image, renderer.draw(view));
        sides.normals.push_back(std::move(*image));
    }
    return sides;
}

Result<ComparedViews> compareSides(const DrawnSides& before, const DrawnSides& after)
{
    if (before.normals.size() != after.normals.size())
        return usageError(fmt::format("verify: expected as many images after as before, {}; found {}",
                                      before.normals.size(), after.normals.size()));
    ComparedViews compared;
    compared.mapped = before.mapped || after.mapped;
    AngleCounter all;
    for (std::size_t k = 0; k < before.normals.size(); ++k) {
        const Image &a = before.normals[k], &b = after.normals[k];
        if (a.width != b.width || a.height != b.height)
            return usageError(fmt::format("verify: expected images of the same size, {} x {}; found {} x {}", a.width,
                                          a.height, b.width, b.height));
        const std::vector<float> degrees = mappedAngles(interiorAngles(a, b), compared.mapped);
        compared.views.push_back({angleStatistics(degrees), asColor(Output::normal, a), asColor(Output::normal, b),
                                  heatMap(degrees, b.width, b.height)});
        for (const float d : degrees)
            all.add(d);
    }
    compared.all = all.statistics();
    return compared;
}

Result<ComparedViews> verifyConversion(Renderer& renderer, ModelInFrame before, ModelInFrame after, int side)
{
    COTAN_TRY(first, drawSides(renderer, std::move(before), {}, side));
    COTAN_TRY(second, drawSides(renderer, std::move(after), first->cameras, side));
    return compareSides(*first, *second);
}

// ---- one frame against another -------------------------------------------------------------

namespace {

Result<Image> drawn(Renderer& renderer, View view, std::optional<Frame> frame, Output output)
{
    view.setFrame(frame);
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

Result<ComparedFrames> compareFrames(Renderer& renderer, const Scene& scene, View view,
                                     std::array<std::optional<Frame>, 2> frames)
{
    std::array<Image, 2> shaded, normal, tangent, bitangent;
    for (std::size_t k = 0; k < 2; ++k)
        for (auto [output, images] : {std::pair(Output::shaded, &shaded),
                                      {Output::normal, &normal},
                                      {Output::tangent, &tangent},
                                      {Output::bitangent, &bitangent}}) {
            COTAN_TRY(image, drawn(renderer, view, frames[k], output));
            (*images)[k] = std::move(*image);
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

Result<FrameError> errorAgainst(Frame meant, Renderer& renderer, const Scene& scene, View view)
{
    view.output = Output::normal;
    COTAN_TRY(normals, renderer.draw(view));
    COTAN_TRY(truth, drawn(renderer, view, meant, Output::normal));
    const auto degrees = mappedAngles(anglesBetween(*normals, *truth), showsNormalMaps(scene, view));
    return FrameError{angleStatistics(degrees), heatMap(degrees, view.width, view.height)};
}

} // namespace cotan
