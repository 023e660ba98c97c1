// Opening a glTF file for changes; images, textures and materials.

#include <fmt/format.h>

#include "edit_state.hpp"
#include "files/bytes.hpp"
#include "mesh.hpp"
#include "nodes.hpp"

namespace cotan {

using namespace gltf_edit;

namespace {

// The reader has no use for attributes that it does not know; copying vertices needs their counts.
void checkCounts(const GltfModel& model)
{
    const auto countOf = [&](int accessor) { return model.accessors[std::size_t(accessor)].accessor.count; };
    for (std::size_t m = 0; m < model.structure.meshes.size(); ++m) {
        const std::vector<gltf::Primitive>& primitives = model.structure.meshes[m].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const int positions = gltf::accessorOf(primitives[p].attributes, "POSITION");
            if (positions < 0)
                continue;
            const std::size_t expected = countOf(positions);
            const auto check = [&](const gltf::Attributes& attributes) {
                for (const auto& [name, accessor] : attributes)
                    if (countOf(accessor) != expected)
                        failGltf("{}.{}: expected {} elements, found {}", primitiveField(m, p), oneLine(name), expected,
                                 countOf(accessor));
            };
            check(primitives[p].attributes);
            for (const gltf::Attributes& target : primitives[p].targets)
                check(target);
        }
    }
}

// What the reader would find wrong with the nodes and the geometry.
void checkModel(GltfModel& model)
{
    readGltfNodes(model);
    for (std::size_t m = 0; m < model.structure.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.structure.meshes[m].primitives.size(); ++p)
            readGltfPrimitive(model, static_cast<int>(m), p, {});
    checkCounts(model);
}

GltfDocument open(const std::filesystem::path& path, const LoadLimits& limits)
{
    GltfModel model;
    model.limits = limits;
    model.file = openGltf(path, limits, model.warnings);
    const std::size_t modelBytes = model.file.size; // buffers are added to it
    readGltfModel(model);
    checkModel(model);

    auto source = std::make_shared<GltfSource>();
    source->path = path;
    source->bytes = modelBytes;
    source->root = std::move(model.file.json);
    source->file = std::move(model.file);
    source->views = std::move(model.views);
    GltfDocument document;
    rootOf(document) = source->root;
    if (!rootOf(document).contains("bufferViews")) // a member that is added later would leave no reference in place
        rootOf(document)["bufferViews"] = Json::array();
    document.source = std::move(source);
    return document;
}

Json withImage(GltfDocument& document, Json image, std::vector<std::byte> bytes, const std::string& mimeType)
{
    image.erase("uri");
    image["bufferView"] = addView(document, std::move(bytes));
    image["mimeType"] = mimeType;
    return image;
}

} // namespace

Result<GltfDocument> openGltfDocument(const std::filesystem::path& file, const LoadLimits& limits)
{
    return caughtGltf(file, [&] { return open(file, limits); });
}

const std::filesystem::path& gltfPath(const GltfDocument& document) { return document.source->path; }

Result<std::vector<std::byte>> gltfImageBytes(const GltfDocument& document, std::size_t image, const LoadLimits& limits)
{
    const gltf::Image entry = gltf::readImage(rootOf(document)["images"][image]);
    if (entry.view >= 0) {
        const auto bytes = viewBytes(document, std::size_t(entry.view));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    }
    const std::string field = fmt::format("images[{}]", image);
    try {
        if (!entry.uri)
            failGltf("{}: expected either uri or bufferView", field);
        GltfResource resource = resolveGltfUri(document.source->file, *entry.uri, field + ".uri");
        if (resource.file.empty())
            return std::move(resource.bytes);
        return readGltfResource(document.source->file, resource.file, limits);
    } catch (const GltfProblem& problem) {
        return inputError(document.source->path.string() + ": " + problem.error.message);
    }
}

void replaceGltfImage(GltfDocument& document, std::size_t image, std::vector<std::byte> bytes,
                      const std::string& mimeType)
{
    rootOf(document)["images"][image] =
        withImage(document, rootOf(document)["images"][image], std::move(bytes), mimeType);
}

std::size_t addGltfImage(GltfDocument& document, std::vector<std::byte> bytes, const std::string& mimeType,
                         const std::string& name)
{
    Json image = Json::object();
    if (!name.empty())
        image["name"] = name;
    image = withImage(document, std::move(image), std::move(bytes), mimeType);
    rootOf(document)["images"].push_back(std::move(image));
    return rootOf(document)["images"].size() - 1;
}

std::size_t copyGltfTexture(GltfDocument& document, std::size_t texture, std::size_t image)
{
    Json copy = rootOf(document)["textures"][texture];
    copy["source"] = image;
    copy.erase("extensions");
    rootOf(document)["textures"].push_back(std::move(copy));
    return rootOf(document)["textures"].size() - 1;
}

std::size_t copyGltfMaterial(GltfDocument& document, std::size_t material)
{
    Json copy = rootOf(document)["materials"][material];
    rootOf(document)["materials"].push_back(std::move(copy));
    return rootOf(document)["materials"].size() - 1;
}

} // namespace cotan
