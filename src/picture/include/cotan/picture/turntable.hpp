// A model that turns once around the vertical, while camera, light and ground stay as they are.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene/scene.hpp"

namespace cotan {

// Points around all that a scene covers while it turns about the vertical through the middle of its box: for
// Scene::reach, so that one camera frames all of it. Circles of 32 points at 33 heights, up to 0.5 % too wide and each
// as wide as its slice of the height. Empty for a scene without finite points.
std::vector<glm::vec3> sweptPoints(const Scene& scene);

// Where the instances of a scene stand, and how they stand when it has turned.
class Turntable {
public:
    explicit Turntable(const Scene& scene); // as it stands now

    // Places the instances of that scene: turned counter-clockwise by so many degrees, as seen from above. Lights and
    // cameras stay.
    void turn(Scene& scene, double degrees) const;

private:
    std::vector<glm::mat4> places_;
    glm::dvec3 middle_{0};
};

} // namespace cotan
