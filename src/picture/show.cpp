// What of a model a picture shows: light, a vector, an inspection, an error.
#include "core/named_values.hpp"
#include "cotan/inspect.hpp"
#include "cotan/picture.hpp"
#include "inspect/angles.hpp"

namespace cotan {

namespace {

constexpr Named<Output> kShows[] = {{"shaded", Output::shaded},   {"normal", Output::normal},
                                    {"tangent", Output::tangent}, {"bitangent", Output::bitangent},
                                    {"uv", Output::uv},           {"depth", Output::depth},
                                    {"error", Output::normal}};

} // namespace

const std::vector<std::string>& showNames()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = wordsOf(kShows);
        all.insert(all.end(), inspectionNames().begin(), inspectionNames().end());
        return all;
    }();
    return names;
}

Output outputOf(const std::string& show) { return valueOf(kShows, show).value_or(Output::shaded); }

Result<Image> drawShow(Renderer& renderer, const Scene& scene, View view, const std::string& show, bool floats,
                       const std::function<void(const AngleStatistics&)>& error)
{
    view.output = outputOf(show);
    if (inspectionFromName(show))
        return renderer.draw(inspectionView(view));
    if (show == "error") {
        auto found = errorAgainstExact(renderer, scene, view);
        if (!found)
            return found.error();
        if (error)
            error(found->degrees);
        return std::move(found->difference);
    }
    view.linearOutput = show == "shaded" && floats;
    auto image = renderer.draw(view);
    if (image && show != "shaded" && !floats)
        return asColor(view.output, *image);
    return image;
}

Status layEdges(Renderer& renderer, View view, const PictureOptions& options, std::span<const SurfaceEdge> edges,
                Image& picture)
{
    if (options.edges == Edges::none || picture.type != PixelType::unorm8)
        return Done{};
    view.output = Output::depth;
    const auto depth = renderer.draw(view);
    if (!depth)
        return depth.error();
    drawEdges(picture, *depth, view.camera, edges, {options.edges != Edges::seams, options.edges != Edges::triangles});
    return Done{};
}

} // namespace cotan
