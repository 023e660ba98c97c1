// Reads Wavefront OBJ files and their material libraries into a Scene.
#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "core/named_values.hpp"
#include "core/try.hpp"
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
    COTAN_TRY(bytes, readFileBytes(file, limits.fileBytes));
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

// ---- material libraries ---------------------------------------------------------------------

// Maximum count of numbers after a map option, of which only the first is required; 0: one word instead.
constexpr Named<std::size_t> kMapOptions[] = {
    {"-blendu", 0}, {"-blendv", 0}, {"-cc", 0}, {"-clamp", 0}, {"-imfchan", 0}, {"-type", 0}, {"-colorspace", 0},
    {"-texres", 0}, {"-boost", 1},  {"-bm", 1}, {"-mm", 2},    {"-o", 3},       {"-s", 3},    {"-t", 3}};

constexpr Named<SourceMap SourceMaterial::*> kMaps[] = {
    {"map_kd", &SourceMaterial::colorMap},          {"map_ke", &SourceMaterial::emissionMap},
    {"map_emissive", &SourceMaterial::emissionMap}, {"map_d", &SourceMaterial::opacityMap},
    {"map_pr", &SourceMaterial::roughnessMap},      {"map_pm", &SourceMaterial::metalnessMap},
    {"norm", &SourceMaterial::normalMap},           {"map_kn", &SourceMaterial::normalMap}};

// Parses options and then a file name, which may contain spaces.
SourceMap readMap(Words words)
{
    SourceMap map;
    glm::vec2 scale(1), offset(0);
    for (std::string_view word = words.peek(); word.starts_with('-'); word = words.peek()) {
        const auto maxNumbers = valueOf(kMapOptions, word);
        if (!maxNumbers)
            break; // a file name that begins with '-'
        words.next();
        std::array<float, 3> numbers{};
        std::size_t count = 0;
        while (count < *maxNumbers)
            if (const auto number = finiteNumber(words.peek())) {
                numbers[count++] = *number;
                words.next();
            } else {
                break;
            }
        if (word == "-bm" && count == 1)
            map.strength = numbers[0];
        if (word == "-s" && count > 0)
            scale = {numbers[0], count > 1 ? numbers[1] : 1.0f};
        if (word == "-o" && count > 0)
            offset = {numbers[0], numbers[1]};
        if (*maxNumbers == 0 && words.next() == "on" && word == "-clamp")
            map.use.sampler.wrapU = map.use.sampler.wrapV = Wrap::clamp;
    }
    // Scale and offset apply to the file's u and v, whose v points up; here v points down.
    map.use.uRow = {scale.x, 0, offset.x};
    map.use.vRow = {0, scale.y, 1 - scale.y - offset.y};
    map.path = words.all();
    return map;
}

// value: a float or an optional float.
template<class Value> bool readNumber(Words words, Value& value)
{
    while (words.peek().starts_with("-halo"))
        words.next();
    const auto number = finiteNumber(words.next());
    if (number)
        value = *number;
    return number.has_value();
}

// A single number means grey.
bool readColor(Words words, glm::vec3& value)
{
    glm::vec3 color;
    for (int c = 0; c < 3; ++c) {
        const std::string_view word = words.next();
        const auto number = c > 0 && word.empty() ? color[0] : finiteNumber(word);
        if (!number)
            return false;
        color[c] = std::max(*number, 0.0f);
    }
    value = color;
    return true;
}

// Returns false for unreadable numbers.
bool readStatement(const std::string& keyword, Words words, SourceMaterial& m)
{
    if (keyword == "kd")
        return readColor(words, m.color);
    if (keyword == "ke")
        return readColor(words, m.emission);
    if (keyword == "ns")
        return readNumber(words, m.shininess);
    if (keyword == "d")
        return readNumber(words, m.opacity);
    if (keyword == "tr") {
        const bool good = readNumber(words, m.opacity);
        m.opacity = good ? 1 - m.opacity : m.opacity;
        return good;
    }
    if (keyword == "pr")
        return readNumber(words, m.roughness);
    if (keyword == "pm")
        return readNumber(words, m.metallic);
    if (const auto map = valueOf(kMaps, keyword))
        m.** map = readMap(words);
    return true;
}

