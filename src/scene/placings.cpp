#include "scene/placings.hpp"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

namespace cotan {

bool alikeForFrames(const glm::dmat3& a, const glm::dmat3& b)
{
    const glm::dmat3 ga = glm::transpose(a) * a, gb = glm::transpose(b) * b;
    const double ta = ga[0][0] + ga[1][1] + ga[2][2], tb = gb[0][0] + gb[1][1] + gb[2][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(ga[i][j] * tb - gb[i][j] * ta) <= 1e-5 * ta * tb))
                return false;
    return true;
}

void addPlacing(std::vector<glm::dmat3>& known, const glm::dmat3& linear)
{
    if (std::none_of(known.begin(), known.end(), [&](const glm::dmat3& k) { return alikeForFrames(k, linear); }))
        known.push_back(linear);
}

void placeUnshown(std::vector<std::vector<glm::dmat3>>& placings)
{
    for (auto& known : placings)
        if (known.empty())
            known.push_back(glm::dmat3(1));
}

} // namespace cotan
