#include "cost/choices.hpp"

namespace cotan::cost {

const std::vector<Choice>& choices()
{
    static const std::vector<Choice> list = {
        {"mikktspace, stored", "mikktspace", Stored::tangent, kVerticesPerTriangle},
        {"triangle, provoking vertex", "triangle-halfs", Stored::triangleHalfs, kProvokingVerticesPerTriangle},
        {"triangle, read", "triangle-read", Stored::nothing, kVerticesPerTriangle},
        {"smooth, 8 bytes per vertex", "smooth-fused", Stored::cotangents8, kVerticesPerTriangle},
        {"cotangent, derivatives", "cotangent-fused", Stored::nothing, kVerticesPerTriangle},
        {"cotangent, n as seen", "cotangent-seen", Stored::nothing, kVerticesPerTriangle},
    };
    return list;
}

std::optional<TrianglePrice> trianglePrice(const DeviceCode& device, const Choice& choice)
{
    const auto fragment = fragmentCode(device, choice.row).inverseThroughput,
               vertex = vertexCode(device, choice.vertex).inverseThroughput;
    return fragment && vertex ? std::optional(TrianglePrice{choice.verticesPerTriangle * *vertex, *fragment})
                              : std::nullopt;
}

} // namespace cotan::cost
