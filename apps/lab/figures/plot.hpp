// Images of formulas: surfaces of which every point is known, drawn on the CPU without a mesh or a material.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "figure.hpp"

namespace cotan::figures {

// What an image is drawn by: Cotan's text, the form that is usual elsewhere, or the mathematics of the surface.
enum class By { cotan, usual, truth };

// Towards the light of these images: from the upper left in front.
glm::dvec3 plotLight();

// A diffuse surface with a highlight. n, v: unit, v to the eye. Returns linear colour.
glm::dvec3 plotShade(glm::dvec3 n, glm::dvec3 v, glm::dvec3 color);

// The point of the unit sphere around the middle that the eye sees at a point of the image; beside the sphere, its rim.
glm::dvec3 onSphere(glm::dvec2 at);

// Draws a square image, four samples a pixel. color: linear, at a point from -1 to 1 with y up.
Image plot(int side, const std::function<glm::dvec3(glm::dvec2 at)>& color);

// Returns the values, without those that are missing, at a grid of points that does not depend on the size of an image.
std::vector<float> plotValues(const std::function<std::optional<double>(glm::dvec2 at)>& value);

// A direction at points of an image, by each method.
struct PlottedDirection {
    std::string cotan, usual; // labels
    std::function<glm::dvec3(By, glm::dvec2 at)> color;
    std::function<std::optional<glm::dvec3>(By, glm::dvec2 at)> direction; // nothing: not measured
};

// Adds an image for each method, and the errors of "cotan" and "usual" against the truth.
void plotDirections(Figure& figure, int side, const PlottedDirection& plotted);

} // namespace cotan::figures
