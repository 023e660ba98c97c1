#include "elements.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "problem.hpp"

namespace cotan::gltf {

namespace {

// Returns the run after checking that `count` elements lie in the view. All numbers come from the JSON and are below
// 2^53, and strides are at most 252, so nothing here overflows 64 bits.
Run runIn(const ViewBytes& from, int view, std::size_t offset, std::size_t stride, std::size_t size, std::size_t count,
          const std::string& field)
{
    if (stride < size)
        failGltf("{}: expected a stride of at least {} bytes, found {}", field, size, stride);
    const std::uint64_t end = count > 0 ? offset + std::uint64_t(stride) * (count - 1) + size : 0;
    if (end > from.bytes.size())
        failGltf("{}: {} elements end at byte {} of bufferViews[{}], which has {}", field, count, end, view,
                 from.bytes.size());
    return {from.bytes.data() + std::min(offset, from.bytes.size()), stride, count};
}

template<class Out, class Stored> Out convert(Stored value, bool normalized)
{
    if constexpr (std::is_same_v<Stored, float> || !std::is_same_v<Out, float>)
        return static_cast<Out>(value);
    else if (!normalized)
        return float(value);
    else
        return std::max(float(value) / float(std::numeric_limits<Stored>::max()), -1.0f);
}

} // namespace

std::uint32_t Elements::sparseIndex(std::size_t i) const
{
    std::uint32_t value = 0;
    std::memcpy(&value, sparseIndices.at(i), componentSize(accessor.sparse->indicesType)); // little-endian like glTF
    return value;
}

std::size_t Elements::sparseLowerBound(std::uint32_t element, std::size_t first) const
{
    std::size_t last = sparseIndices.count;
    while (first < last) {
        const std::size_t middle = first + (last - first) / 2;
        if (sparseIndex(middle) < element)
            first = middle + 1;
        else
            last = middle;
    }
    return first;
}

Elements findElements(const Accessor& a, const ViewBytesOf& viewBytes, const std::string& field)
{
    Elements elements{a, {nullptr, 0, a.count}, {}, {}};
    const std::size_t size = elementSize(a);
    if (a.view >= 0) {
        const ViewBytes view = viewBytes(std::size_t(a.view));
        elements.dense = runIn(view, a.view, a.offset, view.stride > 0 ? view.stride : size, size, a.count, field);
    }
    if (!a.sparse)
        return elements;
    if (a.sparse->count > a.count)
        failGltf("{}.sparse.count: expected at most {}, the accessor's count, found {}", field, a.count,
                 a.sparse->count);
    const std::size_t indexSize = componentSize(a.sparse->indicesType);
    elements.sparseIndices =
        runIn(viewBytes(std::size_t(a.sparse->indicesView)), a.sparse->indicesView, a.sparse->indicesOffset, indexSize,
              indexSize, a.sparse->count, field + ".sparse.indices");
    elements.sparseValues = runIn(viewBytes(std::size_t(a.sparse->valuesView)), a.sparse->valuesView,
                                  a.sparse->valuesOffset, size, size, a.sparse->count, field + ".sparse.values");
    return elements;
}

void checkSparse(const Elements& elements, const std::string& field)
{
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < elements.sparseIndices.count; ++i) {
        const std::uint32_t at = elements.sparseIndex(i);
        if (at >= elements.accessor.count)
            failGltf("{}.sparse.indices[{}]: expected an index below {}, found {}", field, i, elements.accessor.count,
                     at);
        if (i > 0 && at <= before)
            failGltf("{}.sparse.indices[{}]: expected an index above {}, the previous one, found {}", field, i, before,
                     at);
        before = at;
    }
}

void checkFinite(const Elements& elements, const std::string& field)
{
    if (elements.accessor.componentType != kFloat)
        return;
    const std::size_t components = componentCount(elements.accessor.type);
    for (const Run& run : {elements.dense, elements.sparseValues})
        for (std::size_t i = 0; run.first && i < run.count; ++i)
            for (std::size_t c = 0; c < components; ++c) {
                float x = 0;
                std::memcpy(&x, run.at(i) + c * sizeof x, sizeof x);
                if (!std::isfinite(x))
                    failGltf("{}: expected finite numbers, found {} in element {}", field, x, i);
            }
}

