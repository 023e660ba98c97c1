// A stored tangent at one corner of a triangle, against the texture coordinates: what lint takes its shares of.
#pragma once

#include <cstddef>

#include "cotan/surface/mapped_surface.hpp"

namespace cotan {

struct StoredCorner {
    bool compared = false; // there is a tangent and a dP/du to hold it against
    bool reversed = false; // w points against +v
    double degrees = 0;    // from dP/du, in the plane of the normal; 180 where the tangent has no direction there
};

// surface: with uv. Nothing is compared where the triangle's uv have no area.
StoredCorner storedCorner(const MappedSurface& surface, std::size_t triangle, std::size_t corner);

} // namespace cotan
