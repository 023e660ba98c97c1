// The rows whose cost is measured: one per normal-mapping method.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cotan/frame.hpp"

namespace cotan::cost {

// What the vertex stage outputs beside position, normal and uv, and where the data comes from.
enum class Stored {
    nothing,
    tangent,       // one float4, stored, 16 bytes
    cotangents,    // two float3, 24 bytes, derived when the mesh is loaded
    cotangents8,   // the same in 8 bytes
    cotangents4,   // the same in 4 bytes
    tangent2,      // a tangent packed into 2 bytes
    triangle,      // U and V of the triangle as six floats, derived from its vertices, which are read from buffers
    triangleHalfs, // the same as six halfs
};

struct Row {
    std::string_view name; // as on the command line
    Stored stored;
    int bytesPerPixel = 0;                   // bytes that the fragment stage reads from buffers, without the normal map
    std::string_view what;                   // summary, one line
    std::span<const std::uint32_t> fragment; // SPIR-V
    std::optional<Frame> frame = {};         // the frame of this row; empty for fused and other variants
    int instructionsOf2006 = 0;              // as published in the 2006 chapter; 0 if not one of its four
};

// Whether the row is a frame of the papers, kept for comparison.
inline bool isHistorical(const Row& row) { return row.frame && !info(*row.frame).total; }

// All rows: "floor" first, "mikktspace" second. Each frame has a row; its fused form, if any, is NAME-fused.
const std::vector<Row>& rows();

// Returns null if no row has this name.
const Row* rowFromName(std::string_view name);

struct VertexStage {
    Stored stored;
    std::string_view name;
    int bytes;                               // per vertex, of the attributes beside position, normal and uv
    std::span<const std::uint32_t> vertex;   // SPIR-V
    std::span<const std::uint32_t> consumer; // a fragment stage that uses all of its outputs
};

// In the order of the enumerators of Stored.
const std::vector<VertexStage>& vertexStages();
const VertexStage& vertexStage(Stored stored);

// Name and version of the SPIR-V compiler.
std::string_view spirvCompiler();

} // namespace cotan::cost
