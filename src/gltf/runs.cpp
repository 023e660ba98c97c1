#include "runs.hpp"

#include <algorithm>
#include <cstring>

namespace cotan {

std::size_t componentSize(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    default: return 4;
    }
}

std::size_t componentCount(const tinygltf::Accessor& a)
{
    return static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)));
}

std::size_t elementSize(const tinygltf::Accessor& a)
{
    const std::size_t size = componentSize(a.componentType);
    if (a.type == TINYGLTF_TYPE_MAT2 && size == 1)
        return 8;
    if (a.type == TINYGLTF_TYPE_MAT3 && size < 4)
        return size == 1 ? 12 : 24;
    return size * componentCount(a);
}

namespace {

// Checks that `count` elements lie in the view. All numbers come from the JSON and are below 2^53,
// strides at most 252, so nothing here overflows 64 bits.
GltfRun runIn(const GltfModel& model, int view, std::size_t offset, std::size_t stride,
          std::size_t size, std::size_t count, const std::string& field)
{
    const std::span<const std::byte> bytes = gltfView(model, view);
    if (stride < size)
        failGltf("{}: expected a stride of at least {} bytes, found {}", field, size, stride);
    if (count > 0 && offset + stride * (count - 1) + size > bytes.size())
        failGltf("{}: {} elements end at byte {} of bufferViews[{}], which has {}", field, count,
                 offset + stride * (count - 1) + size, view, bytes.size());
    return {bytes.data() + std::min(offset, bytes.size()), stride, count};
}

} // namespace

GltfRun denseRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    if (a.bufferView < 0)
        return {nullptr, 0, a.count};
    const std::size_t stride =
        model.tiny.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
    const std::size_t size = elementSize(a);
    return runIn(model, a.bufferView, a.byteOffset, stride > 0 ? stride : size, size, a.count,
                 field);
}

GltfRun sparseIndexRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    const std::size_t size = componentSize(a.sparse.indices.componentType);
    return runIn(model, a.sparse.indices.bufferView,
                 static_cast<std::size_t>(a.sparse.indices.byteOffset), size, size,
                 static_cast<std::size_t>(a.sparse.count), field + ".sparse.indices");
}

GltfRun sparseValueRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    const std::size_t size = elementSize(a);
    return runIn(model, a.sparse.values.bufferView,
                 static_cast<std::size_t>(a.sparse.values.byteOffset), size, size,
                 static_cast<std::size_t>(a.sparse.count), field + ".sparse.values");
}

std::uint32_t readIndex(const std::byte* at, int componentType)
{
    std::uint32_t value = 0;
    std::memcpy(&value, at, componentSize(componentType)); // little-endian, as the file
    return value;
}

} // namespace cotan
