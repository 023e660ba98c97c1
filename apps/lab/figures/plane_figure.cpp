// Figure 2.6.5 of the 2006 chapter: the error of leaving out the inverse transpose, and its cause.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/portable.hpp"
#include "cotan/vector.hpp"
#include "figure.hpp"
#include "inspect/angles.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

constexpr float kRotation = 30; // rotation of the texture on the plane, degrees
constexpr float kTilt = 60;     // tilt of the orthographic plane, degrees

// Rotates the texture on the surface.
void rotateTexture(Texture& texture, float degrees)
{
    const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    texture.uRow = {c, -s, 0};
    texture.vRow = {s, c, 0};
}

Scene planeScene(Mesh mesh, const glm::mat4& toWorld)
{
    Scene scene = sceneOf(std::move(mesh), makeReliefMap(Relief::domes, 512), dielectric({0.045f, 0.09f, 0.17f}, 0.4f));
    rotateTexture(scene.materials[0].normalMap, kRotation);
    scene.materials[0].normalMap.sampler.mip = MipFilter::linear; // the plane runs to the horizon
    scene.instances[0].toWorld = toWorld;
    return scene;
}

// One unit above the floor, looking 45 degrees down: the view reaches from nearly straight down to near the horizon.
Camera lowCamera()
{
    Camera camera;
    camera.eye = {0, 1, 0};
    camera.target = {0, 0, -1};
    camera.verticalFieldOfView = glm::radians(80.0f);
    return camera;
}

View planeView(const FigureRenderer& studio, const Camera& camera)
{
    View view = wideView(studio, camera);
    view.environment = false; // the sky reflected in the floor would hide the dots
    Light fill;
    fill.intensity = 0.9f;
    view.lights = {behindLeft(), fill};
    view.lights[0].intensity = 5;
    return view;
}

// Statistics of the angles at pixels with nearest <= depth < farthest.
AngleStatistics withinDepth(std::vector<float> degrees, const Image& depth, float nearest, float farthest)
{
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const float d = depth.floats()[4 * i];
        if (d < nearest || d >= farthest)
            degrees[i] = -1;
    }
    return angleStatistics(degrees);
}

// Angles between both frames on a plane tilted about the x axis under an orthographic camera, for a texel tilted by 35
// degrees, over its azimuths and the rotations of the texture. Evaluates the formulas alone, without drawing.
AngleStatistics sweep(double tilt)
{
    using Vec3 = glm::dvec3;
    constexpr int kSteps = 72;
    constexpr double kDegree = std::numbers::pi / 180, kMapTilt = 35 * kDegree;
    const Vec3 along(1, 0, 0), up(0, std::cos(tilt * kDegree), std::sin(tilt * kDegree));
    const Vec3 n = glm::cross(along, up);
    const Vec3 dpdx = along, dpdy = up / up.y; // one pixel to the right, one pixel up
    std::vector<float> degrees;
    for (int rotation = 0; rotation < kSteps; ++rotation) {
        const double a = (rotation + 0.5) * 2 * std::numbers::pi / kSteps;
        const Vec3 u = along * std::cos(a) + up * std::sin(a), v = up * std::cos(a) - along * std::sin(a);
        const glm::dvec2 duvdx(glm::dot(u, dpdx), glm::dot(v, dpdx)), duvdy(glm::dot(u, dpdy), glm::dot(v, dpdy));
        const auto right = evaluate(Frame::paperTranspose, n, dpdx, dpdy, duvdx, duvdy);
        const auto shortened = evaluate(Frame::paperOrthogonal, n, dpdx, dpdy, duvdx, duvdy);
        for (int azimuth = 0; azimuth < kSteps; ++azimuth) {
            const double b = (azimuth + 0.5) * 2 * std::numbers::pi / kSteps;
            const Vec3 m(std::sin(kMapTilt) * std::cos(b), std::sin(kMapTilt) * std::sin(b), std::cos(kMapTilt));
            const Vec3 p = f64::cotan_apply(right, m), q = f64::cotan_apply(shortened, m);
            degrees.push_back(float(angleBetween(p, q) / kDegree));
        }
    }
    return angleStatistics(degrees);
}

