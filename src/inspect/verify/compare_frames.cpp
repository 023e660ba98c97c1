#include "cotan/inspect.hpp"

#include <cmath>

#include <fmt/format.h>

#include "compare_views.hpp"
#include "inspect/angles.hpp"
#include "scene/geometry.hpp"

namespace cotan {

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
