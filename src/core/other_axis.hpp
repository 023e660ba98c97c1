// A direction that is not along another one, as crossing and projecting need it.
#pragma once

#include <cmath>

namespace cotan {

// x or y, whichever is 44 degrees or more from n, a unit vector of float or double.
template<class Vector> Vector otherAxis(const Vector& n)
{
    using Number = typename Vector::value_type;
    return std::abs(n.x) < Number(0.7) ? Vector(1, 0, 0) : Vector(0, 1, 0);
}

} // namespace cotan
