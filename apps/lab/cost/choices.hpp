// Ways to perturb a normal that an application chooses between, each with the stages it needs.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cost/break_even.hpp"
#include "cost/machine_code.hpp"

namespace cotan::cost {

// Of a closed mesh with seams: BoomBox 0.60, the teapot 0.60. Where every triangle owns its provoking vertex: 1.01.
inline constexpr double kVerticesPerTriangle = 0.6, kProvokingVerticesPerTriangle = 1.01;

struct Choice {
    std::string_view name;
    std::string_view row; // of the fragment stage
    Stored vertex;        // what the vertex stage fetches or makes
    double verticesPerTriangle;
};

// Stored MikkTSpace tangents come first.
const std::vector<Choice>& choices();

// By the driver's estimate of inverse throughput, whole stages. Nothing where it has none, or the row was not asked
// for.
std::optional<TrianglePrice> trianglePrice(const DeviceCode& device, const Choice& choice);

} // namespace cotan::cost
