// From a changed document to one JSON and one buffer.
#include <algorithm>

#include <fmt/ranges.h>

#include "edit_state.hpp"

namespace cotan::gltf_edit {

namespace {

// Items that the file used, or that were added, and that nothing uses now.
std::vector<bool> released(const GltfDocument& document, Collection collection)
{
    std::vector<bool> before = usedItems(document.source->root, collection);
    if (collection == Collection::bufferViews) // decoded, nothing refers to them
        for (const GltfPacked::Primitive& packed : document.source->file.packed.primitives)
            before[packed.draco["bufferView"].get<std::size_t>()] = true;
    std::vector<bool> removed = usedItems(rootOf(document), collection);
    for (std::size_t i = 0; i < removed.size(); ++i)
        removed[i] = !removed[i] && (i >= before.size() || before[i]);
    return removed;
}

bool any(const std::vector<bool>& flags) { return std::find(flags.begin(), flags.end(), true) != flags.end(); }

// A buffer view with its bytes and where in the file they are.
struct Part {
    std::size_t view = 0; // in the final JSON
    std::span<const std::byte> bytes;
    bool fromFile = false;
    std::size_t buffer = 0, offset = 0;
    const Json* packed = nullptr; // in the file it is compressed, and says this: the bytes are those
};

std::vector<Part> partsOf(const GltfDocument& document)
{
    std::vector<Part> parts(countOf(rootOf(document), "bufferViews"));
    const std::size_t old = document.source->views.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].bytes = viewBytes(document, i);
        parts[i].fromFile = i < old;
        if (!parts[i].fromFile)
            continue;
        if (const Json* const packed = packedView(document, i)) {
            const Json& extension = (*packed)["extensions"][meshoptName(*packed)];
            parts[i].packed = packed;
            parts[i].buffer = extension["buffer"].get<std::size_t>();
            parts[i].offset = gltf::valueOr(extension, "byteOffset", std::size_t(0));
            parts[i].bytes = document.source->file.buffers[parts[i].buffer].subspan(
                parts[i].offset, extension["byteLength"].get<std::size_t>());
            continue;
        }
        const gltf::BufferView view = gltf::readBufferView(document.source->root["bufferViews"][i]);
        parts[i].buffer = view.buffer;
        parts[i].offset = view.offset;
    }
    return parts;
}

void alignFor(std::vector<std::byte>& buffer, std::size_t offset)
{
    buffer.resize((buffer.size() + 3) / 4 * 4 + offset % 4);
}

void place(Layout& out, const Part& part, std::size_t offset)
{
    Json& view = out.root["bufferViews"][part.view];
    if (part.packed) {
        const std::string name = meshoptName(*part.packed);
        view = *part.packed;
        view["buffer"] = 1;
        view["byteOffset"] = out.decoded;
        out.decoded += (view["byteLength"].get<std::size_t>() + 3) / 4 * 4;
        out.packers.insert(name);
        Json& extension = view["extensions"][name];
        extension["buffer"] = 0;
        extension["byteOffset"] = offset;
        return;
    }
    view["buffer"] = 0;
    if (offset > 0 || view.contains("byteOffset"))
        view["byteOffset"] = offset;
}

// The file's views in the order of their bytes. Where views share bytes they go on doing so; bytes
// between views go.
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
        alignFor(out.buffer, begin);
        const std::size_t start = out.buffer.size();
        const auto block = document.source->file.buffers[buffer].subspan(begin, end - begin);
        out.buffer.insert(out.buffer.end(), block.begin(), block.end());
        for (std::size_t i = first; i < last; ++i)
            place(out, parts[i], start + parts[i].offset - begin);
    }
}

// The file's buffer as it is, gaps and all.
void appendWhole(const GltfDocument& document, const std::vector<Part>& parts, Layout& out)
{
    for (const auto& bytes : document.source->file.buffers)
        out.buffer.insert(out.buffer.end(), bytes.begin(), bytes.end());
    for (const Part& part : parts)
        if (part.fromFile)
            place(out, part, part.offset);
}

void describeBuffer(GltfDocument& document, Layout& out)
{
    Json first = Json::object();
    if (const std::size_t count = countOf(out.root, "buffers"); count > 0) {
        first = out.root["buffers"][0];
        if (count > 1 && document.source->file.unpackedBytes.empty()) // else that is how they were decoded
            document.notes.push_back(
                fmt::format("buffers: {} were joined into one; names and extras of the first are kept", count));
    }
    first.erase("uri");
    first["byteLength"] = out.buffer.size();
    if (out.buffer.empty())
        out.root.erase("buffers");
    else
        out.root["buffers"] = Json::array({std::move(first)});
    if (out.decoded == 0)
        return;
    Json fallback = {{"byteLength", out.decoded}}; // where the decoded numbers go: no bytes of the file
    for (const std::string& name : out.packers) {
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
        failGltf("buffers: expected one where an unknown extension ({}) may refer to them, found {}",
                 oneLine(unknown.front()), document.source->file.buffers.size());

    if (removes) {
        if (const auto images = released(document, Collection::images); any(images))
            removeItems(rootOf(document), Collection::images, images);
        if (const auto accessors = released(document, Collection::accessors); any(accessors)) {
            repackViews(document, accessors);
            removeItems(rootOf(document), Collection::accessors, accessors);
        }
    } else {
        document.notes.push_back(fmt::format("nothing is removed: unknown extensions may refer to any data ({})",
                                             oneLine(fmt::format("{}", fmt::join(unknown, ", ")))));
    }

    notePlainViews(document);
    std::vector<Part> parts = partsOf(document);
    if (const auto views = released(document, Collection::bufferViews); removes && any(views)) {
        removeItems(rootOf(document), Collection::bufferViews, views);
        std::vector<Part> kept;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (!views[i])
                kept.push_back(parts[i]);
        parts = std::move(kept);
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i].view = i;

    Layout out{std::move(rootOf(document)), {}, 0, {}};
    if (removes)
        appendFileParts(document, parts, out);
    else
        appendWhole(document, parts, out);
    for (const Part& part : parts)
        if (!part.fromFile) {
            alignFor(out.buffer, 0);
            place(out, part, out.buffer.size());
            out.buffer.insert(out.buffer.end(), part.bytes.begin(), part.bytes.end());
        }
    if (countOf(out.root, "bufferViews") == 0)
        out.root.erase("bufferViews");
    describeBuffer(document, out);
    return out;
}

} // namespace cotan::gltf_edit
