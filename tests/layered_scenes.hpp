// Hand-made translucent scenes with their analytic composites, for the tests of both renderers.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "cotan/view.hpp"

namespace cotan::layers {

using Draw = std::function<Image(const Scene&, const View&)>;

// Rounding of the float sums below and of 1 - alpha for at most 64 layers.
constexpr float kTolerance = 2e-5f;

// One world unit per pixel: the centre of pixel (x, y) is at (x - 31.5, 15.5 - y).
inline View flatView(int samples = 4)
{
    View view;
    view.width = 64;
    view.height = 32;
    view.samples = samples;
    view.camera.eye = {0, 0, 50};
    view.camera.orthographic = true;
    view.camera.verticalExtent = 32;
    view.linearOutput = true;
    view.background = false;
    view.environment = false;
    return view;
}

// A parallelogram seen from +z with uv (0,0) at `corner`.
struct Pane {
    glm::vec3 corner{-20, 10, 0};
    glm::vec3 alongU{40, 0, 0};
    glm::vec3 alongV{0, -20, 0};
    glm::vec4 color{1};
};

inline void append(Mesh& mesh, const Pane& pane)
{
    const auto first = std::uint32_t(mesh.positions.size());
    for (int i = 0; i < 4; ++i) {
        const float u = float(i & 1), v = float(i >> 1);
        mesh.positions.push_back(pane.corner + pane.alongU * u + pane.alongV * v);
        mesh.normals.push_back({0, 0, 1});
        mesh.texcoords[0].push_back({u, v});
        mesh.colors.push_back(pane.color);
    }
    for (const std::uint32_t i : {0u, 2u, 1u, 1u, 2u, 3u})
        mesh.indices.push_back(first + i);
}

inline int addMaterial(Scene& scene, AlphaMode mode)
{
    Material m;
    m.unlit = true;
    m.doubleSided = true;
    m.alphaMode = mode;
    scene.materials.push_back(m);
    return int(scene.materials.size()) - 1;
}

inline int addMesh(Scene& scene, Mesh mesh, int material)
{
    mesh.material = material;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"", int(scene.meshes.size()) - 1, glm::mat4(1)});
    return material;
}

inline int addPane(Scene& scene, const Pane& pane, AlphaMode mode = AlphaMode::blend)
{
    Mesh mesh;
    append(mesh, pane);
    return addMesh(scene, std::move(mesh), addMaterial(scene, mode));
}

inline glm::vec4 at(const Image& image, int x, int y)
{
    const float* p = image.floats() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return {p[0], p[1], p[2], p[3]};
}

inline void expectNear(glm::vec4 found, glm::vec4 expected, const char* what, float tolerance = kTolerance)
{
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(found[c], expected[c], tolerance) << what << ", channel " << c;
}

// Composite of the colours, nearest first, by Porter and Duff's `over`; the result is premultiplied.
inline glm::vec4 over(const std::vector<glm::vec4>& nearestFirst)
{
    glm::dvec4 sum(0);
    for (const glm::vec4& c : nearestFirst) {
        const double transmittance = 1 - sum.w;
        sum += glm::dvec4(double(c.x) * double(c.w), double(c.y) * double(c.w), double(c.z) * double(c.w), double(c.w))
            * transmittance;
    }
    return glm::vec4(sum);
}

// A colour that differs in every channel, with alpha between 0.1 and 0.7.
inline glm::vec4 colorOf(int i)
{
    return {float((i * 37 + 11) % 97) / 96, float((i * 53 + 5) % 89) / 88, float((i * 71 + 29) % 83) / 82,
            0.1f + 0.6f * float((i * 7) % 11) / 10};
}

// Draws `count` panes half a unit apart, listed out of order, in one mesh or each in its own.
inline void manyPanesComposeInTheOrderOfDistance(const Draw& draw, int count)
{
    std::vector<glm::vec4> nearestFirst;
    std::vector<Pane> panes;
    for (int i = 0; i < count; ++i) {
        Pane pane;
        pane.corner.z = -0.5f * float(i);
        pane.color = colorOf(i);
        nearestFirst.push_back(pane.color);
        panes.push_back(pane);
    }
    for (const bool oneMesh : {false, true})
        for (const int samples : {1, 4}) {
            Scene scene;
            Mesh all;
            for (int k = 0; k < count; ++k) {
                const Pane& pane = panes[std::size_t((k * 7 + 3) % count)]; // no count is a multiple of 7
                if (oneMesh)
                    append(all, pane);
                else
                    addPane(scene, pane);
            }
            if (oneMesh)
                addMesh(scene, all, addMaterial(scene, AlphaMode::blend));
            const Image image = draw(scene, flatView(samples));
            for (const auto& [x, y] : {std::pair{32, 16}, {14, 7}, {49, 23}})
                expectNear(at(image, x, y), over(nearestFirst), oneMesh ? "one mesh" : "own meshes");
            EXPECT_EQ(at(image, 2, 2), glm::vec4(0));
        }
}

