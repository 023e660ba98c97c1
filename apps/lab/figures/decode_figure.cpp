// Decoding of normal maps: the encoding of zero, two channels, and the direction of green.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/portable.hpp"
#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

Image flatMap()
{
    Image image = makeImage(4, 4, PixelType::unorm8, "flat");
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.bytes8()[i] = i % 4 < 2 ? 128 : 255;
    return image;
}

// An upright mirror of two charts side by side; v runs down on the left one and up on the right one.
Scene mirrorScene(Expansion expansion)
{
    Scene scene = sceneOf(makePatch(1, 0, false, 1), flatMap(), metal({0.9f, 0.9f, 0.9f}, 0));
    scene.materials[0].normalFormat.expansion = expansion;
    scene.instances[0].toWorld = glm::translate(glm::mat4(1), glm::vec3(-0.5f, 0, 0));
    scene.meshes.push_back(scene.meshes[0]);
    for (glm::vec2& uv : scene.meshes[1].texcoords[0])
        uv.y = -uv.y;
    scene.instances.push_back({"", 1, glm::translate(glm::mat4(1), glm::vec3(0.5f, 0, 0))});
    return scene;
}

// Looks straight into the mirror, which reflects the horizon of the environment. There are no other lights.
View mirrorView(const FigureRenderer& studio)
{
    Camera camera;
    camera.eye = {0, 0, 3};
    camera.verticalFieldOfView = glm::radians(14.0f);
    View view = wideView(studio, camera);
    view.shading = Shading::pbr;
    view.lights.clear();
    return view;
}

Scene domeScene(Image map, Channels channels, bool greenUp)
{
    Mesh mesh = makePatch(1, 0, false, 1);
    Scene scene = sceneOf(std::move(mesh), std::move(map), dielectric({0.06f, 0.12f, 0.07f}, 0.38f));
    scene.materials[0].normalFormat.channels = channels;
    scene.materials[0].normalFormat.greenUp = greenUp;
    return scene;
}

constexpr std::array<float, 3> kUpright{0, 0, 1};

void addMirrors(FigureRenderer& studio, Figure& figure)
{
    const View view = mirrorView(studio);
    const Scene biased = mirrorScene(Expansion::biased), exact = mirrorScene(Expansion::exact);
    studio.show(exact);
    Image exactImage = studio.shaded(view, Frame::cotangent);
    const Image exactNormals = studio.normals(view, Frame::cotangent);
    Image plain = exactNormals; // (0,0,1) on the whole mirror
    for (std::size_t i = 0; i < plain.pixelCount(); ++i)
        std::copy_n(kUpright.begin(), 3, plain.floats() + 4 * i);
    studio.show(biased);
    Image biasedImage = studio.shaded(view, Frame::cotangent);
    figure.measures.push_back(
        {"flat texel 128, biased", compareNormals(studio.normals(view, Frame::cotangent), plain).degrees});
    figure.measures.push_back({"flat texel 128, exact", compareNormals(exactNormals, plain).degrees});
    Image difference = differenceOf(biasedImage, exactImage, 8);
    figure.panels.push_back(
        {"a-biased", "2c - 1", "Each half tilts its own way: the horizon breaks.", std::move(biasedImage)});
    figure.panels.push_back({"b-exact", "(255c - 128)/127", "128 is zero: flat is flat.", std::move(exactImage)});
    figure.panels.push_back({"c-difference", "difference of the two, 8 times", "", std::move(difference)});
}

void addDomes(FigureRenderer& studio, Figure& figure)
{
    const View view = squareView(studio, frontal(1));
    const Image map = makeReliefMap(Relief::domes, 512);
    const struct {
        Channels channels;
        bool greenUp;
        const char *file, *label, *caption;
    } rows[] = {
        {Channels::xyz, true, "d-three-channels", "three channels, green up", "As the map was made."},
        {Channels::orthographic, true, "e-two-channels", "two channels", "Blue is not read; z comes from x and y."},
        {Channels::xyz, false, "f-green-wrong", "green the wrong way",
         "The same map read as green down: lit from the lower left, or dents."}};
    Image truth;
    for (const auto& row : rows) {
        const Scene scene = domeScene(map, row.channels, row.greenUp);
        studio.show(scene);
        if (truth.data.empty())
            truth = truthNormals(studio.vectors(view, Frame::exact, Output::uv), domeHeight(),
                                 patchChart(1, 0, false, 1), 5);
        figure.panels.push_back({row.file, row.label, row.caption, studio.shaded(view, Frame::cotangent)});
        figure.measures.push_back({row.label, compareNormals(studio.normals(view, Frame::cotangent), truth).degrees});
    }
}

} // namespace

Figure makeDecodeFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Decoding: zero, two channels, green";
    figure.text = {
        "A flat mirror whose normal map is the flat texel (128, 128, 255) everywhere. Read as 2c - 1 no byte is zero: "
        "the mirror "
        "tilts by 0.32 degrees, the reflection by twice that. The right half's texture coordinates are mirrored, so "
        "it tilts "
        "the other way, and the horizon in the mirror breaks in the middle. Read as (255c - 128)/127, 128 is zero.",
        "Below, an 8-bit map of domes: with all three channels; with x and y only, z from unit length; and with green "
        "read the wrong "
        "way, which reverses the light on slopes that face up or down."};
    figure.measured = "Angles to the analytic normals; domes where they tilt by at least 5 degrees, 8-bit map.";
    addMirrors(studio, figure);
    addDomes(studio, figure);
    addError(figure, 0, "flat texel 128, biased");
    addError(figure, 1, "flat texel 128, exact");
    for (std::size_t i = 3; i < figure.panels.size(); ++i)
        addError(figure, i, figure.panels[i].label);
    figure.sliders = {{0, 1}, {5, 3}};
    return figure;
}

} // namespace cotan::figures
