#include "truth/grain.hpp"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "truth/random.hpp"

namespace cotan {

Image makeGrain(double reach)
{
    constexpr int side = 256;
    Random random(7);
    std::vector<glm::vec2> slopes(std::size_t(side * side));
    for (glm::vec2& s : slopes)
        for (int i = 0; i < 6; ++i)
            s += glm::vec2(random.range(-reach, reach), random.range(-reach, reach));
    Image image = makeImage(side, side, PixelType::unorm8, "grain");
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            glm::vec2 sum(0);
            for (int k = 0; k < 9; ++k)
                sum += slopes[std::size_t((y + k / 3) % side * side + (x + k % 3) % side)] / 3.0f;
            const glm::vec3 n = glm::normalize(glm::vec3(sum, 1));
            std::uint8_t* const p = image.bytes8() + 4 * (y * side + x);
            for (int c = 0; c < 3; ++c)
                p[c] = std::uint8_t(std::lround(n[c] * 127 + 128));
            p[3] = 255;
        }
    return image;
}

} // namespace cotan
