#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/scene.hpp"
#include "cotan/view.hpp"
#include "grid.hpp"

namespace cotan {

namespace {

constexpr int kMapSide = 512;

struct Look {
    const char* name;
    Relief relief;
    glm::vec3 color; // linear
    float metallic, roughness;
};

// Adds a mesh with its material and its one instance: turned about the vertical, scaled, moved to `place`.
void addShape(Scene& scene, Mesh mesh, const Look& look, glm::vec3 place, float degrees = 0, float scale = 1)
{
    mesh.material = static_cast<int>(scene.materials.size());
    Material& material = scene.materials.emplace_back();
    material.name = look.name;
    material.baseColor = glm::vec4(look.color, 1);
    material.metallic = look.metallic;
    material.roughness = look.roughness;
    material.normalMap.image = static_cast<int>(look.relief); // images are in the order of Relief
    glm::mat4 toWorld = glm::translate(glm::mat4(1), place);
    toWorld = glm::rotate(toWorld, glm::radians(degrees), glm::vec3(0, 1, 0));
    toWorld = glm::scale(toWorld, glm::vec3(scale));
    scene.instances.push_back({mesh.name, static_cast<int>(scene.meshes.size()), toWorld});
    scene.meshes.push_back(std::move(mesh));
}

// A sphere whose right half (seen with u = 1/2 in front) shows the left half's image mirrored, as artists do to save
// texture space. `segments` must be even, so that a column of vertices lies on the mirror line.
Mesh makeMirroredSphere(float radius, int segments, float repeatU, float repeatV)
{
    Mesh mesh = makeSphere(radius, segments);
    for (glm::vec2& uv : mesh.texcoords[0]) {
        const float u = uv.x > 0.5f ? 1 - uv.x : uv.x;
        uv = {u * repeatU, uv.y * repeatV};
    }
    return mesh;
}

// A still life on a table that is not there: what it stands on, and what is behind it, are the ground and the backdrop
// of whoever draws it.
void addShapes(Scene& scene)
{
    Mesh teapot = makeTeapot(16);
    scaleTexcoords(teapot, 2, 2);
    addShape(scene, std::move(teapot), {"copper", Relief::domes, {0.90f, 0.45f, 0.30f}, 1, 0.36f}, {0, 0, 0.25f}, -24,
             1.45f);
    scene.materials.back().normalScale = 0.55f;
    scene.materials.back().doubleSided = true; // the spout is open
    Mesh panel = makePatch(2, 0.7f, /*mirrored*/ false, 1);
    scaleTexcoords(panel, 2, 2);
    addShape(scene, std::move(panel), {"teal tile", Relief::domes, {0.02f, 0.15f, 0.16f}, 0, 0.38f},
             {-1.35f, 0.95f, -1.35f}, 16, 1.9f);
    scene.materials.back().doubleSided = true; // a sheet without a back
    addShape(scene, makeCube(0.9f, 1), {"slate", Relief::bricks, {0.10f, 0.105f, 0.115f}, 0, 0.5f},
             {1.72f, 0.45f, -0.85f}, -30);
    addShape(scene, makeMirroredSphere(0.48f, 96, 4, 2), {"gold", Relief::domes, {1.0f, 0.76f, 0.33f}, 1, 0.40f},
             {1.72f, 1.38f, -0.85f}, -6);
    addShape(scene, makeTorus(0.42f, 0.18f, 96, 6, 2.5f),
             {"coral glaze", Relief::waves, {0.55f, 0.10f, 0.065f}, 0, 0.34f}, {-1.5f, 0.18f, 1.0f});
}

} // namespace

Scene builtinScene()
{
    Scene scene;
    scene.name = "built-in";
    for (const Relief kind : {Relief::domes, Relief::bricks, Relief::waves})
        scene.images.push_back(makeReliefMap(kind, kMapSide));
    addShapes(scene);
    const glm::vec3 fromUpperLeft = glm::normalize(glm::vec3(0.66f, -0.85f, -0.62f)); // and from the front
    scene.lights.push_back({.color = {1.0f, 0.985f, 0.96f}, .intensity = 3, .direction = fromUpperLeft});
    scene.cameras.push_back({.name = "front",
                             .verticalFieldOfView = glm::radians(19.0f),
                             .eye = {0.55f, 2.5f, 8.9f},
                             .target = {0.02f, 0.84f, 0}});
    return scene;
}

Scene shapeScene(const std::string& shape)
{
    Scene scene;
    scene.name = shape;
    Mesh mesh;
    if (shape == "sphere") {
        mesh = makeSphere(1, 128);
        scaleTexcoords(mesh, 2, 1); // texels about as wide as they are high
    } else if (shape == "torus") {
        mesh = makeTorus(0.8f, 0.35f, 128, 6, 2.5f);
    } else if (shape == "teapot") {
        mesh = makeTeapot(12);
    } else {
        mesh = makePatch(1, 0, /*mirrored*/ false, 1);
    }
    Material& material = scene.materials.emplace_back();
    material.name = "white plastic";
    material.baseColor = {0.6f, 0.6f, 0.6f, 1};
    material.metallic = 0;
    material.roughness = 0.4f;
    material.doubleSided = true; // a sheet has a back, a spout is open
    glm::mat4 toWorld(1);
    if (shape != "sphere" && shape != "torus")
        toWorld = glm::scale(toWorld, glm::vec3(2));
    scene.instances.push_back({shape, 0, toWorld});
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

} // namespace cotan
