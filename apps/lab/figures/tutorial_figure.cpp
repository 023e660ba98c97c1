// The classic tutorial scene: a normal-mapped floor, step by step, and the two spaces to compute lighting in.
#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "figure.hpp"
#include "stage.hpp"
#include "tangent_space.hpp"

namespace cotan::figures {

namespace {

void addShape(Scene& scene, Mesh mesh, Material material, glm::vec3 position, bool mapped)
{
    if (mapped)
        material.normalMap.image = 0;
    mesh.material = int(scene.materials.size());
    scene.instances.push_back({mesh.name, int(scene.meshes.size()), glm::translate(glm::mat4(1), position)});
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back(std::move(mesh));
}

// A brick floor with a few shapes on it; the coarse ball has a normal map too.
Scene tutorialScene()
{
    Scene scene;
    scene.name = "tutorial";
    scene.images.push_back(makeReliefMap(Relief::bricks, 512));
    addShape(scene, makePlane(12, 6, 8), dielectric({0.16f, 0.065f, 0.04f}, 0.45f), {0, 0, 0}, true);
    scene.materials.back().normalScale = 1.6f;
    Mesh ball = makeSphere(0.6f, 12);
    scaleTexcoords(ball, 2, 1);
    addShape(scene, std::move(ball), dielectric({0.10f, 0.12f, 0.06f}, 0.4f), {-0.75f, 0.6f, 0.2f}, true);
    addShape(scene, makeCube(0.8f, 1), dielectric({0.05f, 0.09f, 0.18f}, 0.4f), {0.85f, 0.4f, -0.5f}, false);
    addShape(scene, makeTorus(0.32f, 0.12f, 48, 1, 1), dielectric({0.20f, 0.14f, 0.03f}, 0.35f), {0.55f, 0.12f, 0.95f},
             false);
    return scene;
}

View tutorialView(const FigureRenderer& studio)
{
    Camera camera;
    camera.eye = {0.6f, 1.7f, 4.2f};
    camera.target = {0, 0.38f, 0};
    camera.verticalFieldOfView = glm::radians(33.0f);
    View view = wideView(studio, camera);
    Light sun = upperLeft();
    sun.direction = glm::normalize(glm::vec3(0.7f, -0.6f, 0.15f));
    sun.intensity = 2.4f;
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position = {1.9f, 0.7f, 1.4f};
    lamp.color = {1, 0.8f, 0.55f};
    lamp.intensity = 1.6f;
    view.lights = {sun, lamp};
    view.shadows = true;
    return view;
}

std::string levelsText(const Levels& levels)
{
    return fmt::format("Against world space: {:.3f} levels of 255 on average, {} at most.", levels.mean,
                       levels.maximum);
}

} // namespace

Figure makeTutorialFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "The tutorial scene: map, shadows, and where to light";
    figure.text = {"A floor with one normal map: first with interpolated normals, then with the map, then with "
                   "shadows. The sun "
                   "comes from the left, a lamp is at the lower right.",
                   "Tutorials transform light and view vectors to tangent space by t, b and n at each vertex and light "
                   "the map's normal "
                   "there; the frame per pixel transforms the normal to world space instead. On the floor, flat and "
                   "square, both are the "
                   "same up to rounding. On the coarse ball the interpolated vectors are wrong. Transformed in each "
                   "pixel by the inverse of an "
                   "orthonormal frame they agree with world space everywhere; with the frame cotangent they do not on "
                   "the ball, whose "
                   "texture is not square: that frame does not preserve angles, so those in tangent space are not "
                   "those of the world.",
                   "The images in tangent space come from the reference renderer, and are compared with its image "
                   "in world space."};
    const Scene scene = withVertexFrames(tutorialScene(), Frame::vertex);
    studio.show(scene);
    View view = tutorialView(studio);
    View bare = view;
    bare.normalMaps = false;
    bare.shadows = false;
    figure.panels.push_back({"a-no-map", "no map, no shadows", "", studio.shaded(bare, Frame::cotangent)});
    bare.normalMaps = true;
    figure.panels.push_back({"b-map", "with the map", "Frame cotangent.", studio.shaded(bare, Frame::cotangent)});
    figure.panels.push_back(
        {"c-shadows", "with map and shadows", "Frame cotangent.", studio.shaded(view, Frame::cotangent)});
    figure.sliders = {{0, 1}, {1, 2}};
    figure.overview = {0, 2};

    const struct {
        reference::LightSpace space;
        Frame frame;
        const char *file, *label;
    } carried[] = {
        {tangentSpaceOfVertices(), Frame::vertex, "d-tangent-vertex", "tangent space, vectors from the vertices"},
        {tangentSpaceOfPixels(), Frame::vertex, "e-tangent-pixel", "tangent space, vectors by the pixel's inverse"},
        {tangentSpaceOfPixels(), Frame::cotangent, "f-tangent-pixel-cotangent", "the same with the frame cotangent"}};
    std::vector<Panel> differences;
    for (const auto& row : carried) {
        view.frame = row.frame;
        const Image world = studio.drawReference(view);
        Image image = studio.drawReference(view, row.space);
        const Levels levels = levelsBetween(world, image);
        differences.push_back({std::string(row.file) + "-difference", std::string(row.label) + ": difference, 16 times",
                               levelsText(levels), differenceOf(world, image, 16)});
        figure.panels.push_back({row.file, row.label, fmt::format("Frame {}.", name(row.frame)), std::move(image)});
        figure.numbers.push_back({std::string(row.label) + ", mean levels of 255", levels.mean});
        figure.numbers.push_back({std::string(row.label) + ", most levels of 255", double(levels.maximum)});
    }
    figure.panels.insert(figure.panels.end(), differences.begin(), differences.end());
    return figure;
}

} // namespace cotan::figures
