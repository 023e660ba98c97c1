// Small scenes and pixel accessors for the tests of the Vulkan renderer.
#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <gtest/gtest.h>

#include "cotan/frame.hpp"
#include "cotan/render.hpp"
#include "render/shared_device.hpp"

namespace cotan::rendertest {

// Mesa's CPU driver compiles a shader for each kind of image, which takes most of the time of these tests; a third of
// that is optimisation, useless for 64 x 64 pixels. The driver reads the variable when it starts.
inline const bool kQuicklyCompiled = ::setenv("GALLIVM_PERF", "nopt", /*replace*/ 0) == 0;

// Opens a renderer, or skips the test with the reason.
#define COTAN_RENDERER_OR_SKIP(name, ...)                                                                              \
    const Result<std::unique_ptr<Renderer>> name##Result = openVulkanRenderer(__VA_ARGS__);                            \
    if (!name##Result)                                                                                                 \
        GTEST_SKIP() << name##Result.error().message;                                                                  \
    Renderer& name = **name##Result

inline double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    // Uses sine and cosine: acos alone cannot resolve small angles.
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29577951308232;
}

inline glm::vec4 floatPixel(const Image& image, int x, int y)
{
    const std::size_t i = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
    const float* p = image.floats() + 4 * i;
    return {p[0], p[1], p[2], p[3]};
}

inline const std::uint8_t* bytePixel(const Image& image, int x, int y)
{
    return image.bytes8() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
}

inline bool allFinite(const Image& image)
{
    if (image.type != PixelType::float32)
        return true;
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        if (!std::isfinite(image.floats()[i]))
            return false;
    return true;
}

// A float image of one colour.
inline Image flatImage(glm::vec4 color, int size = 2)
{
    Image image = makeImage(size, size, PixelType::float32);
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        for (int c = 0; c < 4; ++c)
            image.floats()[4 * i + std::size_t(c)] = color[c];
    return image;
}

// Stored float texel of the tangent-space vector m (along +u, along green, outwards): 0.5 is zero.
inline glm::vec4 texelOf(glm::vec3 m) { return glm::vec4(glm::normalize(m) * 0.5f + 0.5f, 1.0f); }

// A quad in the xy plane, -1 to 1, facing +z; uv = uv0 + du * x + dv * y.
inline Mesh quad(glm::vec2 du = {0.5f, 0}, glm::vec2 dv = {0, -0.5f}, glm::vec2 uv0 = {0.5f, 0.5f})
{
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.positions.push_back({p, 0});
        mesh.normals.push_back({0, 0, 1});
        mesh.texcoords[0].push_back(uv0 + du * p.x + dv * p.y);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

inline Mesh sphere(int segments)
{
    Mesh mesh;
    const int columns = 2 * segments;
    for (int j = 0; j <= segments; ++j)
        for (int i = 0; i <= columns; ++i) {
            const float u = float(i) / float(columns);
            const float v = float(j) / float(segments);
            const float a = u * 6.2831853f;
            const float b = v * 3.1415927f;
            const glm::vec3 p(std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a));
            mesh.positions.push_back(p);
            mesh.normals.push_back(p);
            mesh.texcoords[0].push_back({u, v});
        }
    for (int j = 0; j < segments; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto a = std::uint32_t(j * (columns + 1) + i);
            const std::uint32_t c = a + std::uint32_t(columns) + 1;
            for (const std::uint32_t k : {a, c, a + 1, a + 1, c, c + 1})
                mesh.indices.push_back(k);
        }
    return mesh;
}

// One mesh, one material, one instance; `normalMap`, if given, is the material's normal map.
inline Scene sceneOf(Mesh mesh, std::optional<Image> normalMap = std::nullopt, glm::mat4 toWorld = glm::mat4(1))
{
    Scene scene;
    Material material;
    material.metallic = 0;
    if (normalMap) {
        scene.images.push_back(std::move(*normalMap));
        material.normalMap.image = 0;
    }
    scene.materials.push_back(material);
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"it", 0, toWorld});
    return scene;
}

// A small view from the front.
inline View viewOf(Output output, Frame frame = Frame::cotangent)
{
    View view;
    view.width = 64;
    view.height = 64;
    view.camera.eye = {0, 0, 3};
    view.output = output;
    view.frame = frame;
    return view;
}

inline Image drawn(Renderer& renderer, const View& view)
{
    Result<Image> image = renderer.draw(view);
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return makeImage(view.width, view.height, PixelType::float32);
    }
    return *std::move(image);
}

inline void load(Renderer& renderer, const Scene& scene)
{
    const Status status = renderer.load(scene);
    ASSERT_TRUE(status) << status.error().message;
}

} // namespace cotan::rendertest
