// Cuts bytes that nothing uses any more out of buffer views that others still use.
#include <algorithm>
#include <cstring>

#include "edit_state.hpp"

namespace cotan::gltf_edit {

namespace {

// The bytes of an accessor inside its view.
struct Range {
    std::size_t accessor = 0;
    std::size_t begin = 0, end = 0;
    std::size_t size = 0; // of one element
};

using Cluster = std::vector<Range>; // ranges that overlap, by `begin`

std::vector<Cluster> clusters(std::vector<Range> ranges)
{
    std::ranges::sort(ranges, {}, &Range::begin);
    std::vector<Cluster> out;
    std::size_t end = 0;
    for (const Range& r : ranges) {
        if (out.empty() || r.begin >= end)
            out.emplace_back();
        out.back().push_back(r);
        end = std::max(end, r.end);
    }
    return out;
}

std::size_t endOf(const Cluster& cluster)
{
    std::size_t end = 0;
    for (const Range& r : cluster)
        end = std::max(end, r.end);
    return end;
}

// Which words of four bytes of a row the cluster uses; empty if it is not a block of rows.
std::vector<bool> usedWords(const Cluster& cluster, std::size_t stride)
{
    const std::size_t start = cluster.front().begin / 4 * 4;
    if (stride == 0 || stride % 4 != 0)
        return {};
    std::vector<bool> used(stride / 4, false);
    for (const Range& r : cluster) {
        const std::size_t column = r.begin - start;
        if (column + r.size > stride)
            return {};
        for (std::size_t w = column / 4; w < (column + r.size + 3) / 4; ++w)
            used[w] = true;
    }
    return used;
}

// Adds a view that is else like `view`, with these bytes; returns its index.
std::size_t addLike(GltfDocument& document, Json view, std::vector<std::byte> bytes)
{
    view["buffer"] = 0;
    view["byteLength"] = bytes.size();
    view.erase("byteOffset");
    document.added.push_back(std::move(bytes));
    return addItem(document, "bufferViews", std::move(view));
}

// Interleaved attributes without the words that nobody uses, as a view of their own.
void squeeze(GltfDocument& document, std::size_t view, const Cluster& cluster, const std::vector<bool>& used)
{
    const std::span<const std::byte> from = viewBytes(document, view);
    const std::size_t stride = used.size() * 4, start = cluster.front().begin / 4 * 4;
    std::vector<std::size_t> moved(used.size());
    std::size_t words = 0;
    for (std::size_t w = 0; w < used.size(); ++w) {
        moved[w] = words;
        words += used[w];
    }
    const std::size_t rows = (endOf(cluster) - start + stride - 1) / stride;
    std::vector<std::byte> bytes(rows * words * 4);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t w = 0; w < used.size(); ++w) {
            const std::size_t at = start + row * stride + w * 4;
            if (used[w] && at < from.size())
                std::memcpy(bytes.data() + (row * words + moved[w]) * 4, from.data() + at,
                            std::min<std::size_t>(4, from.size() - at));
        }
    Json like = rootOf(document)["bufferViews"][view];
    like["byteStride"] = words * 4;
    const std::size_t index = addLike(document, std::move(like), std::move(bytes));
    for (const Range& r : cluster) {
        Json& accessor = rootOf(document)["accessors"][r.accessor];
        accessor["bufferView"] = index;
        accessor["byteOffset"] = moved[(r.begin - start) / 4] * 4 + r.begin % 4;
    }
}

// The ranges that are left, moved together; what they were modulo four they stay.
void closeGaps(GltfDocument& document, std::size_t view, const std::vector<Cluster>& kept)
{
    const std::span<const std::byte> from = viewBytes(document, view);
    std::vector<std::byte> bytes;
    const std::size_t index = countOf(rootOf(document), "bufferViews");
    for (const Cluster& cluster : kept) {
        const std::size_t start = cluster.front().begin / 4 * 4;
        bytes.resize(gltf::aligned(bytes.size()));
        for (const Range& r : cluster) {
            Json& accessor = rootOf(document)["accessors"][r.accessor];
            accessor["bufferView"] = index;
            accessor["byteOffset"] = bytes.size() + r.begin - start;
        }
        const auto part = from.subspan(start, endOf(cluster) - start);
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    addLike(document, rootOf(document)["bufferViews"][view], std::move(bytes));
}

std::size_t strideOf(const GltfDocument& document, std::size_t view)
{
    return gltf::valueOr(rootOf(document)["bufferViews"][view], "byteStride", std::size_t(0));
}

} // namespace

void repackViews(GltfDocument& document, const std::vector<bool>& removed)
{
    const std::size_t views = countOf(rootOf(document), "bufferViews");
    if (views == 0)
        return;
    std::vector<std::vector<Range>> kept(views);
    std::vector<bool> lost(views, false);
    for (std::size_t a = 0; a < removed.size(); ++a) {
        const gltf::Accessor accessor = gltf::readAccessor(rootOf(document)["accessors"][a]);
        if (accessor.view < 0)
            continue;
        const auto view = std::size_t(accessor.view);
        if (removed[a]) {
            lost[view] = true;
            continue;
        }
        const std::size_t size = gltf::elementSize(accessor), begin = accessor.offset;
        const std::size_t stride = strideOf(document, view) > 0 ? strideOf(document, view) : size;
        const std::size_t end = accessor.count == 0 ? begin : begin + (accessor.count - 1) * stride + size;
        kept[view].push_back({a, begin, end, size});
    }
    // Views that something else than the dense part of an accessor uses.
    const std::vector<bool> other = usedItems(rootOf(document), kBufferViews, "accessors/*/bufferView");
    for (std::size_t view = 0; view < views; ++view) {
        if (!lost[view] || kept[view].empty() || other[view] || packedView(document, view)) // the last: as it came
            continue;
        const std::size_t stride = strideOf(document, view);
        std::vector<Cluster> whole;
        for (const Cluster& cluster : clusters(kept[view])) {
            const std::vector<bool> used = usedWords(cluster, stride);
            if (std::find(used.begin(), used.end(), false) != used.end())
                squeeze(document, view, cluster, used);
            else
                whole.push_back(cluster);
        }
        if (!whole.empty())
            closeGaps(document, view, whole);
    }
}

} // namespace cotan::gltf_edit
