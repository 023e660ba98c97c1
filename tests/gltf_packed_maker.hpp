// Geometry for tests, compressed by the encoders of Draco and meshoptimizer.
#pragma once

#include <array>
#include <cmath>

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include "gltf_maker.hpp"

namespace cotan::test {

// ---- Draco ------------------------------------------------------------------------------------

// A wavy sheet of n x n cells with texture coordinates and bytes that identify each vertex.
struct Sheet {
    std::vector<float> positions, texcoords;
    std::vector<std::uint8_t> numbers; // three per vertex: its column, its row, 7
    std::vector<std::uint32_t> indices;
    std::size_t vertices() const { return positions.size() / 3; }
};

inline Sheet sheet(std::uint32_t n)
{
    Sheet s;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const float x = float(i) / float(n), y = float(j) / float(n);
            s.positions.insert(s.positions.end(), {x, y, 0.1f * std::sin(5 * x + 3 * y)});
            s.texcoords.insert(s.texcoords.end(), {x, 1 - y});
            s.numbers.insert(s.numbers.end(), {std::uint8_t(i), std::uint8_t(j), std::uint8_t(7)});
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            s.indices.insert(s.indices.end(), {a, b, c, a, c, d});
        }
    return s;
}

template<class T>
int addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType stored, int components,
                 const std::vector<T>& values)
{
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, std::uint8_t(components), stored, false, std::int64_t(sizeof(T)) * components, 0);
    const int id = mesh.AddAttribute(attribute, true, mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i * std::size_t(components)]);
    return id;
}

inline constexpr int kPositionBits = 14, kTexcoordBits = 12;

inline std::string dracoStream(const Sheet& s, int method, const std::vector<float>& tangents = {})
{
    draco::Mesh mesh;
    mesh.SetNumFaces(s.indices.size() / 3);
    mesh.set_num_points(std::uint32_t(s.vertices()));
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        mesh.SetFace(draco::FaceIndex(f),
                     {draco::PointIndex(s.indices[3 * f]), draco::PointIndex(s.indices[3 * f + 1]),
                      draco::PointIndex(s.indices[3 * f + 2])});
    const int positions = addAttribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, s.positions);
    const int texcoords = addAttribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, 2, s.texcoords);
    addAttribute(mesh, draco::GeometryAttribute::GENERIC, draco::DT_UINT8, 3, s.numbers);
    if (!tangents.empty())
        addAttribute(mesh, draco::GeometryAttribute::GENERIC, draco::DT_FLOAT32, 4, tangents);
    draco::ExpertEncoder encoder(mesh);
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(positions, kPositionBits);
    encoder.SetAttributeQuantization(texcoords, kTexcoordBits);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {buffer.data(), buffer.size()};
}

inline constexpr std::array<int, 2> kMethods{draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING};

// A model whose only primitive is this stream.
inline Gltf dracoModel(const Sheet& s, const std::string& stream)
{
    Gltf g;
    const int view = g.view(std::vector<char>(stream.begin(), stream.end()));
    const auto attribute = [&](const char* type, int componentType) {
        return g.accessor(json{{"componentType", componentType}, {"type", type}, {"count", s.vertices()}});
    };
    const json attributes = {{"POSITION", attribute("VEC3", kFloat)},
                             {"TEXCOORD_0", attribute("VEC2", kFloat)},
                             {"_NUMBERS", attribute("VEC3", kUByte)}};
    g.root["accessors"][0]["min"] = {0, 0, -0.1};
    g.root["accessors"][0]["max"] = {1, 1, 0.1};
    const int indices = g.accessor(json{{"componentType", kUShort}, {"type", "SCALAR"}, {"count", s.indices.size()}});
    const json draco = {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"_NUMBERS", 2}}}};
    g.add("meshes",
          {{"primitives",
            {{{"attributes", attributes},
              {"indices", indices},
              {"extensions", {{"KHR_draco_mesh_compression", draco}}}}}}});
    g.add("nodes", {{"mesh", 0}});
    g.add("scenes", {{"nodes", {0}}});
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return g;
}

// ---- meshoptimizer ----------------------------------------------------------------------------

struct Packed {
    std::string mode;
    std::size_t count = 0, stride = 0;
    std::string bytes{}, filter = "NONE";
};

// The square's model; view `view`, with elements of `packed.stride` bytes, exists only compressed.
inline std::string packedModel(Gltf g, std::size_t view, const Packed& packed,
                               const char* name = "EXT_meshopt_compression")
{
    const std::size_t offset = (g.bytes.size() + 3) / 4 * 4;
    g.bytes.resize(offset);
    g.bytes += packed.bytes;
    json& v = g.root["bufferViews"][view];
    v["buffer"] = 1;
    v["byteOffset"] = 0;
    v["byteLength"] = packed.count * packed.stride;
    v["extensions"][name] = {{"buffer", 0},
                             {"byteOffset", offset},
                             {"byteLength", packed.bytes.size()},
                             {"byteStride", packed.stride},
                             {"count", packed.count},
                             {"mode", packed.mode},
                             {"filter", packed.filter}};
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = {name, "KHR_mesh_quantization"};
    json whole = json::parse(g.text());
    whole["buffers"].push_back(
        {{"byteLength", packed.count * packed.stride}, {"extensions", {{name, {{"fallback", true}}}}}});
    return whole.dump();
}

template<class T> Packed packedVertices(const std::vector<T>& values, std::size_t components)
{
    Packed p{.mode = "ATTRIBUTES", .count = values.size() / components, .stride = components * sizeof(T)};
    p.bytes.resize(meshopt_encodeVertexBufferBound(p.count, p.stride));
    p.bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(p.bytes.data()), p.bytes.size(),
                                              values.data(), p.count, p.stride));
    return p;
}

inline Packed packedIndices(const std::vector<std::uint32_t>& indices, bool triangles)
{
    Packed p{.mode = triangles ? "TRIANGLES" : "INDICES", .count = indices.size(), .stride = 2};
    p.bytes.resize(1000);
    auto* const out = reinterpret_cast<unsigned char*>(p.bytes.data());
    p.bytes.resize(triangles ? meshopt_encodeIndexBuffer(out, p.bytes.size(), indices.data(), indices.size())
                             : meshopt_encodeIndexSequence(out, p.bytes.size(), indices.data(), indices.size()));
    return p;
}

inline Result<Scene> loadPacked(std::size_t view, const Packed& packed)
{
    return loadText(packedModel(square(), view, packed));
}

inline const std::vector<std::uint32_t> kTwoTriangles(kSquareIndices.begin(), kSquareIndices.end());

} // namespace cotan::test
