// Interactive camera motion. The camera's target is the pivot. All functions keep the camera usable: the eye is apart
// from the target, all numbers are finite, and `up` is not parallel to the view direction.
#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "cotan/scene.hpp"

namespace cotan::viewer {

// Orbits around the pivot, in radians: right about the vertical, and up to almost straight up or down.
void orbit(Camera& camera, float right, float upward);

// Turns eye, pivot and up about the vertical through `point`, in radians, as `orbit` turns right.
void turnAbout(Camera& camera, const glm::vec3& point, float right);

// Moves eye and pivot parallel to the view plane, so that points at the pivot's depth follow the pointer. delta:
// pointer motion in pixels, y downwards; size: of the image.
void pan(Camera& camera, glm::vec2 delta, glm::ivec2 size);

// Zooms in (factor below 1) or out, keeping the point at the pivot's depth under the pointer in place.
void zoomTo(Camera& camera, float factor, glm::vec2 pointer, glm::ivec2 size);

// `look` rotates the view about the eye, in radians; `fly` moves eye and pivot: world units right, up, forwards.
void look(Camera& camera, float right, float upward);
void fly(Camera& camera, glm::vec3 by);

// Makes `point` the pivot. A perspective camera rotates towards it; an orthographic camera moves instead.
void setPivot(Camera& camera, const glm::vec3& point);

// Views the pivot from front, back, left, right, top or bottom at the current distance. False for other words.
bool viewFrom(Camera& camera, const std::string& side);

// Switches the projection, keeping the apparent size at the pivot.
void setOrthographic(Camera& camera, bool orthographic);

// Projects a point: x and y in pixels from the top left corner of the image; z is the depth along the view in world
// units, 0 or less if the point is not in front of the eye.
glm::vec3 projectToImage(const Camera& camera, const glm::vec3& point, glm::ivec2 size);

// Height of a pixel in world units at the given depth.
float unitsOfPixel(const Camera& camera, float depth, glm::ivec2 size);

} // namespace cotan::viewer