inline void opaqueTexelsHideLayersBehindThem(const Draw& draw)
{
    Scene scene;
    Pane front, back;
    back.corner.z = -5;
    back.color = {0, 1, 0, 0.5f};
    const int pierced = addPane(scene, front); // listed first: drawn before the surface that it hides
    addPane(scene, back);
    Image texels = makeImage(2, 1, PixelType::float32);
    const float values[8] = {1, 0, 0, 1, 0, 0, 1, 0.25f};
    std::copy(values, values + 8, texels.floats());
    scene.images.push_back(texels);
    scene.materials[std::size_t(pierced)].baseColorMap.image = 0;
    View view = flatView();
    view.pointSampled = true;
    const Image image = draw(scene, view);
    expectNear(at(image, 20, 12), {1, 0, 0, 1}, "alpha 1");
    expectNear(at(image, 44, 12), over({{0, 0, 1, 0.25f}, {0, 1, 0, 0.5f}}), "alpha 0.25");
}

// Draws two panes that cross in the line x = 0.5, which runs through the centre of column 32: two of its four samples
// are on either side.
inline void crossingPanesChangeTheirOrderInsideAPixel(const Draw& draw)
{
    const glm::vec4 red(1, 0, 0, 0.5f), green(0, 1, 0, 0.75f);
    Pane a, b;
    a.corner = {-19.5f, 10, -20};
    a.alongU = {40, 0, 40}; // near on the right
    a.color = red;
    b.corner = {-19.5f, 10, 20};
    b.alongU = {40, 0, -40}; // near on the left
    b.color = green;
    for (const bool oneMesh : {false, true}) {
        Scene scene;
        Mesh both;
        append(both, a);
        append(both, b);
        if (oneMesh) {
            addMesh(scene, both, addMaterial(scene, AlphaMode::blend));
        } else {
            addPane(scene, a);
            addPane(scene, b);
        }
        const Image image = draw(scene, flatView());
        expectNear(at(image, 31, 9), over({green, red}), "left of the line");
        expectNear(at(image, 33, 9), over({red, green}), "right of the line");
        expectNear(at(image, 32, 9), (over({green, red}) + over({red, green})) * 0.5f, "on the line");
    }
}

// Draws an opaque pane that crosses a translucent one. At the crossing it hides the layer at two of four samples, on
// one side everywhere, and on the other side it is visible behind the layer.
inline void opaqueSurfacesHideLayersBehindThem(const Draw& draw)
{
    const glm::vec4 red(1, 0, 0, 0.5f), white(1, 1, 1, 1);
    Pane layer, wall;
    layer.color = red;
    wall.corner = {-19.5f, 10, 20};
    wall.alongU = {40, 0, -40}; // in front of the layer left of x = 0.5
    for (const bool wallFirst : {false, true}) {
        Scene scene;
        if (wallFirst)
            addPane(scene, wall, AlphaMode::opaque);
        addPane(scene, layer);
        if (!wallFirst)
            addPane(scene, wall, AlphaMode::opaque);
        const Image image = draw(scene, flatView());
        expectNear(at(image, 31, 20), white, "hidden");
        expectNear(at(image, 33, 20), over({red, white}), "before the wall");
        expectNear(at(image, 32, 20), (white + over({red, white})) * 0.5f, "on the line");
    }
    Scene glass; // opaque by its alpha mode, and listed before the surface that hides it
    addPane(glass, layer, AlphaMode::opaque);
    glass.materials[0].transmission.strength = 1;
    addPane(glass, wall, AlphaMode::opaque);
    expectNear(at(draw(glass, flatView()), 31, 20), white, "glass, hidden");
}

// Draws two layers that meet at half a pixel: each covers two of the four samples, and they do not mix.
inline void layersCoverTheirOwnSamplesOnly(const Draw& draw)
{
    const glm::vec4 red(1, 0, 0, 0.5f), green(0, 1, 0, 0.75f);
    Pane left, right;
    left.corner = {-19.5f, 10, 0};
    left.alongU = {20, 0, 0}; // to x = 0.5
    left.color = red;
    right.corner = {0.5f, 10, -3};
    right.alongU = {20, 0, 0};
    right.color = green;
    Scene scene;
    addPane(scene, right);
    addPane(scene, left);
    const Image image = draw(scene, flatView());
    expectNear(at(image, 31, 16), over({red}), "left");
    expectNear(at(image, 33, 16), over({green}), "right");
    expectNear(at(image, 32, 16), (over({red}) + over({green})) * 0.5f, "the column where they meet");
    expectNear(at(image, 12, 16), over({red}) * 0.5f, "the left border");
}

// Draws two layers at equal distance: the later one in the scene, or in its mesh, is in front.
inline void laterOfEquallyFarLayersIsInFront(const Draw& draw)
{
    const glm::vec4 red(1, 0, 0, 0.5f), green(0, 1, 0, 0.75f);
    Pane first, second;
    first.color = red;
    second.color = green;
    Scene scene;
    addPane(scene, first);
    addPane(scene, second);
    expectNear(at(draw(scene, flatView()), 30, 18), over({green, red}), "instances");
    scene = {};
    Mesh both;
    append(both, first);
    append(both, second);
    addMesh(scene, both, addMaterial(scene, AlphaMode::blend));
    expectNear(at(draw(scene, flatView()), 30, 18), over({green, red}), "one mesh");
}

