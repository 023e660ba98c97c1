// Scenes, lights and cameras shared by the figures, and functions that combine images.
#pragma once

#include <vector>

#include "cotan/scene.hpp"
#include "figure_renderer.hpp"

namespace cotan::figures {

// A scene of one mesh with one material, whose normal map is `map`. Without mips and averaging, so that each pixel can
// be compared with the mathematical surface.
Scene sceneOf(Mesh mesh, Image map, Material material);

// A rough dielectric or metal of the given colour.
Material dielectric(glm::vec3 linearColor, float roughness);
Material metal(glm::vec3 linearColor, float roughness);

// Returns the scene with the vertex attributes that the frame reads.
Scene withVertexFrames(Scene scene, Frame frame);

void scaleTexcoords(Mesh& mesh, float u, float v);

// Lights from the upper left in front, and from the upper left behind, as is natural over a floor.
Light upperLeft();
Light behindLeft();

// An orthographic camera that looks along -z at the origin. extent: world units from bottom to top.
Camera frontal(float extent);

// Views of a panel: Blinn-Phong, upperLeft(), no shadows.
View squareView(const FigureRenderer& studio, const Camera& camera);
View wideView(const FigureRenderer& studio, const Camera& camera);

// Draws `inset` with a frame around it into the lower right corner of `image`. Both are unorm8.
void pasteInset(Image& image, const Image& inset);

// All images in a grid with `columns` columns on grey, each shrunk to fit a cell.
Image contactSheet(const std::vector<const Image*>& images, int columns, int cellWidth, int cellHeight);

} // namespace cotan::figures
