// Figure 2.6.3 of the 2006 chapter: the teapot, with its nozzle magnified.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

constexpr int kPatchSegments = 24; // per patch, of the teapot that is drawn
constexpr int kTruthSegments = 64; // per patch, of the teapot that gives the true normals

// Stripes and circular spots, as on the chapter's teapot: vertical ridges in the upper half of the map, rows of domes
// in the lower half, which is at the nozzle.
HeightSample spotsAndStripes(double u, double v)
{
    v -= std::floor(v);
    if (v >= 0.5)
        return relief(Relief::domes, u, v);
    constexpr double kStripes = 8, kAmplitude = 0.012;
    // Fades in and out over a sixteenth of the map, so that there is no step at the edges of the half.
    const double k = 2 * std::numbers::pi * kStripes, t = v * 2;
    const double edge = std::min(t, 1 - t) * 8, s = std::min(edge, 1.0);
    const double fade = s * s * (3 - 2 * s);
    const double fadeV = edge < 1 ? 6 * s * (1 - s) * 16 * (t < 0.5 ? 1 : -1) : 0;
    return {kAmplitude * fade * std::cos(k * u), -kAmplitude * fade * k * std::sin(k * u),
            kAmplitude * fadeV * std::cos(k * u)};
}

Scene teapotScene(int segments, const Image& map)
{
    Mesh mesh = makeTeapot(segments);
    scaleTexcoords(mesh, 2, 1);
    Scene scene = sceneOf(std::move(mesh), map, dielectric({0.16f, 0.075f, 0.035f}, 0.36f));
    scene.materials[0].doubleSided = true; // the spout is open
    scene.materials[0].normalMap.sampler.mip = MipFilter::linear;
    return scene;
}

Camera wholeCamera()
{
    Camera camera;
    camera.eye = {1.6f, 1.5f, 3.9f};
    camera.target = {0.32f, 0.33f, 0};
    camera.verticalFieldOfView = glm::radians(23.0f);
    return camera;
}

Camera nozzleCamera()
{
    Camera camera = wholeCamera();
    camera.target = {0.95f, 0.71f, 0};
    camera.verticalFieldOfView = glm::radians(3.5f);
    return camera;
}

struct Pair {
    View whole, nozzle;
};

Pair viewsOf(const FigureRenderer& studio)
{
    Pair views{wideView(studio, wholeCamera()), wideView(studio, nozzleCamera())};
    views.nozzle.width = studio.width() * 9 / 20;
    views.nozzle.height = studio.height() * 9 / 20;
    return views;
}

// The teapot with the magnified nozzle in the corner.
Image withInset(FigureRenderer& studio, const Pair& views, Frame frame)
{
    Image image = studio.shaded(views.whole, frame);
    pasteInset(image, studio.shaded(views.nozzle, frame));
    return image;
}

} // namespace

Figure makeTeapotFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "2.6.3: the teapot, vertex frames against per-pixel frames";
    figure.text = {
        "The same teapot, map and light. (A) takes orthonormal frames from tangents stored at the vertices, (B) makes "
        "the frame in the pixel. On the belly the texture is nearly square and the two look alike. At the nozzle, in "
        "the inset, it is squashed and sheared: in (A) the spots are lit from a wrong side; in (B) every spot is lit "
        "from the side of the light.",
        fmt::format("Both are drawn with {} segments per patch. The ground truth is the normal on the same teapot with "
                    "{} segments per patch and the gradients of each triangle (frame exact).",
                    kPatchSegments, kTruthSegments)};
    figure.measured = "Angles to the normals of the fine teapot, away from its outline. The largest are where one part "
                      "hides another.";

    const Pair views = viewsOf(studio);
    const Image map = heightMap16(spotsAndStripes, 512);
    const Scene fine = teapotScene(kTruthSegments, map);
    studio.show(fine);
    const Image truthWhole = studio.normals(views.whole, Frame::exact);
    const Image truthNozzle = studio.normals(views.nozzle, Frame::exact);

    const Scene coarse = withVertexFrames(teapotScene(kPatchSegments, map), Frame::vertex);
    studio.show(coarse);
    std::vector<Panel> heats;
    for (const auto& [frame, file, label] :
         {std::tuple(Frame::vertex, "a-vertex", "(A) orthonormal frames at the vertices"),
          std::tuple(Frame::cotangent, "b-cotangent", "(B) frames in the pixel")}) {
        figure.panels.push_back({file, label, fmt::format("Frame {}.", name(frame)), withInset(studio, views, frame)});
        Compared whole = compareInterior(studio.normals(views.whole, frame), truthWhole);
        const Compared nozzle = compareInterior(studio.normals(views.nozzle, frame), truthNozzle);
        pasteInset(whole.heat, nozzle.heat);
        heats.push_back({std::string(file) + "-error", std::string(label) + ": error",
                         "Black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees.", whole.heat});
        figure.measures.push_back({fmt::format("{}, whole teapot", name(frame)), whole.degrees});
        figure.measures.push_back({fmt::format("{}, inset at the nozzle", name(frame)), nozzle.degrees});
    }
    figure.panels.insert(figure.panels.end(), heats.begin(), heats.end());
    for (const auto& [panel, frame] : {std::pair<std::size_t, Frame>(0, Frame::vertex), {1, Frame::cotangent}}) {
        addError(figure, panel, fmt::format("{}, whole teapot", name(frame)), "Error of the whole");
        addError(figure, panel, fmt::format("{}, inset at the nozzle", name(frame)), "Error of the inset");
    }
    figure.sliders = {{0, 1}, {2, 3}};
    return figure;
}

} // namespace cotan::figures
