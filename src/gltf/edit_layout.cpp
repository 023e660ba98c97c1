// Converts an edited document to one JSON and one buffer. Unchanged compressed geometry keeps its compressed bytes.
#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/ranges.h>

#include "core/one_line.hpp"
#include "edit_state.hpp"

namespace cotan::gltf_edit {

namespace {

// ---- compressed data: KHR_draco_mesh_compression, EXT_ and KHR_meshopt_compression -----------

// The attributes of a stream that the primitive still has, with their ids as in the extension. Empty if its positions
// or triangles have changed.
Json remainingAttributes(const Json& primitive, const GltfPacked::Primitive& packed)
{
    if (gltf::valueOr(primitive, "indices", -1) != packed.indices
        || gltf::valueOr(primitive, "mode", gltf::kTriangles) != gltf::kTriangles)
        return Json::object();
    Json left = Json::object();
    for (const auto& [name, id] : packed.draco["attributes"].items()) {
        const int accessor = packed.attributes[name].get<int>();
        if (gltf::valueOr(primitive["attributes"], name, -1) == accessor)
            left[name] = id;
    }
    return left.contains("POSITION") ? left : Json::object();
}

// Lists an extension as used, and as required if the file requires it; unpacking removed it from both lists.
void addExtension(Json& root, const GltfPacked& packed, const std::string& name)
{
    root["extensionsUsed"].push_back(name);
    if (std::ranges::find(packed.required, name) != packed.required.end())
        root["extensionsRequired"].push_back(name);
}

// The name of the meshoptimizer extension that compresses a view.
std::string meshoptName(const Json& view)
{
    return kMeshoptExtensions[view["extensions"].contains(kMeshoptExtensions[0]) ? 0 : 1];
}

// Restores the Draco streams of primitives whose vertices and indices are unchanged. Removed attributes stay in the
// stream without a reference. Adds notes about streams with such attributes and about primitives that are written
// uncompressed.
void restoreDraco(GltfDocument& document)
{
    const GltfPacked& packed = document.source->file.packed;
    if (packed.primitives.empty())
        return;
    Json& root = rootOf(document);
    // References to each accessor: all, and those from primitives whose stream is restored.
    std::vector<std::size_t> uses(countOf(root, "accessors")), packedUses(uses.size());
    forEachReference(root, kAccessors, [&](Json& index) {
        if (const auto i = index.get<std::size_t>(); i < uses.size()) // extensions may have any value
            ++uses[i];
    });
    std::size_t restored = 0, withRemoved = 0;
    for (const GltfPacked::Primitive& p : packed.primitives) {
        Json& primitive = root["meshes"][p.mesh]["primitives"][p.primitive];
        Json left = remainingAttributes(primitive, p);
        if (left.empty())
            continue;
        for (const auto& [name, id] : left.items())
            ++packedUses[primitive["attributes"][name].get<std::size_t>()];
        ++packedUses[std::size_t(p.indices)];
        ++restored;
        withRemoved += left.size() < p.draco["attributes"].size();
        Json& extension = primitive["extensions"][kDracoExtension] = p.draco;
        extension["attributes"] = std::move(left);
    }
    if (restored > 0) {
        for (const auto& [index, json] : packed.accessors) // accessors filled only by streams need no bytes
            if (const auto i = std::size_t(index); packedUses[i] > 0 && uses[i] == packedUses[i])
                root["accessors"][i] = json;
        addExtension(root, packed, kDracoExtension);
    }
    if (withRemoved > 0)
        document.notes.push_back(
            fmt::format("{}: {} of {} streams are unchanged and still contain the removed tangents, which "
                        "are unused; \"gltf-transform draco\" compresses them without",
                        kDracoExtension, withRemoved, packed.primitives.size()));
    if (restored < packed.primitives.size())
        document.notes.push_back(fmt::format("{}: {} of {} primitives changed and are written uncompressed; "
                                             "\"gltf-transform draco\" compresses them again",
                                             kDracoExtension, packed.primitives.size() - restored,
                                             packed.primitives.size()));
}

// The JSON of a view as compressed by meshoptimizer in the file; null for other views.
const Json* packedView(const GltfDocument& document, std::size_t view)
{
    const std::map<std::size_t, Json>& views = document.source->file.packed.views;
    const auto found = views.find(view);
    return found == views.end() ? nullptr : &found->second;
}

// Adds a note with the number of compressed views that are unused now, if uncompressed views replace them.
void notePlainViews(GltfDocument& document)
{
    const std::map<std::size_t, Json>& views = document.source->file.packed.views;
    const std::vector<bool> used = usedItems(rootOf(document), kBufferViews);
    const auto gone = std::ranges::count_if(views, [&](const auto& view) { return !used[view.first]; });
    const Json* const accessors = gltf::member(rootOf(document), "accessors");
    const bool replaced =
        accessors && std::ranges::any_of(*accessors, [&](const Json& accessor) {
            return gltf::valueOr(accessor, "bufferView", std::size_t(0)) >= document.source->views.size();
        });
    if (gone > 0 && replaced)
        document.notes.push_back(fmt::format("{} of {} compressed buffer views are replaced by uncompressed ones; "
                                             "\"gltf-transform meshopt\" compresses them again",
                                             gone, views.size()));
}

// ---- unused bytes in views that others still use --------------------------------------------

// The bytes of an accessor inside its view.
struct Range {
    std::size_t accessor = 0;
    std::size_t begin = 0, end = 0;
    std::size_t size = 0; // of one element, in bytes
};

struct Cluster {
    std::size_t start = 0, end = 0; // start: a multiple of four
    std::vector<Range> ranges;      // overlapping, sorted by `begin`
};

std::vector<Cluster> clusters(std::vector<Range> ranges)
{
    std::ranges::sort(ranges, {}, &Range::begin);
    std::vector<Cluster> out;
    for (const Range& r : ranges) {
        if (out.empty() || r.begin >= out.back().end)
            out.push_back({r.begin / 4 * 4, 0, {}});
        out.back().ranges.push_back(r);
        out.back().end = std::max(out.back().end, r.end);
    }
    return out;
}

// For each four-byte word of a row, whether the cluster uses it; empty if the cluster is not a block of rows.
std::vector<bool> usedWords(const Cluster& cluster, std::size_t stride)
{
    if (stride == 0 || stride % 4 != 0)
        return {};
    std::vector<bool> used(stride / 4, false);
    for (const Range& r : cluster.ranges) {
        const std::size_t column = r.begin - cluster.start;
        if (column + r.size > stride)
            return {};
        for (std::size_t w = column / 4; w < (column + r.size + 3) / 4; ++w)
            used[w] = true;
    }
    return used;
}

// Adds a view with these bytes and otherwise the members of `view`; returns its index.
std::size_t addLike(GltfDocument& document, Json view, std::vector<std::byte> bytes)
{
    view["buffer"] = 0;
    view["byteLength"] = bytes.size();
    view.erase("byteOffset");
    document.added.push_back(std::make_shared<const std::vector<std::byte>>(std::move(bytes)));
    return addItem(document, "bufferViews", std::move(view));
}

// Moves interleaved attributes to a view of their own, without the unused words.
void squeeze(GltfDocument& document, std::size_t view, const Cluster& cluster, const std::vector<bool>& used)
{
    const std::span<const std::byte> from = viewBytes(document, view);
    const std::size_t stride = used.size() * 4, start = cluster.start;
    std::vector<std::size_t> moved(used.size());
    std::size_t words = 0;
    for (std::size_t w = 0; w < used.size(); ++w) {
        moved[w] = words;
        words += used[w];
    }
    const std::size_t rows = (cluster.end - start + stride - 1) / stride;
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
    for (const Range& r : cluster.ranges) {
        Json& accessor = rootOf(document)["accessors"][r.accessor];
        accessor["bufferView"] = index;
        accessor["byteOffset"] = moved[(r.begin - start) / 4] * 4 + r.begin % 4;
    }
}

// Moves the remaining ranges together; offsets modulo four are kept.
void closeGaps(GltfDocument& document, std::size_t view, const std::vector<Cluster>& kept)
{
    const std::span<const std::byte> from = viewBytes(document, view);
    std::vector<std::byte> bytes;
    const std::size_t index = countOf(rootOf(document), "bufferViews");
    for (const Cluster& cluster : kept) {
        bytes.resize(gltf::aligned(bytes.size()));
        for (const Range& r : cluster.ranges) {
            Json& accessor = rootOf(document)["accessors"][r.accessor];
            accessor["bufferView"] = index;
            accessor["byteOffset"] = bytes.size() + r.begin - cluster.start;
        }
        const auto part = from.subspan(cluster.start, cluster.end - cluster.start);
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    addLike(document, rootOf(document)["bufferViews"][view], std::move(bytes));
}

// Removes the bytes of removed accessors from views that others still use: whole ranges, and columns of interleaved
// views. Added views replace these views.
void repackViews(GltfDocument& document, const std::vector<bool>& removed)
{
    const std::size_t views = countOf(rootOf(document), "bufferViews");
    if (views == 0)
        return;
    const auto strideOf = [&](std::size_t view) {
        return gltf::valueOr(rootOf(document)["bufferViews"][view], "byteStride", std::size_t(0));
    };
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
        const std::size_t stride = strideOf(view) > 0 ? strideOf(view) : size;
        const std::size_t end = accessor.count == 0 ? begin : begin + (accessor.count - 1) * stride + size;
        kept[view].push_back({a, begin, end, size});
    }
    // Views used by anything but the dense part of an accessor.
    const std::vector<bool> other = usedItems(rootOf(document), kBufferViews, "accessors/*/bufferView");
    for (std::size_t view = 0; view < views; ++view) {
        if (!lost[view] || kept[view].empty() || other[view] || packedView(document, view)) // compressed views are kept
            continue;
        const std::size_t stride = strideOf(view);
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

// ---- layout ---------------------------------------------------------------------------------

// Marks items that the file used or that were added, and that nothing uses now.
std::vector<bool> released(const GltfDocument& document, const Collection& collection)
{
    std::vector<bool> before = usedItems(document.source->file.json, collection);
    if (&collection == &kBufferViews) // nothing refers to a view once its stream is decoded
        for (const GltfPacked::Primitive& packed : document.source->file.packed.primitives)
            before[packed.draco["bufferView"].get<std::size_t>()] = true;
    std::vector<bool> removed = usedItems(rootOf(document), collection);
    for (std::size_t i = 0; i < removed.size(); ++i)
        removed[i] = !removed[i] && (i >= before.size() || before[i]);
    return removed;
}

bool any(const std::vector<bool>& flags) { return std::find(flags.begin(), flags.end(), true) != flags.end(); }

// A buffer view with its bytes and their location in the file.
struct Part {
    std::size_t view = 0; // in the final JSON
    std::span<const std::byte> bytes;
    bool fromFile = false;
    std::size_t buffer = 0, offset = 0;
    const Json* packed = nullptr; // the view's JSON in the file if it is compressed there; `bytes` are compressed then
};

std::vector<Part> partsOf(const GltfDocument& document)
{
    std::vector<Part> parts(countOf(rootOf(document), "bufferViews"));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Part& part = parts[i];
        part.view = i;
        part.bytes = viewBytes(document, i);
        part.fromFile = i < document.source->views.size();
        if (!part.fromFile)
            continue;
        part.packed = packedView(document, i);
        const gltf::BufferView view =
            gltf::readBufferView(part.packed ? (*part.packed)["extensions"][meshoptName(*part.packed)]
                                             : document.source->file.json["bufferViews"][i]);
        part.buffer = view.buffer;
        part.offset = view.offset;
        if (part.packed)
            part.bytes = document.source->file.buffers[view.buffer].subspan(view.offset, view.length);
    }
    return parts;
}

void append(Layout& out, std::span<const std::byte> bytes)
{
    out.size += bytes.size();
    if (std::span<const std::byte>* const last = out.blocks.empty() ? nullptr : &out.blocks.back();
        last && last->data() + last->size() == bytes.data())
        *last = {last->data(), last->size() + bytes.size()};
    else if (!bytes.empty())
        out.blocks.push_back(bytes);
}

void alignFor(Layout& out, std::size_t offset)
{
    static constexpr std::byte kZeros[6] = {};
    append(out, std::span(kZeros).first(gltf::aligned(out.size) + offset % 4 - out.size));
}

void place(Layout& out, const Part& part, std::size_t offset)
{
    Json& view = out.root["bufferViews"][part.view];
    if (part.packed) {
        const std::string name = meshoptName(*part.packed);
        view = *part.packed;
        view["buffer"] = 1;
        view["byteOffset"] = out.decoded;
        out.decoded += gltf::aligned(view["byteLength"].get<std::size_t>());
        out.compressionExtensions.insert(name);
        Json& extension = view["extensions"][name];
        extension["buffer"] = 0;
        extension["byteOffset"] = offset;
        return;
    }
    view["buffer"] = 0;
    if (offset > 0 || view.contains("byteOffset"))
        view["byteOffset"] = offset;
}

// Appends the file's views in the order of their bytes. Views that share bytes still do; bytes between views are
// dropped.
void appendFileParts(const GltfDocument& document, std::vector<Part> parts, Layout& out)
{
    std::erase_if(parts, [](const Part& p) { return !p.fromFile; });
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        return std::pair(a.buffer, a.offset) < std::pair(b.buffer, b.offset);
    });
    for (std::size_t first = 0, last; first < parts.size(); first = last) {
        const std::size_t buffer = parts[first].buffer, begin = parts[first].offset;
        std::size_t end = begin + parts[first].bytes.size();
        for (last = first + 1; last < parts.size() && parts[last].buffer == buffer && parts[last].offset < end; ++last)
            end = std::max(end, parts[last].offset + parts[last].bytes.size());
        alignFor(out, begin);
        const std::size_t start = out.size;
        append(out, document.source->file.buffers[buffer].subspan(begin, end - begin));
        for (std::size_t i = first; i < last; ++i)
            place(out, parts[i], start + parts[i].offset - begin);
    }
}

// Appends the file's buffer unchanged, with gaps.
void appendWhole(const GltfDocument& document, const std::vector<Part>& parts, Layout& out)
{
    for (const auto& bytes : document.source->file.buffers)
        append(out, bytes);
    for (const Part& part : parts)
        if (part.fromFile)
            place(out, part, part.offset);
}

void describeBuffer(GltfDocument& document, Layout& out)
{
    Json first = Json::object();
    if (const std::size_t count = countOf(out.root, "buffers"); count > 0) {
        first = out.root["buffers"][0];
        if (count > 1 && document.source->file.unpackedBytes.empty()) // else decoding added the other buffers
            document.notes.push_back(
                fmt::format("buffers: {} were joined into one; names and extras of the first are kept", count));
    }
    first.erase("uri");
    first["byteLength"] = out.size;
    if (out.size == 0)
        out.root.erase("buffers");
    else
        out.root["buffers"] = Json::array({std::move(first)});
    if (out.decoded == 0)
        return;
    Json fallback = {{"byteLength", out.decoded}}; // where decoders put the data; it has no bytes in the file
    for (const std::string& name : out.compressionExtensions) {
        fallback["extensions"][name] = {{"fallback", true}};
        addExtension(out.root, document.source->file.packed, name);
    }
    out.root["buffers"].push_back(std::move(fallback));
}

} // namespace

