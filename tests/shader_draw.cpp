// Geometry that is drawn for the functions that take screen-space derivatives themselves.
#include "shader_cases.hpp"

namespace cotan::test {

std::vector<Vectors> tiles()
{
    std::vector<Vectors> all;
    for (const Sample& s : samples())
        if (s.kind == Kind::sound && all.size() < kTiles * kTiles)
            all.push_back(s.v);
    return all;
}

std::vector<Corner> corners(const std::vector<Vectors>& tiles)
{
    std::vector<Corner> all;
    for (int k = 0; k < kTiles * kTiles; ++k) {
        const Vectors& v = tiles[static_cast<std::size_t>(k)];
        // Position and uv are zero in the centre of the tile and linear across it.
        auto corner = [&](int right, int down) {
            const float x = kTile * (static_cast<float>(right) - 0.5f), y = kTile * (static_cast<float>(down) - 0.5f);
            const glm::vec2 at(k % kTiles + right, k / kTiles + down);
            all.push_back(
                {at * (2.0f / kTiles) - 1.0f, v.n, v.dpdx * x + v.dpdy * y, v.duvdx * x + v.duvdy * y, v.texel});
        };
        for (int c : {0, 1, 2, 2, 1, 3})
            corner(c % 2, c / 2);
    }
    return all;
}

} // namespace cotan::test
