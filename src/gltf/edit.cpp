// Opens a glTF file for editing; reads its geometry; edits images, textures and materials.
#include <numeric>

#include "core/one_line.hpp"
#include "cotan/vector.hpp"
#include "edit_state.hpp"
#include "gltf_model.hpp"
#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace gltf_edit {

std::span<const std::byte> viewBytes(const GltfDocument& document, std::size_t view)
{
    const std::vector<gltf::ViewBytes>& old = document.source->views;
    return view < old.size() ? old[view].bytes : *document.added[view - old.size()];
}

gltf::Elements elementsOf(const GltfDocument& document, const Json& accessor)
{
    const auto bytesOf = [&](std::size_t view) {
        return gltf::ViewBytes{viewBytes(document, view),
                               gltf::valueOr(rootOf(document)["bufferViews"][view], "byteStride", std::size_t(0))};
    };
    return gltf::findElements(gltf::readAccessor(accessor), bytesOf, "accessor");
}

std::vector<std::uint32_t> readTriangles(const GltfDocument& document, const gltf::Primitive& primitive)
{
    const Json& accessors = rootOf(document)["accessors"];
    const int positions = gltf::accessorOf(primitive.attributes, "POSITION");
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
        const gltf::Elements indices = elementsOf(document, accessors[std::size_t(primitive.indices)]);
        order.resize(indices.accessor.count);
        gltf::readNumbers(indices, order.size(), 1, order.data());
    } else if (positions >= 0) {
        order.resize(accessors[std::size_t(positions)]["count"].get<std::size_t>());
        std::iota(order.begin(), order.end(), 0u);
    }
    return gltfTriangles(primitive.mode, std::move(order));
}

std::size_t addView(GltfDocument& document, std::vector<std::byte> bytes, std::size_t stride, int target)
{
    Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (stride > 0)
        view["byteStride"] = stride;
    if (target > 0)
        view["target"] = target;
    document.added.push_back(std::make_shared<const std::vector<std::byte>>(std::move(bytes)));
    return addItem(document, "bufferViews", std::move(view));
}

} // namespace gltf_edit

using namespace gltf_edit;

namespace {

// The reader ignores unknown attributes, but copying vertices relies on their counts.
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

// Reads all nodes and geometry, and so finds the errors that loading would find there.
void checkGeometry(GltfModel& model)
{
    readGltfNodes(model);
    for (std::size_t m = 0; m < model.structure.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.structure.meshes[m].primitives.size(); ++p)
            readGltfPrimitive(model, int(m), p, {});
}

// model: its geometry is checked.
GltfDocument documentOf(GltfModel model, const std::filesystem::path& path)
{
    checkCounts(model);
    auto source = std::make_shared<GltfSource>();
    source->path = path;
    source->file = std::move(model.file);
    source->views = std::move(model.views);
    GltfDocument document;
    rootOf(document) = source->file.json;
    if (!rootOf(document).contains("bufferViews")) // adding the member later would invalidate references
        rootOf(document)["bufferViews"] = Json::array();
    document.source = std::move(source);
    return document;
}

// The model that the document is now; the document has the bytes.
GltfModel modelOf(const GltfDocument& document, const LoadLimits& limits)
{
    const GltfFile& source = document.source->file;
    GltfModel model;
    model.limits = limits;
    model.file.readFile = source.readFile;
    model.file.folder = source.folder;
    model.file.size = source.size;
    model.file.unpacked = source.unpacked;
    for (const auto& bytes : document.added)
        model.file.size += bytes->size();
    model.file.json = rootOf(document);
    std::size_t at = 0;
    model.views = gltf::readAll(&model.file.json, "bufferViews", [&](const Json& json) {
        return gltf::ViewBytes{viewBytes(document, at++), gltf::readBufferView(json).stride};
    });
    interpretGltfModel(model);
    for (gltf::Image& image : model.structure.images) { // decoders get the names that convert uses
        if (image.name.empty() && image.uri && !image.uri->starts_with("data:"))
            image.name = *image.uri;
        image.named = !image.name.empty();
    }
    return model;
}

Json withImage(GltfDocument& document, Json image, std::vector<std::byte> bytes, const std::string& mimeType)
{
    image.erase("uri");
    image["bufferView"] = addView(document, std::move(bytes));
    image["mimeType"] = mimeType;
    return image;
}

GltfGeometry readGeometry(const GltfDocument& document, const Json& source, const std::string& field, NormalSlot slot,
                          std::optional<std::size_t> material, TexcoordSpace space)
{
    gltf::Primitive primitive = gltf::readPrimitive(source);
    if (material)
        primitive.material = int(*material);
    const gltf::TextureUse map = primitive.material < 0
        ? gltf::TextureUse{}
        : normalMapOf(rootOf(document), std::size_t(primitive.material), slot);
    const int positions = gltf::accessorOf(primitive.attributes, "POSITION");
    GltfGeometry out;
    if (positions < 0) // other attributes have not been checked
        return out;
    out.indices = readTriangles(document, primitive);
    const auto count = rootOf(document)["accessors"][std::size_t(positions)]["count"].get<std::size_t>();
    const std::vector<std::uint32_t> vertices = takeUsedVertices(out.indices, count);
    const gltf::Choice choice(count, vertices);
    const auto read = [&]<class Vector>(std::vector<Vector>& to, const std::string& name) {
        const int a = gltf::accessorOf(primitive.attributes, name);
        if (a >= 0)
            to = gltf::readVectors<Vector>(elementsOf(document, rootOf(document)["accessors"][std::size_t(a)]), choice,
                                           {a, field + "." + name});
    };
    read(out.positions, "POSITION");
    read(out.normals, "NORMAL");
    read(out.tangents, "TANGENT");
    out.texcoordSet = map.texcoord;
    read(out.texcoords, fmt::format("TEXCOORD_{}", map.texcoord));
    for (glm::vec2& uv : out.texcoords)
        if (!isFinite(uv))
            uv = glm::vec2(0);
    if (space == TexcoordSpace::map && map.moves()) {
        transformTangents(out.tangents, {out.positions, out.normals, out.texcoords, out.indices}, map.uRow, map.vRow);
        for (glm::vec2& uv : out.texcoords)
            uv = moveUv(map.uRow, map.vRow, uv);
    }
    return out;
}

} // namespace