// Draws both frames and the angles between them; returns the angles.
std::vector<float> addTriple(FigureRenderer& studio, const View& view, const std::string& file, const std::string& what,
                             Figure& figure)
{
    figure.panels.push_back({file + "-transpose", what + ", (A) paper-transpose", "Two crosses: the inverse transpose.",
                             studio.shaded(view, Frame::paperTranspose)});
    figure.panels.push_back({file + "-orthogonal", what + ", (B) paper-orthogonal",
                             "Edges instead of their perpendiculars.", studio.shaded(view, Frame::paperOrthogonal)});
    std::vector<float> degrees =
        anglesBetween(studio.normals(view, Frame::paperTranspose), studio.normals(view, Frame::paperOrthogonal));
    figure.panels.push_back({file + "-angle", what + ", angle between (A) and (B)",
                             "Black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees.",
                             heatMap(degrees, view.width, view.height)});
    return degrees;
}

} // namespace

Figure makePlaneFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "2.6.5: foreshortening, not perspective";
    figure.text = {
        "The last optimisation of the chapter assumes that the matrix of the edges is orthogonal and omits the inverse "
        "transpose. On a plane in perspective the two agree in part of the foreground and part towards the horizon: "
        "highlights slide off the dots and their relief flattens. (Far away the angles shrink again, because there the "
        "filtered map is flat.)",
        "The chapter attributes this to perspective. The second plane is drawn without: an orthographic camera, the "
        "plane tilted by 60 degrees. The error is the same on every dot, and as large. What breaks the shortcut is "
        "foreshortening; it is exact only where the surface faces the camera."};
    figure.measured =
        "Angles between paper-transpose, which is right here, and paper-orthogonal. The texture is rotated by "
        "30 degrees. Rows by tilt: the formulas alone, a texel tilted by 35 degrees, over all azimuths and rotations "
        "of the texture.";

    const Scene floor = planeScene(makePlane(80, 40, 80), glm::mat4(1));
    studio.show(floor);
    const View perspective = planeView(studio, lowCamera());
    const auto degrees = addTriple(studio, perspective, "perspective", "Perspective", figure);
    const Image depth = studio.vectors(perspective, Frame::exact, Output::depth);
    figure.measures.push_back({"perspective, depth up to 1.2 eye heights", withinDepth(degrees, depth, 0, 1.2f)});
    figure.measures.push_back({"perspective, 1.2 to 3", withinDepth(degrees, depth, 1.2f, 3)});
    figure.measures.push_back({"perspective, 3 and more", withinDepth(degrees, depth, 3, 1e9f)});

    Mesh patch = makePatch(1, 0, false, 1);
    scaleTexcoords(patch, 4, 4);
    const glm::mat4 tilted =
        glm::scale(glm::rotate(glm::mat4(1), glm::radians(-kTilt), glm::vec3(1, 0, 0)), glm::vec3(4));
    const Scene plane = planeScene(std::move(patch), tilted);
    studio.show(plane);
    const View orthographic = planeView(studio, frontal(1.3f));
    const auto tiltDegrees = addTriple(studio, orthographic, "orthographic", "Orthographic, tilted 60 degrees", figure);
    figure.measures.push_back({"orthographic, 60 degrees, as drawn", angleStatistics(tiltDegrees)});
    for (int tilt : {0, 10, 20, 30, 45, 60, 70, 80})
        figure.measures.push_back({fmt::format("orthographic, {} degrees, formula", tilt), sweep(tilt)});
    addError(figure, 1, "perspective, 1.2 to 3", "Error at depths of 1.2 to 3 eye heights");
    addError(figure, 4, "orthographic, 60 degrees, as drawn", "Error");
    figure.sliders = {{0, 1}, {3, 4}};
    return figure;
}

} // namespace cotan::figures
