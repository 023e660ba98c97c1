// Decodes Draco bitstream 2.2 to the arrays of glTF. Source: the Draco Bitstream Specification, version 2.2, sections 4
// (header) and 5 (connectivity).
#include <cstring>
#include <new>
#include <string_view>

#include <draco/compression/decode.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>

#include "core/one_line.hpp"
#include "elements.hpp"
#include "gltf/draco.hpp"
#include "problem.hpp"

namespace cotan {

namespace {

// Throws GltfProblem if the header disagrees with the model: the decoder allocates memory by it.
void checkStreamHeader(const DracoJob& job)
{
    constexpr std::string_view kMagic = "DRACO";
    constexpr std::uint8_t kMesh = 1, kSequential = 0, kEdgebreaker = 1;
    constexpr std::uint16_t kMetadata = 0x8000;
    const std::string_view stream(reinterpret_cast<const char*>(job.bytes.data()), job.bytes.size());
    if (!stream.starts_with(kMagic))
        failGltf("{}: expected a Draco stream, found other data", job.field);
    draco::DecoderBuffer header;
    header.Init(stream.data(), stream.size());
    header.Advance(kMagic.size());
    std::uint8_t major = 0, minor = 0, kind = 0, method = 0, traversal = 0;
    std::uint16_t flags = 0;
    bool whole = header.Decode(&major) && header.Decode(&minor) && header.Decode(&kind) && header.Decode(&method)
        && header.Decode(&flags);
    if (major != 2 || minor != 2)
        failGltf("{}: expected Draco bitstream 2.2, found {}.{}", job.field, major, minor);
    if (kind != kMesh || (method != kSequential && method != kEdgebreaker))
        failGltf("{}: expected a mesh of triangles, found another kind of Draco stream", job.field);
    if (flags & kMetadata)
        failGltf("{}: the Draco stream has metadata, which is not supported", job.field);
    std::uint64_t faces = 0, vertices = 0; // Edgebreaker counts positions; attributes may split them
    if (method == kEdgebreaker)
        whole = whole && header.Decode(&traversal) && draco::DecodeVarint(&vertices, &header)
            && draco::DecodeVarint(&faces, &header);
    else
        whole = whole && draco::DecodeVarint(&faces, &header) && draco::DecodeVarint(&vertices, &header);
    if (!whole)
        failGltf("{}: the Draco stream ends within its header", job.field);
    if (faces != job.indices / 3 || job.indices % 3 != 0)
        failGltf("{}: expected {} indices, as the accessor has, found {} triangles in the Draco stream", job.field,
                 job.indices, faces);
    if (vertices > job.vertices)
        failGltf("{}: expected {} vertices, as the accessors have, found {} in the Draco stream", job.field,
                 job.vertices, vertices);
}

std::vector<std::byte> valuesOf(const draco::Mesh& mesh, const DracoAttribute& wanted, const DracoJob& job)
{
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (!attribute)
        failGltf("{}: the Draco stream has no attribute with the id {}", job.field, wanted.id);
    if (std::uint32_t(attribute->num_components()) != wanted.components)
        failGltf("{}: expected {} components in the Draco attribute with the id {}, found {}", job.field,
                 wanted.components, wanted.id, attribute->num_components());
    const std::size_t elementBytes = wanted.components * gltf::componentSize(wanted.componentType);
    std::vector<std::byte> values(job.vertices * elementBytes);
    gltf::withType(wanted.componentType, [&]<class T>(T) {
        std::vector<T> element(wanted.components);
        for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
            const draco::AttributeValueIndex at = attribute->mapped_index(draco::PointIndex(p));
            if (at.value() >= attribute->size()
                || !attribute->ConvertValue(at, static_cast<std::int8_t>(wanted.components), element.data()))
                failGltf("{}: vertex {} of the Draco attribute with the id {} cannot be converted to {}", job.field, p,
                         wanted.id, gltf::nameOfComponent(wanted.componentType));
            std::memcpy(values.data() + p * elementBytes, element.data(), elementBytes);
        }
    });
    return values;
}

std::vector<std::byte> indicesOf(const draco::Mesh& mesh, const DracoJob& job)
{
    const std::size_t elementBytes = gltf::componentSize(job.indexType);
    std::vector<std::byte> indices(job.indices * elementBytes);
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t index = mesh.face(draco::FaceIndex(f))[k].value();
            if (index >= job.vertices || (elementBytes < 4 && index >> (8 * elementBytes) != 0))
                failGltf("{}: index {} of the Draco stream is {}, but there are {} vertices and an index has {} bytes",
                         job.field, 3 * f + k, index, job.vertices, elementBytes);
            std::memcpy(indices.data() + (3 * f + k) * elementBytes, &index, elementBytes); // little-endian
        }
    return indices;
}

DracoGeometry decodeOne(const DracoJob& job)
{
    checkStreamHeader(job);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(job.bytes.data()), job.bytes.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        failGltf("{}: the Draco stream is damaged ({})", job.field, oneLine(decoded.status().error_msg_string()));
    const draco::Mesh& mesh = *decoded.value();
    if (mesh.num_points() != job.vertices)
        failGltf("{}: expected {} vertices, as the accessors have, found {} in the Draco stream", job.field,
                 job.vertices, mesh.num_points());
    if (mesh.num_faces() != job.indices / 3)
        failGltf("{}: expected {} indices, as the accessor has, found {} triangles in the Draco stream", job.field,
                 job.indices, mesh.num_faces());
    DracoGeometry geometry{indicesOf(mesh, job), {}};
    for (const DracoAttribute& wanted : job.attributes)
        geometry.attributes.push_back(valuesOf(mesh, wanted, job));
    return geometry;
}

} // namespace

Result<std::vector<DracoGeometry>> decodeDracoHere(const std::vector<DracoJob>& jobs)
try {
    std::vector<DracoGeometry> meshes;
    for (const DracoJob& job : jobs)
        meshes.push_back(decodeOne(job));
    return meshes;
} catch (const GltfProblem& problem) {
    return inputError(problem.error.message);
} catch (const std::bad_alloc&) {
    return inputError("not enough memory for a Draco stream");
}

} // namespace cotan
