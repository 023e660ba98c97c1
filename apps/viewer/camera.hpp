// How a hand moves a camera. Its target is the pivot. All of them keep a camera usable: the eye off the target, numbers
// finite, `up` across the view.
#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "cotan/scene.hpp"

namespace cotan::viewer {

// Around the pivot: radians to the right about the vertical, and upwards, up to a hair from straight up and down.
void orbit(Camera& camera, float right, float upward);

// Moves eye and pivot across the view so that what is at the pivot's depth goes along with the pointer. delta: of the
// pointer, pixels, y downwards; size: of the picture.
void pan(Camera& camera, glm::vec2 delta, glm::ivec2 size);

// Goes nearer (factor below 1) or away so that what is at the pivot's depth under the pointer stays there.
void zoomTo(Camera& camera, float factor, glm::vec2 pointer, glm::ivec2 size);

// Turns the view about the eye, and moves both through the scene: world units to the right, upwards, forwards.
void look(Camera& camera, float right, float upward);
void fly(Camera& camera, glm::vec3 by);

// The point of the ray nearest to what was clicked becomes the pivot; the eye stays and turns towards it.
void setPivot(Camera& camera, const glm::vec3& point);

// From one of front, back, left, right, top, bottom, at the distance that it has. False for other words.
bool seeFrom(Camera& camera, const std::string& side);

// The other projection, with what is at the pivot as large as before.
void setOrthographic(Camera& camera, bool orthographic);

// Where a point is on the picture, in pixels from the top left corner; z: its depth along the view, world units, and
// 0 or less where it is not before the eye.
glm::vec3 onPicture(const Camera& camera, const glm::vec3& point, glm::ivec2 size);

// World units that a pixel is high at that depth.
float unitsOfPixel(const Camera& camera, float depth, glm::ivec2 size);

} // namespace cotan::viewer
