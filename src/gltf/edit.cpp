// Opening a glTF file for changes; images, textures and materials.
#include <new>
#include <system_error>

#include "cotan/files/bytes.hpp"
#include "edit_state.hpp"
#include "mesh.hpp"
#include "nodes.hpp"

namespace cotan {

using namespace gltf_edit;

namespace {

// The reader has no use for attributes that it does not know; copying vertices needs their counts.
void checkCounts(const OrderedJson& root)
{
    for (std::size_t m = 0; m < countOf(root, "meshes"); ++m) {
        const OrderedJson& primitives = root["meshes"][m]["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const OrderedJson& attributes = primitives[p]["attributes"];
            if (!attributes.contains("POSITION"))
                continue;
            const auto countOfAccessor = [&](const OrderedJson& index) {
                return root["accessors"][index.get<std::size_t>()]["count"].get<std::size_t>();
            };
            const std::size_t expected = countOfAccessor(attributes["POSITION"]);
            const auto check = [&](const OrderedJson& map) {
                for (const auto& [name, index] : map.items())
                    if (countOfAccessor(index) != expected)
                        failGltf("meshes[{}].primitives[{}].{}: expected {} elements, found {}", m,
                                 p, oneLine(name), expected, countOfAccessor(index));
            };
            check(attributes);
            for (const OrderedJson& target :
                 primitives[p].value("targets", OrderedJson::array()))
                check(target);
        }
    }
}

void refuseMeshopt(const OrderedJson& root)
{
    for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        for (const std::string& found : unknownExtensions(root))
            if (found == name)
                failGltf("its buffers are compressed ({}); expected plain buffers", name);
}

// What the reader would find wrong with the structure and the geometry.
void checkModel(GltfModel& model)
{
    model.tiny = parseGltfStructure(model.file.json);
    checkGltfAccessors(model);
    readGltfNodes(model);
    for (std::size_t m = 0; m < model.tiny.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.tiny.meshes[m].primitives.size(); ++p)
            readGltfPrimitive(model, static_cast<int>(m), p, {});
}

GltfDocument open(const std::filesystem::path& path, const LoadLimits& limits)
{
    GltfModel model;
    model.limits = limits;
    model.file = openGltf(path, limits, model.warnings, /*keepOrder*/ true);
    const std::size_t modelBytes = model.file.size; // buffers are added to it
    refuseMeshopt(model.file.ordered);
    checkGltfShape(model.file.json, limits, model.warnings);
    loadGltfBuffers(model.file, limits);
    checkModel(model);
    checkCounts(model.file.ordered);

    auto source = std::make_shared<GltfSource>();
    source->path = path;
    source->bytes = modelBytes;
    source->root = std::move(model.file.ordered);
    source->file = std::move(model.file);
    source->file.json = nullptr;
    GltfDocument document;
    document.root = source->root;
    document.source = std::move(source);
    return document;
}

OrderedJson withImage(GltfDocument& document, OrderedJson image, std::vector<std::byte> bytes,
                      const std::string& mimeType)
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

Result<std::vector<std::byte>> gltfImageBytes(const GltfDocument& document, std::size_t image,
                                              const LoadLimits& limits)
{
    const OrderedJson& entry = document.root["images"][image];
    if (entry.contains("bufferView")) {
        const auto bytes = viewBytes(document, entry["bufferView"].get<std::size_t>());
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    }
    const std::string field = fmt::format("images[{}]", image);
    try {
        if (!entry.contains("uri"))
            failGltf("{}: expected either uri or bufferView", field);
        GltfResource resource = resolveGltfUri(
            document.source->file, entry["uri"].get_ref<const std::string&>(), field + ".uri");
        if (resource.file.empty())
            return std::move(resource.bytes);
        return readGltfResource(document.source->file, resource.file, limits);
    } catch (const GltfProblem& problem) {
        return inputError(document.source->path.string() + ": " + problem.message);
    }
}

void replaceGltfImage(GltfDocument& document, std::size_t image, std::vector<std::byte> bytes,
                      const std::string& mimeType)
{
    document.root["images"][image] =
        withImage(document, document.root["images"][image], std::move(bytes), mimeType);
}

std::size_t addGltfImage(GltfDocument& document, std::vector<std::byte> bytes,
                         const std::string& mimeType, const std::string& name)
{
    OrderedJson image = OrderedJson::object();
    if (!name.empty())
        image["name"] = name;
    image = withImage(document, std::move(image), std::move(bytes), mimeType);
    document.root["images"].push_back(std::move(image));
    return document.root["images"].size() - 1;
}

std::size_t copyGltfTexture(GltfDocument& document, std::size_t texture, std::size_t image)
{
    OrderedJson copy = document.root["textures"][texture];
    copy["source"] = image;
    copy.erase("extensions");
    document.root["textures"].push_back(std::move(copy));
    return document.root["textures"].size() - 1;
}

std::size_t copyGltfMaterial(GltfDocument& document, std::size_t material)
{
    OrderedJson copy = document.root["materials"][material];
    document.root["materials"].push_back(std::move(copy));
    return document.root["materials"].size() - 1;
}

} // namespace cotan
