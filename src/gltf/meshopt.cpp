// The codecs and filters of EXT_meshopt_compression. libmeshoptimizer's decoders accept untrusted bytes but assert
// their size arguments, which are checked here.
#include <meshoptimizer.h>

#include "gltf_file.hpp"

namespace cotan {

namespace {

// Checks the rules of the extension's specification; the tables of the JSON ensure a stride from 1 to 256.
void checkSizes(const MeshoptView& view, const std::string& field)
{
    const bool attributes = view.mode == "ATTRIBUTES";
    if (attributes ? view.stride % 4 != 0 : view.stride != 2 && view.stride != 4)
        failGltf("{}.byteStride: expected {}, found {}", field, attributes ? "a multiple of 4 up to 256" : "2 or 4",
                 view.stride);
    if (view.mode == "TRIANGLES" && view.count % 3 != 0)
        failGltf("{}.count: expected a multiple of 3, found {}", field, view.count);
    if (view.filter != "NONE" && !attributes)
        failGltf("{}.filter: expected none for mode {}, found {}", field, view.mode, view.filter);
    if (view.filter == "OCTAHEDRAL" && view.stride != 4 && view.stride != 8)
        failGltf("{}.byteStride: expected 4 or 8 for filter OCTAHEDRAL, found {}", field, view.stride);
    if (view.filter == "QUATERNION" && view.stride != 8)
        failGltf("{}.byteStride: expected 8 for filter QUATERNION, found {}", field, view.stride);
    if (view.filter == "COLOR") // KHR_meshopt_compression only
        failGltf("{}.filter: COLOR is not supported; expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL", field);
}

int decodeStream(const MeshoptView& view, std::vector<std::byte>& out)
{
    const auto* const bytes = reinterpret_cast<const unsigned char*>(view.bytes.data());
    if (view.mode == "ATTRIBUTES")
        return meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, bytes, view.bytes.size());
    if (view.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, bytes, view.bytes.size());
    return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, bytes, view.bytes.size());
}

} // namespace

std::vector<std::byte> decodeMeshopt(const MeshoptView& view, const std::string& field)
{
    checkSizes(view, field);
    std::vector<std::byte> out(view.count * view.stride);
    if (const int code = decodeStream(view, out); code == -1)
        failGltf("{}: expected a stream that meshoptimizer 0.18 reads (codec version 0), found another", field);
    else if (code != 0)
        failGltf("{}: the compressed bytes are damaged, or not {} elements of {} bytes", field, view.count,
                 view.stride);
    if (view.filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(out.data(), view.count, view.stride);
    else if (view.filter == "QUATERNION")
        meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
    else if (view.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(out.data(), view.count, view.stride);
    return out;
}

} // namespace cotan
