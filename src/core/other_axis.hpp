// An axis that is not parallel to a given vector, for cross products and projections.
#pragma once

#include <cmath>

namespace cotan {

// Returns the x or the y axis, at an angle of at least 44 degrees to n, a unit vector of float or double.
template<class Vector> Vector otherAxis(const Vector& n)
{
    using Number = typename Vector::value_type;
    return std::abs(n.x) < Number(0.7) ? Vector(1, 0, 0) : Vector(0, 1, 0);
}

} // namespace cotan