Layout layOut(GltfDocument& document)
{
    restoreDraco(document);
    const std::vector<std::string> unknown = unknownExtensions(rootOf(document));
    const bool removes = unknown.empty();
    if (!removes && document.source->file.buffers.size() > 1)
        failGltf("buffers: expected one, since an unknown extension ({}) may refer to them, found {}",
                 oneLine(unknown.front()), document.source->file.buffers.size());

    if (removes) {
        if (const auto images = released(document, kImages); any(images))
            removeItems(rootOf(document), kImages, images);
        if (const auto accessors = released(document, kAccessors); any(accessors)) {
            repackViews(document, accessors);
            removeItems(rootOf(document), kAccessors, accessors);
        }
    } else {
        document.notes.push_back(fmt::format("unused data is kept, because unknown extensions may refer to it ({})",
                                             oneLine(fmt::format("{}", fmt::join(unknown, ", ")))));
    }

    notePlainViews(document);
    std::vector<Part> parts = partsOf(document);
    if (const auto views = released(document, kBufferViews); removes && any(views)) {
        removeItems(rootOf(document), kBufferViews, views);
        std::erase_if(parts, [&](const Part& part) { return views[part.view]; });
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i].view = i;

    Layout out{std::move(rootOf(document)), {}, 0, 0, {}};
    if (removes)
        appendFileParts(document, parts, out);
    else
        appendWhole(document, parts, out);
    for (const Part& part : parts)
        if (!part.fromFile) {
            alignFor(out, 0);
            place(out, part, out.size);
            append(out, part.bytes);
        }
    if (countOf(out.root, "bufferViews") == 0)
        out.root.erase("bufferViews");
    describeBuffer(document, out);
    return out;
}

} // namespace cotan::gltf_edit
