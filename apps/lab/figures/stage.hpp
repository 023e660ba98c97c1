// Scenes, lights and cameras that the figures share, and pictures made of pictures.
#pragma once

#include <vector>

#include "cotan/scene.hpp"
#include "figure_renderer.hpp"

namespace cotan::figures {

// One mesh with one material, whose normal map is `map`. Level 0 only and no averaging, so that what
// is drawn can be compared with the map's mathematics at each pixel.
Scene sceneOf(Mesh mesh, Image map, Material material);

// A rough dielectric, or a metal, of that colour.
Material dielectric(glm::vec3 linearColor, float roughness);
Material metal(glm::vec3 linearColor, float roughness);

// The scene with the vertex attributes that the frame reads.
Scene withVertexFrames(Scene scene, Frame frame);

void scaleTexcoords(Mesh& mesh, float u, float v);

// From the upper left, in front; and from behind, as is natural over a floor.
Light upperLeft();
Light behindLeft();

// Looks along -z at the origin, orthographic; extent: world units from bottom to top.
Camera frontal(float extent);

// A panel's view: Blinn-Phong, upperLeft(), no shadows.
View squareView(const FigureRenderer& studio, const Camera& camera);
View wideView(const FigureRenderer& studio, const Camera& camera);

// Draws `inset` into the lower right corner of `picture`, with a frame around it. Both unorm8.
void pasteInset(Image& picture, const Image& inset);

// |a - b| * factor per channel, opaque. Both unorm8, of one size.
Image differenceOf(const Image& a, const Image& b, int factor);

// The mean over pixels of the largest channel's |a - b|, in levels of 255, and the largest of all.
struct Levels {
    double mean = 0;
    int maximum = 0;
};
Levels levelsBetween(const Image& a, const Image& b);

// All pictures in a grid with so many columns, each shrunk to fit a cell, on grey.
Image contactSheet(const std::vector<const Image*>& pictures, int columns, int cellWidth, int cellHeight);

} // namespace cotan::figures