// Reads newmtl, Kd, Ke, Ns, d, Tr, Pr, Pm and the maps map_Kd, map_Ke, map_d, map_Pr, map_Pm, bump (map_Bump) and norm
// (map_Kn), in upper or lower case, with the options -bm, -clamp, -o and -s. Other statements are ignored; statements
// before the first newmtl or with unreadable numbers are left out with a warning. Nothing in a library is an error.
// Source: the MTL specification of the Advanced Visualizer manual; Pr, Pm, norm as in the PBR extension of
// exocortex.com.
std::vector<SourceMaterial> parseMtl(std::string source, const std::string& name, Scene& scene)
{
    const TextLines lines(std::move(source));
    const std::string& text = lines.text();
    std::vector<SourceMaterial> materials; // in file order
    std::vector<SourceMap> bumps;          // one per material; a map of "norm" takes precedence
    std::size_t early = 0, broken = 0, brokenLine = 0;
    for (std::size_t offset = 0; offset < text.size();) {
        const std::size_t end = std::min(text.find('\n', offset), text.size());
        Words words{std::string_view(text).substr(offset, end - offset)};
        const std::string keyword = lowerCase(std::string(words.next()));
        const std::size_t begin = std::exchange(offset, end + 1);
        if (keyword.empty() || keyword.starts_with('#'))
            continue;
        if (keyword == "newmtl") {
            SourceMaterial& material = materials.emplace_back();
            material.name = words.all();
            material.color = glm::vec3(0.6f); // the default without Kd
            bumps.emplace_back();
        } else if (materials.empty()) {
            ++early;
        } else if (keyword == "bump" || keyword == "map_bump") {
            bumps.back() = readMap(words);
        } else if (!readStatement(keyword, words, materials.back())) {
            brokenLine = broken++ == 0 ? lines.number(begin) : brokenLine;
        }
    }
    for (std::size_t i = 0; i < bumps.size(); ++i)
        if (materials[i].normalMap.path.empty())
            materials[i].normalMap = bumps[i];
    if (early > 0)
        scene.warnings.push_back(
            fmt::format("material library {}: {} lines before the first newmtl are left out", name, early));
    if (broken > 0)
        scene.warnings.push_back(
            fmt::format("material library {}: {} lines whose numbers cannot be read are left out, the first is line {}",
                        name, broken, brokenLine));
    return materials;
}

// The materials of the libraries that the model names; the first material of a name is used.
class Library {
public:
    Library(const fs::path& folder, const LoadLimits& limits, Scene& scene)
        : folder_(folder), limits_(limits), scene_(scene)
    {
    }

    // line: the names of one mtllib, one with spaces or several. fallback: the library to read if none of them exists.
    void add(const std::string& line, const std::string& fallback)
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
        const auto beside = findInFolder(folder_, fallback, ignored);
        scene_.warnings.push_back(fmt::format("material library {} {}{}", line,
                                              outside ? "is outside the model's folder; not opened" : "was not found",
                                              beside ? fmt::format("; {} is read instead", fallback) : ""));
        if (beside)
            read(*beside, fallback);
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
        for (SourceMaterial& material : parseMtl(*std::move(text), name, scene_))
            materials_.try_emplace(material.name, std::move(material));
    }

    const fs::path& folder_;
    const LoadLimits& limits_;
    Scene& scene_;
    bool any_ = false;
    std::map<std::string, SourceMaterial> materials_;
};

// Makes the materials; returns the index in Scene::materials of each part.
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
                                             "these parts are grey",
                                             missing, firstMissing));
    return indices;
}

// ---- meshes ---------------------------------------------------------------------------------

// Files store vertex colours in sRGB.
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
        mesh.texcoords[0].emplace_back(stored.x, 1.0f - stored.y); // OBJ has v = 0 at the bottom row of the image
    }
    finishMesh(mesh, "missing", scene);
    return mesh;
}

} // namespace

Result<Scene> loadObj(const fs::path& file, const LoadLimits& limits)
try {
    COTAN_TRY(text, readText(file, limits));
    std::error_code error;
    const fs::path canonical = fs::canonical(file, error);
    if (error)
        return inputError(fmt::format("{}: {}", file.string(), error.message()));
    COTAN_TRY(obj, parseObj(*std::move(text), file.string(), limits));

    Scene scene;
    scene.name = file.filename().string();
    // Textures are beside the target of a link.
    const fs::path folder = canonical.parent_path();
    Library library(folder, limits, scene);
    for (const std::string& line : obj->libraries)
        library.add(line, file.stem().string() + ".mtl");
    TextureReader textures(scene, folder, limits);
    const std::vector<int> materials = makeMaterials(*obj, library, textures, scene);
    if (!obj->texcoords.empty() && obj->polygonsWithoutUv > 0)
        scene.warnings.push_back(fmt::format("{} of {} faces have no texture coordinates; 0 is used",
                                             obj->polygonsWithoutUv, obj->polygons));
    for (std::size_t i = 0; i < obj->parts.size(); ++i) {
        Mesh mesh = makeMesh(*obj, obj->parts[i], scene);
        mesh.material = materials[i];
        warnAboutTexcoords(mesh, scene);
        scene.instances.push_back({mesh.name, int(i), glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the model", file.string()));
}

} // namespace cotan