// Draws two layers in perspective, from the front and from behind, with rows running downward and upward.
inline void perspectiveAndRowsUpwardKeepTheOrder(const Draw& draw)
{
    const glm::vec4 red(1, 0, 0, 0.5f), green(0, 1, 0, 0.75f);
    for (const bool behind : {false, true})
        for (const bool rowsUpward : {false, true}) {
            Scene scene;
            Pane a, b;
            a.corner = {-20, 10, 4};
            a.alongV = {0, -9, 0}; // only the upper half
            a.color = red;
            b.color = green;
            addPane(scene, a);
            addPane(scene, b);
            View view = flatView();
            view.camera.orthographic = false;
            view.camera.eye.z = behind ? -50.0f : 50.0f;
            view.rowsUpward = rowsUpward;
            const Image image = draw(scene, view);
            expectNear(at(image, 30, 12), behind ? over({green, red}) : over({red, green}), "upper half");
            expectNear(at(image, 30, 19), over({green}), "lower half");
        }
}

// Every output but the shaded image shows the nearest surface whose alpha is at least 1/255.
inline void dataOutputsShowTheNearestLayer(const Draw& draw)
{
    Scene scene;
    for (const auto& [z, alpha] : {std::pair{0.0f, 1.0f}, {5.0f, 0.1f}, {9.0f, 0.003f}, {3.0f, 0.9f}}) {
        Pane pane;
        pane.corner.z = z;
        pane.color.w = alpha;
        addPane(scene, pane);
    }
    View view = flatView();
    view.output = Output::depth;
    EXPECT_NEAR(at(draw(scene, view), 32, 16).x, 45, 1e-4f); // the layer at 5; the one at 9 has alpha below 1/255
    view.output = Output::normal;
    EXPECT_EQ(at(draw(scene, view), 32, 16), glm::vec4(0, 0, 1, 1));
}

// Draws a caster above a lit floor that blocks the fraction `stopped` of the light. 0 and 1 are exact; between them the
// result is a mean of nine texels that are each covered or not.
inline void casterAboveAFloor(const Draw& draw, AlphaMode mode, float alpha, float cutoff, float stopped,
                              const char* what, float transmission = 0)
{
    Scene scene;
    Pane floor, caster;
    addPane(scene, floor, AlphaMode::opaque);
    caster.corner = {-14, 6, 8};
    caster.alongU = {8, 0, 0};
    caster.alongV = {0, -8, 0};
    caster.color = {0, 0, 0, alpha};
    addPane(scene, caster, mode);
    scene.materials[1].alphaCutoff = cutoff;
    scene.materials[1].transmission.strength = transmission;
    scene.materials[0].unlit = false;
    scene.materials[0].metallic = 0;
    View view = flatView();
    Light light;
    light.direction = glm::normalize(glm::vec3(1, 0, -0.5f)); // the shadow is 16 units to the right
    view.lights.push_back(light);
    const Image with = draw(scene, view);
    view.shadows = false;
    const Image without = draw(scene, view);
    const glm::vec4 full = at(without, 38, 14); // below the centre of the shadow, which covers x from 2 to 10
    EXPECT_GT(full.x, 0.1f) << what;
    const float grain = stopped > 0 && stopped < 1 ? 0.12f : 0;
    EXPECT_NEAR(at(with, 38, 14).x / full.x, 1 - stopped, grain) << what;
    EXPECT_EQ(at(with, 50, 14), at(without, 50, 14)) << what << ": beside the shadow";
    EXPECT_EQ(at(with, 38, 24), at(without, 38, 24)) << what << ": below the shadow";
}

inline void castersShadowByTheirMaterial(const Draw& draw)
{
    casterAboveAFloor(draw, AlphaMode::opaque, 0.2f, 0.5f, 1, "opaque, whatever its alpha");
    casterAboveAFloor(draw, AlphaMode::mask, 0.25f, 0.25f, 1, "masked, alpha at its cutoff");
    casterAboveAFloor(draw, AlphaMode::mask, 0.25f, 0.2502f, 0, "masked, alpha below its cutoff");
    casterAboveAFloor(draw, AlphaMode::blend, 0.7f, 0.5f, 0.7f, "blended");
    casterAboveAFloor(draw, AlphaMode::blend, 0.2f, 0.5f, 0.2f, "blended below the cutoff of a mask");
    casterAboveAFloor(draw, AlphaMode::blend, 0.0f, 0.5f, 0, "blended with alpha 0");
    casterAboveAFloor(draw, AlphaMode::blend, 1.0f, 0.5f, 1, "blended with alpha 1");
    casterAboveAFloor(draw, AlphaMode::opaque, 1.0f, 0.5f, 0, "transmissive", 1);
    casterAboveAFloor(draw, AlphaMode::blend, 1.0f, 0.5f, 0, "transmissive and blended", 1);
}

} // namespace cotan::layers
