// The fit of UASTC blocks to normals: ends of lines and weights, mode by mode.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "block.hpp"
#include "block_texels.hpp"
#include "image/uastc_modes.hpp"

namespace cotan::maps::uastc {

struct Texels {
    std::array<glm::vec3, 16> codes;                    // 0 to 255
    std::array<Values, 3> codeChannels, normalChannels; // the codes again; unit vectors, or zero if lengths count
};

// The texels of a block. lengths: these count too.
Texels texelsOf(const Image& map, int left, int top, const CodeScale& scale, bool lengths);

// An endpoint's values of 8 bits in a mode, ascending, with their digits and low bits.
struct EndpointValue {
    int value = 0, digit = 0, low = 0;
};
struct EndpointTable {
    std::vector<EndpointValue> values;
    std::array<std::int16_t, 256> notBelow{}; // the index of the first value that is not below a code
};

const EndpointTable& endpointTable(std::size_t mode);

// The block in a mode: for each subset two ends, as indices of an EndpointTable, and for each texel a weight of each
// plane, 0 to 2^weightBits - 1.
struct Block {
    std::size_t mode = 0, pattern = 0;
    int own = -1; // the channel with weights of its own
    std::array<std::array<std::array<int, 3>, 2>, 2> ends{};
    std::array<std::array<int, 16>, 2> weights{};
    float error = 1e30f; // squared codes across the normal

    std::uint32_t subsets() const { return mode == 2 || mode == 4 ? kTwoSubsetsOfUastc[pattern] : 0; }
};

// The block with the least error.
Block bestBlock(const Texels& t);

} // namespace cotan::maps::uastc
