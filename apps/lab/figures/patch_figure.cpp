// Figure 2.6.4 of the 2006 chapter: embossed dots with square, stretched and sheared texture.
#include <fmt/format.h>

#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

// With integer stretches and shears of 0 or 1, every layout shows only whole dots or parts that complete one another,
// so that means over the image equal those over one dot.
constexpr double kRepeat = 1.5;
constexpr double kMinTilt = 5; // degrees: the flat ground between the dots would lower the mean

struct PatchLayout {
    const char* name;
    float stretch, shear;
    bool mirrored;
};

Scene patchScene(const PatchLayout& layout, const Image& map)
{
    Mesh mesh = makePatch(layout.stretch, layout.shear, layout.mirrored, 1);
    scaleTexcoords(mesh, kRepeat, kRepeat);
    return sceneOf(std::move(mesh), map, dielectric({0.045f, 0.09f, 0.17f}, 0.36f));
}

// Measures the angles between the normals that each frame draws and the analytic ones, for one layout.
void measureLayout(FigureRenderer& studio, const PatchLayout& layout, const View& view, Figure& figure)
{
    const Image uv = studio.vectors(view, Frame::exact, Output::uv);
    const Image truth =
        truthNormals(uv, domeHeight(), patchChart(layout.stretch, layout.shear, layout.mirrored, kRepeat), kMinTilt);
    for (Frame frame : {Frame::orthonormal, Frame::unit, Frame::cotangent})
        figure.measures.push_back({fmt::format("{}, {}", layout.name, name(frame)),
                                   compareNormals(studio.normals(view, frame), truth).degrees});
}

} // namespace

Figure makePatchFigure(FigureRenderer& studio)
{
    constexpr PatchLayout kSquare{"square", 1, 0, false}, kSheared{"stretched 2:1 and sheared", 2, 1, false};
    Figure figure;
    figure.title = "2.6.4: the square patch assumption";
    figure.text = {
        "Embossed dots, lit from the upper left, on one flat patch seen from the front. Where the texture lies "
        "square on the patch every frame is right. Stretched 2:1 and sheared by 45 degrees in texture coordinates, "
        "an orthonormal frame still tilts each normal as if the dots were round: highlights leave the light's "
        "side of the dots. The general frame follows the gradients of u and v. With t and b each at unit length "
        "the frame follows the shear but not the stretch: slightly wrong where sheared, as the chapter says; "
        "on pure stretch as wrong as the orthonormal frame."};
    figure.measured = "Angles to the analytic normals, over pixels tilted by at least 5 degrees. Flat, orthographic, "
                      "16-bit map.";
    const Image map = heightMap16(domeHeight(), 512);
    const View view = squareView(studio, frontal(1));

    const Scene square = patchScene(kSquare, map);
    studio.show(square);
    figure.panels.push_back({"a-square", "(A) square patch", "", studio.shaded(view, Frame::orthonormal)});
    const Scene sheared = patchScene(kSheared, map);
    studio.show(sheared);
    figure.panels.push_back(
        {"b-orthonormal", "(B) orthonormal frame", "Frame orthonormal.", studio.shaded(view, Frame::orthonormal)});
    figure.panels.push_back(
        {"c-general", "(C) general frame", "Frame cotangent.", studio.shaded(view, Frame::cotangent)});
    figure.panels.push_back({"d-unit", "(D) unit-length frame", "Frame unit.", studio.shaded(view, Frame::unit)});
    figure.sliders = {{1, 2}, {3, 2}};
    figure.overview = {1, 2};

    for (const PatchLayout& layout :
         {kSquare, PatchLayout{"stretched 2:1", 2, 0, false}, PatchLayout{"stretched 4:1", 4, 0, false},
          PatchLayout{"sheared 45 degrees", 1, 1, false}, kSheared, PatchLayout{"mirrored", 1, 0, true}}) {
        const Scene scene = patchScene(layout, map);
        studio.show(scene);
        measureLayout(studio, layout, view, figure);
    }
    addError(figure, 0, "square, orthonormal");
    addError(figure, 1, fmt::format("{}, orthonormal", kSheared.name));
    addError(figure, 2, fmt::format("{}, cotangent", kSheared.name));
    addError(figure, 3, fmt::format("{}, unit", kSheared.name));
    return figure;
}

} // namespace cotan::figures
