#include "cotan/cost/choices.hpp"

#include <algorithm>

namespace cotan::cost {

const std::vector<Choice>& choices()
{
    static const std::vector<Choice> list = {
        {"mikktspace, stored", "mikktspace", Stored::tangent, kVerticesPerTriangle},
        {"triangle, provoking vertex", "triangle-halfs", Stored::triangleHalfs, kProvokingVerticesPerTriangle},
        {"triangle, read", "triangle-read", Stored::nothing, kVerticesPerTriangle},
        {"smooth, 8 bytes a vertex", "smooth-fused", Stored::cotangents8, kVerticesPerTriangle},
        {"cotangent, derivatives", "cotangent-fused", Stored::nothing, kVerticesPerTriangle},
        {"cotangent, n as seen", "cotangent-seen", Stored::nothing, kVerticesPerTriangle},
    };
    return list;
}

std::optional<TrianglePrice> trianglePrice(const DeviceCode& device, const Choice& choice)
{
    const auto row = std::ranges::find(device.rows, choice.row, &RowCode::row);
    const auto stage = std::ranges::find(device.vertices, choice.vertex, &VertexCode::stored);
    if (row == device.rows.end() || stage == device.vertices.end() || !row->fragment.inverseThroughput
        || !stage->vertex.inverseThroughput)
        return std::nullopt;
    return TrianglePrice{choice.verticesPerTriangle * *stage->vertex.inverseThroughput,
                         *row->fragment.inverseThroughput};
}

} // namespace cotan::cost
