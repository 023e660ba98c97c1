// A quad with one material, for tests of materials.
#pragma once

#include "models.hpp"

namespace cotan::test {

// A quad in the xy plane with skewed, mirrored uv and a one-texel map whose normal is tilted.
inline Scene tiltedQuad()
{
    Scene scene;
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.positions.push_back({p, 0});
        mesh.normals.push_back({0, 0, 1});
        mesh.texcoords[0].push_back({0.5f - 0.4f * p.x + 0.1f * p.y, 0.5f - 0.45f * p.y});
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"", 0, glm::mat4(1)});
    scene.materials.emplace_back();
    Image image = makeImage(1, 1, PixelType::unorm8);
    const int texel[] = {128 + 25, 128 + 40, 128 + 117, 255}; // tilted by 22 degrees
    for (int c = 0; c < 4; ++c)
        image.bytes8()[c] = std::uint8_t(texel[c]);
    scene.images.push_back(image);
    return scene;
}

inline View quadView(Frame frame)
{
    View view = frontView({-1, -1}, {1, 1}, 16);
    view.output = Output::shaded;
    view.linearOutput = true;
    view.samples = 1;
    view.environment = view.background = view.shadows = false;
    view.frame = frame;
    view.lights = {Light{}};
    view.lights[0].direction = glm::normalize(glm::vec3(-0.3f, 0.2f, -1));
    return view;
}

inline double redAt(const Image& image, int x, int y)
{
    return image.floats()[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4];
}

} // namespace cotan::test
