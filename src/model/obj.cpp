// Wavefront OBJ files to Scene.
#include <algorithm>
#include <map>
#include <new>
#include <system_error>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "cotan/model.hpp"
#include "cotan/portable.hpp"
#include "files/bytes.hpp"
#include "obj_text.hpp"
#include "source_material.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

Result<std::string> readText(const fs::path& file, const LoadLimits& limits)
{
    const auto bytes = readFileBytes(file, limits.fileBytes);
    if (!bytes)
        return bytes.error();
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

// ---- materials ------------------------------------------------------------------------------

// The materials of the libraries that the model names; the first of a name counts.
class Library {
public:
    Library(const fs::path& folder, const LoadLimits& limits, Scene& scene)
        : folder_(folder), limits_(limits), scene_(scene)
    {
    }

    // line: of one mtllib, a name with spaces or several names. otherwise: the library that is
    // taken where that is missing.
    void add(const std::string& line, const std::string& otherwise)
    {
        bool outside = false;
        if (const auto file = findInFolder(folder_, line, outside))
            return read(*file, line);
        bool any = false;
        Words words{line};
        for (std::string name(words.next()); !name.empty(); name = words.next()) {
            bool away = false;
            if (const auto file = findInFolder(folder_, name, away)) {
                read(*file, name);
                any = true;
            }
        }
        if (any)
            return;
        bool ignored = false;
        const auto beside = findInFolder(folder_, otherwise, ignored);
        scene_.warnings.push_back(fmt::format("material library {} {}{}", line,
                                              outside ? "is outside the model's folder; not opened" : "was not found",
                                              beside ? fmt::format("; {} is read in its place", otherwise) : ""));
        if (beside)
            read(*beside, otherwise);
    }

    bool any() const { return any_; }

    const SourceMaterial* find(const std::string& name) const
    {
        const auto found = materials_.find(name);
        return found == materials_.end() ? nullptr : &found->second;
    }

private:
    void read(const fs::path& file, const std::string& name)
    {
        auto text = readText(file, limits_);
        if (!text) {
            scene_.warnings.push_back(fmt::format("material library {}", text.error().message));
            return;
        }
        any_ = true;
        MtlText parsed = parseMtl(*std::move(text));
        for (const std::string& warning : parsed.warnings)
            scene_.warnings.push_back(fmt::format("material library {}: {}", name, warning));
        for (SourceMaterial& material : parsed.materials)
            materials_.try_emplace(material.name, std::move(material));
    }

    const fs::path& folder_;
    const LoadLimits& limits_;
    Scene& scene_;
    bool any_ = false;
    std::map<std::string, SourceMaterial> materials_;
};

// For every part its index in Scene::materials.
std::vector<int> makeMaterials(const ObjText& obj, const Library& library, TextureReader& textures, Scene& scene)
{
    SourceMaterial plain;
    plain.name = "default";
    plain.color = glm::vec3(0.6f);
    std::map<const SourceMaterial*, int> made;
    std::vector<int> indices;
    std::size_t missing = 0;
    std::string firstMissing;
    for (const ObjPart& part : obj.parts) {
        const SourceMaterial* source = library.find(part.material);
        if (!source && !part.material.empty() && missing++ == 0)
            firstMissing = part.material;
        const auto [entry, isNew] = made.try_emplace(source, int(scene.materials.size()));
        if (isNew)
            scene.materials.push_back(makeMaterial(source ? *source : plain, textures, scene));
        indices.push_back(entry->second);
    }
    if (missing > 0 && library.any())
        scene.warnings.push_back(fmt::format("{} parts name materials that no library has, the first is \"{}\"; "
                                             "they are grey",
                                             missing, firstMissing));
    return indices;
}

// ---- meshes ---------------------------------------------------------------------------------

// Files hold vertex colours as they are seen: sRGB.
glm::vec4 linearColor(glm::vec4 stored)
{
    const glm::vec4 c = glm::clamp(stored, 0.0f, 1.0f);
    return {f32::cotan_srgb_to_linear(c.x), f32::cotan_srgb_to_linear(c.y), f32::cotan_srgb_to_linear(c.z), c.w};
}

Mesh makeMesh(const ObjText& obj, const ObjPart& part, Scene& scene)
{
    Mesh mesh;
    mesh.name = part.name.empty() ? scene.name : part.name;
    const bool uv = std::ranges::any_of(part.corners, [](const ObjCorner& c) { return c.texcoord != kObjNone; });
    const bool normals = std::ranges::any_of(part.corners, [](const ObjCorner& c) { return c.normal != kObjNone; });
    for (const ObjCorner& corner : part.corners) {
        mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.push_back(obj.positions[corner.position]);
        if (!obj.colors.empty())
            mesh.colors.push_back(linearColor(obj.colors[corner.position]));
        if (normals)
            mesh.normals.push_back(corner.normal == kObjNone ? glm::vec3(0) : obj.normals[corner.normal]);
        if (!uv)
            continue;
        const glm::vec2 stored = corner.texcoord == kObjNone ? glm::vec2(0) : obj.texcoords[corner.texcoord];
        mesh.texcoords[0].emplace_back(stored.x, 1.0f - stored.y); // v = 0 is the bottom row of the picture there
    }
    finishMesh(mesh, "missing", scene);
    return mesh;
}

Result<Scene> load(const fs::path& file, const LoadLimits& limits)
{
    auto text = readText(file, limits);
    if (!text)
        return text.error();
    std::error_code error;
    const fs::path canonical = fs::canonical(file, error);
    if (error)
        return inputError(fmt::format("{}: {}", file.string(), error.message()));
    const auto obj = parseObj(*std::move(text), file.string(), limits);
    if (!obj)
        return obj.error();

    Scene scene;
    scene.name = file.filename().string();
    // A link to a model elsewhere: its textures lie beside the model.
    const fs::path folder = canonical.parent_path();
    Library library(folder, limits, scene);
    for (const std::string& line : obj->libraries)
        library.add(line, file.stem().string() + ".mtl");
    TextureReader textures(scene, folder, limits);
    const std::vector<int> materials = makeMaterials(*obj, library, textures, scene);
    if (!obj->texcoords.empty() && obj->polygonsWithoutUv > 0)
        scene.warnings.push_back(fmt::format("{} of {} faces have no texture coordinates; theirs are 0",
                                             obj->polygonsWithoutUv, obj->polygons));
    for (std::size_t i = 0; i < obj->parts.size(); ++i) {
        Mesh mesh = makeMesh(*obj, obj->parts[i], scene);
        mesh.material = materials[i];
        warnAboutTexcoords(mesh, scene);
        scene.instances.push_back({mesh.name, int(i), glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
}

} // namespace

Result<Scene> loadObj(const fs::path& file, const LoadLimits& limits)
{
    try {
        return load(file, limits);
    } catch (const std::bad_alloc&) {
        return inputError(fmt::format("{}: not enough memory for the model", file.string()));
    }
}

} // namespace cotan