const char* nameOfComponent(int componentType)
{
    switch (componentType) {
    case kByte: return "signed bytes";
    case kUnsignedByte: return "bytes";
    case kShort: return "signed shorts";
    case kUnsignedShort: return "shorts";
    case kUnsignedInt: return "unsigned integers";
    default: return "floats";
    }
}

void expectElements(const Accessor& a, ElementType type, std::uint64_t count, const Role& role)
{
    if (a.type != type)
        failGltf("{}: expected accessors[{}] of type {}, found {}", role.field, role.accessor, nameOf(type),
                 nameOf(a.type));
    if (a.count != count)
        failGltf("{}: expected accessors[{}] with {} elements, found {}", role.field, role.accessor, count, a.count);
}

void expectIndices(const Accessor& a, const Role& role)
{
    expectElements(a, ElementType::scalar, a.count, role);
    if (a.componentType != kUnsignedByte && a.componentType != kUnsignedShort && a.componentType != kUnsignedInt)
        failGltf("{}: expected unsigned integers in accessors[{}], found {}", role.field, role.accessor,
                 nameOfComponent(a.componentType));
}

template<class Out> void readNumbers(const Elements& elements, const Choice& choice, std::size_t outStride, Out* out)
{
    const Accessor& a = elements.accessor;
    const std::size_t components = componentCount(a.type), count = choice.size(), sparse = elements.sparseIndices.count;
    const bool normalized = a.normalized;
    withType(a.componentType, [&]<class Stored>(Stored) {
        std::size_t next = 0; // next sparse value; both lists ascend
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t element = choice.all ? i : choice.chosen[i];
            const std::byte* from = elements.dense.first ? elements.dense.at(element) : nullptr;
            if (next < sparse && elements.sparseIndex(next) < element)
                next = elements.sparseLowerBound(std::uint32_t(element), next);
            if (next < sparse && elements.sparseIndex(next) == element)
                from = elements.sparseValues.at(next++);
            if (!from)
                continue;
            for (std::size_t c = 0; c < components; ++c) {
                Stored stored;
                std::memcpy(&stored, from + c * sizeof stored, sizeof stored);
                out[i * outStride + c] = convert<Out>(stored, normalized);
            }
        }
    });
}

template void readNumbers(const Elements&, const Choice&, std::size_t, float*);
template void readNumbers(const Elements&, const Choice&, std::size_t, std::uint32_t*);

template<class Vector> std::vector<Vector> readVectors(const Elements& elements, const Choice& choice, const Role& role)
{
    constexpr ElementType types[] = {ElementType::vec2, ElementType::vec3, ElementType::vec4};
    expectElements(elements.accessor, types[Vector::length() - 2], choice.count, role);
    if (elements.accessor.componentType == kUnsignedInt)
        failGltf("{}: expected floats, bytes or shorts in accessors[{}], found {}", role.field, role.accessor,
                 nameOfComponent(elements.accessor.componentType));
    std::vector<Vector> out(choice.size(), Vector(0));
    if (!out.empty())
        readNumbers(elements, choice, std::size_t(Vector::length()), &out[0].x);
    return out;
}

template std::vector<glm::vec2> readVectors(const Elements&, const Choice&, const Role&);
template std::vector<glm::vec3> readVectors(const Elements&, const Choice&, const Role&);
template std::vector<glm::vec4> readVectors(const Elements&, const Choice&, const Role&);

void renewBounds(Json& accessor, Elements elements)
{
    if (!accessor.contains("min") && !accessor.contains("max"))
        return;
    accessor.erase("min");
    accessor.erase("max");
    Accessor& a = elements.accessor;
    if (a.type > ElementType::vec4 || a.componentType == kUnsignedInt || a.count == 0)
        return;
    a.normalized = false; // bounds refer to the stored numbers
    const std::size_t width = componentCount(a.type);
    std::vector<float> values(a.count * width);
    readNumbers(elements, a.count, width, values.data());
    for (std::size_t c = 0; c < width; ++c) {
        float low = values[c], high = values[c];
        for (std::size_t i = c; i < values.size(); i += width) {
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
        }
        const auto number = [&](float x) { return a.componentType == kFloat ? Json(x) : Json(int(x)); };
        accessor["min"].push_back(number(low));
        accessor["max"].push_back(number(high));
    }
}

} // namespace cotan::gltf
