// Coarse meshes: frames that are constant per triangle compared with frames averaged at the vertices.
#include <fmt/format.h>

#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

constexpr float kRepeatU = 4, kRepeatV = 2;
constexpr int kSegments = 12;

} // namespace

Figure makeFacetingFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Faceting on coarse meshes";
    figure.text = {fmt::format(
        "A sphere of {} by {} segments. The gradients of u and v are constant in a triangle, so the frame "
        "cotangent jumps at edges: facets. So does triangle, which has the same directions without screen "
        "derivatives. Cotangents averaged at the vertices (smooth) do not, and keep stretch and skew. MikkTSpace is "
        "smooth too, but orthonormal: wrong wherever the texture shrinks with latitude. The facets halve with each "
        "doubling of the mesh; the orthonormal error stays.",
        kSegments, kSegments / 2)};
    figure.measured =
        "Angles to the analytic normals of the round sphere at the same texture coordinates, within 75 degrees "
        "of the equator.";
    const View view = squareView(studio, frontal(2.05f));
    const Height waves = [](double u, double v) { return relief(Relief::waves, u, v); };
    const Image map = heightMap16(waves, 512);
    std::vector<Panel> heats;
    for (Frame frame : {Frame::cotangent, Frame::smooth, Frame::mikktspace, Frame::triangle}) {
        for (int segments : {kSegments, 4 * kSegments}) {
            Mesh mesh = makeSphere(1, segments);
            scaleTexcoords(mesh, kRepeatU, kRepeatV);
            const Scene scene =
                withVertexFrames(sceneOf(std::move(mesh), map, dielectric({0.03f, 0.09f, 0.2f}, 0.32f)), frame);
            studio.show(scene);
            const Image uv = studio.vectors(view, frame, Output::uv);
            const Image truth = truthNormals(uv, waves, sphereChart({kRepeatU, kRepeatV}));
            Compared c = compareNormals(studio.normals(view, frame), truth);
            figure.measures.push_back({fmt::format("{}, {} segments", name(frame), segments), c.degrees});
            if (segments != kSegments)
                continue;
            const std::string label(name(frame));
            figure.panels.push_back({label, label, "", studio.shaded(view, frame)});
            heats.push_back({label + "-error", label + ": error",
                             "Black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees.", std::move(c.heat)});
        }
    }
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
        addError(figure, i, fmt::format("{}, {} segments", figure.panels[i].label, kSegments));
    figure.panels.insert(figure.panels.end(), heats.begin(), heats.end());
    figure.sliders = {{0, 1}, {2, 1}, {3, 0}};
    figure.overview = {0, 1};
    return figure;
}

} // namespace cotan::figures
