// What is priced: one row per way to perturb a normal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cotan/frame.hpp"

namespace cotan::cost {

// What the vertex stage hands on beside position, normal and uv, and where it has it from.
enum class Stored {
    nothing,
    tangent,       // one float4, stored, 16 bytes
    cotangents,    // two float3, 24 bytes, derived when the mesh is loaded
    cotangents8,   // the same, packed into 8 bytes
    cotangents4,   // and into 4
    tangent2,      // a tangent packed into 2 bytes
    triangle,      // U and V of the triangle as six floats, made from its vertices, which are read from buffers
    triangleHalfs, // the same as six halfs
};

struct Row {
    std::string_view name; // as on the command line
    Stored stored;
    int bytesPerPixel = 0;                   // buffer reads of the fragment stage, without the normal map
    std::string_view what;                   // one line
    std::span<const std::uint32_t> fragment; // SPIR-V
    std::optional<Frame> frame = {};         // of which it is the row; none for a fused or another form
    int instructionsOf2006 = 0;              // as published in the 2006 chapter; 0: not among its four
};

// Whether it is that of a frame of the papers, which is there to be compared with.
inline bool isHistorical(const Row& row) { return row.frame && !info(*row.frame).total; }

// "floor" is the first, "mikktspace" the second. Each frame has one, and one for its fused form, NAME-fused.
const std::vector<Row>& rows();

// Nothing where there is no row of that name.
const Row* rowFromName(std::string_view name);

struct VertexStage {
    Stored stored;
    std::string_view name;
    int bytes;                               // of the attributes beside position, normal and uv, per vertex
    std::span<const std::uint32_t> vertex;   // SPIR-V
    std::span<const std::uint32_t> consumer; // a fragment stage that uses all it hands on
};

// In the order of Stored.
const std::vector<VertexStage>& vertexStages();
const VertexStage& vertexStage(Stored stored);

// Name and version of what made the SPIR-V.
std::string_view spirvCompiler();

} // namespace cotan::cost