Result<GltfDocument> openGltfDocument(const std::filesystem::path& file, const LoadLimits& limits)
{
    return caughtGltf(file, [&] {
        GltfModel model;
        readGltfModel(model, file, limits);
        checkGeometry(model);
        return documentOf(std::move(model), file);
    });
}

Result<OpenGltf> openGltf(const std::filesystem::path& file, const LoadLimits& limits)
{
    return caughtGltf(file, [&] {
        GltfModel model;
        readGltfModel(model, file, limits);
        Scene scene = buildGltfScene(model, file);
        return OpenGltf{documentOf(std::move(model), file), std::move(scene)};
    });
}

Result<Scene> gltfScene(const GltfDocument& document, const LoadLimits& limits)
{
    return caughtGltf(document.source->path, [&] {
        GltfModel model = modelOf(document, limits);
        return buildGltfScene(model, document.source->path);
    });
}

Result<Scene> gltfSceneOfVariants(const GltfDocument& document, const LoadLimits& limits)
{
    return caughtGltf(document.source->path, [&] {
        GltfModel model = modelOf(document, limits);
        addVariantMaterials(model);
        return buildGltfScene(model, document.source->path);
    });
}

const std::filesystem::path& gltfPath(const GltfDocument& document) { return document.source->path; }

Result<GltfGeometry> gltfGeometry(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                  NormalSlot slot, std::optional<std::size_t> material, TexcoordSpace space)
{
    return caughtGltf(document.source->path, [&] {
        return readGeometry(document, rootOf(document)["meshes"][mesh]["primitives"][primitive],
                            primitiveField(mesh, primitive), slot, material, space);
    });
}

Result<std::vector<std::byte>> gltfImageBytes(const GltfDocument& document, std::size_t image, const LoadLimits& limits)
try {
    const gltf::Image entry = gltf::readImage(rootOf(document)["images"][image]);
    if (entry.view >= 0) {
        const auto bytes = viewBytes(document, std::size_t(entry.view));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    }
    const std::string field = fmt::format("images[{}]", image);
    if (!entry.uri)
        failGltf("{}: expected either uri or bufferView", field);
    GltfResource resource = resolveGltfUri(document.source->file, *entry.uri, field + ".uri");
    if (resource.file.empty())
        return std::move(resource.bytes);
    return readGltfResource(document.source->file, resource.file, limits);
} catch (const GltfProblem& problem) {
    return inputError(fileOf(document) + problem.error.message);
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
    return addItem(document, "images", withImage(document, std::move(image), std::move(bytes), mimeType));
}

std::size_t copyGltfTexture(GltfDocument& document, std::size_t texture, std::size_t image)
{
    Json copy = rootOf(document)["textures"][texture];
    copy["source"] = image;
    copy.erase("extensions");
    return addItem(document, "textures", std::move(copy));
}

std::size_t copyGltfMaterial(GltfDocument& document, std::size_t material)
{
    return addItem(document, "materials", rootOf(document)["materials"][material]);
}

} // namespace cotan
