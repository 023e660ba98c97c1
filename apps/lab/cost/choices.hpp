// The normal-mapping methods that an application chooses between, each with the stages it needs.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cost/break_even.hpp"
#include "cost/machine_code.hpp"

namespace cotan::cost {

// Vertices per triangle of closed meshes with seams (BoomBox, teapot: 0.60), and with a provoking vertex per triangle.
inline constexpr double kVerticesPerTriangle = 0.6, kProvokingVerticesPerTriangle = 1.01;

struct Choice {
    std::string_view name;
    std::string_view row; // row of the fragment stage
    Stored vertex;        // what the vertex stage fetches or derives
    double verticesPerTriangle;
};

// All methods; stored MikkTSpace tangents come first.
const std::vector<Choice>& choices();

// Cost of whole stages by the driver's estimate of inverse throughput. Empty if the driver reports none or the row was
// not requested.
std::optional<TrianglePrice> trianglePrice(const DeviceCode& device, const Choice& choice);

} // namespace cotan::cost
