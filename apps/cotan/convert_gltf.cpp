#include "convert_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include "cotan/tangents.hpp"

namespace cotan::app {

namespace {

using Json = nlohmann::ordered_json;

std::size_t countOf(const Json& root, const char* collection)
{
    return root.contains(collection) ? root[collection].size() : 0;
}

glm::dvec3 vectorOr(const Json& node, const char* member, glm::dvec3 otherwise)
{
    if (!node.contains(member))
        return otherwise;
    const Json& v = node[member];
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

// What a node does to vectors.
glm::dmat3 linearOf(const Json& node)
{
    glm::dmat3 m(1);
    if (node.contains("matrix")) {
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                m[column][row] = node["matrix"][std::size_t(4 * column + row)].get<double>();
        return m;
    }
    if (node.contains("rotation")) {
        const Json& q = node["rotation"];
        m = glm::mat3_cast(glm::normalize(
            glm::dquat(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>())));
    }
    const glm::dvec3 scale = vectorOr(node, "scale", glm::dvec3(1));
    for (int k = 0; k < 3; ++k)
        m[k] *= scale[k];
    return m;
}

// Whether the two differ by a rotation, a mirroring and a uniform scale only: all frames go along with these.
bool alike(const glm::dmat3& a, const glm::dmat3& b)
{
    const glm::dmat3 ga = glm::transpose(a) * a, gb = glm::transpose(b) * b;
    const double ta = ga[0][0] + ga[1][1] + ga[2][2], tb = gb[0][0] + gb[1][1] + gb[2][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(ga[i][j] * tb - gb[i][j] * ta) <= 1e-5 * ta * tb))
                return false;
    return true;
}

// For each mesh the linear maps under which it is shown, of those that are alike one.
std::vector<std::vector<glm::dmat3>> placings(const Json& root)
{
    std::vector<std::vector<glm::dmat3>> result(countOf(root, "meshes"));
    const std::size_t nodes = countOf(root, "nodes");
    std::vector<bool> child(nodes, false);
    for (std::size_t n = 0; n < nodes; ++n)
        for (const Json& c : root["nodes"][n].value("children", Json::array()))
            child[c.get<std::size_t>()] = true;
    std::vector<std::pair<std::size_t, glm::dmat3>> open;
    for (std::size_t n = 0; n < nodes; ++n)
        if (!child[n])
            open.emplace_back(n, glm::dmat3(1));
    while (!open.empty()) { // a forest: openGltfDocument has checked it
        const auto [n, above] = open.back();
        open.pop_back();
        const Json& node = root["nodes"][n];
        const glm::dmat3 here = above * linearOf(node);
        for (const Json& c : node.value("children", Json::array()))
            open.emplace_back(c.get<std::size_t>(), here);
        if (!node.contains("mesh"))
            continue;
        auto& known = result[node["mesh"].get<std::size_t>()];
        const glm::dmat3 placed = node.contains("skin") ? glm::dmat3(1) : here; // a skin replaces the node
        if (std::none_of(known.begin(), known.end(), [&, p = placed](const glm::dmat3& k) { return alike(k, p); }))
            known.push_back(placed);
    }
    for (auto& known : result)
        if (known.empty())
            known.push_back(glm::dmat3(1));
    return result;
}

// Unit normals; those that are unit up to rounding keep their bits, which MikkTSpace's welding compares.
void makeUnit(std::vector<glm::vec3>& normals)
{
    for (glm::vec3& n : normals) {
        const double length = glm::length(glm::dvec3(n));
        if (length > 0 && std::abs(length - 1) > 1e-5)
            n = glm::vec3(glm::dvec3(n) / length);
    }
}

// The geometry as a mesh whose uv set 0 is what the normal map reads. Without NORMAL glTF asks for flat ones.
Mesh meshOf(GltfGeometry geometry)
{
    Mesh mesh;
    mesh.positions = std::move(geometry.positions);
    mesh.normals = std::move(geometry.normals);
    mesh.tangents = std::move(geometry.tangents);
    mesh.texcoords[0] = std::move(geometry.texcoords);
    mesh.indices = std::move(geometry.indices);
    makeUnit(mesh.normals);
    if (!mesh.normals.empty())
        return mesh;
    Mesh flat;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 &a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
                        &c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 n = f32::cotan_normalize_or(glm::cross(b - a, c - a), glm::vec3(0));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[i + k];
            flat.positions.push_back(mesh.positions[v]);
            flat.normals.push_back(n);
            if (!mesh.texcoords[0].empty())
                flat.texcoords[0].push_back(mesh.texcoords[0][v]);
            flat.indices.push_back(std::uint32_t(i + k));
        }
    }
    return flat;
}

std::string fieldOf(std::size_t mesh, std::size_t primitive)
{
    return fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
}

// The texture that a primitive's material reads as normal map; null if none.
const Json* normalTextureOf(const Json& root, const Json& primitive)
{
    if (!primitive.contains("material"))
        return nullptr;
    const Json& material = root["materials"][primitive["material"].get<std::size_t>()];
    return material.contains("normalTexture") ? &material["normalTexture"] : nullptr;
}

Wrap wrapOf(const Json& root, const Json& texture, const char* axis)
{
    if (!texture.contains("sampler"))
        return Wrap::repeat;
    const int mode = root["samplers"][texture["sampler"].get<std::size_t>()].value(axis, 10497);
    return mode == 33071 ? Wrap::clamp : mode == 33648 ? Wrap::mirror : Wrap::repeat;
}

// Indices of textures that slots other than normalTexture read.
void collectOther(const Json& object, bool top, std::set<std::size_t>& textures)
{
    if (object.is_array())
        for (const Json& item : object)
            collectOther(item, false, textures);
    if (!object.is_object())
        return;
    for (const auto& [key, value] : object.items()) {
        if (top && key == "normalTexture")
            continue;
        const bool slot = key.size() >= 7 && key.ends_with("exture") && value.is_object() && value.contains("index");
        if (slot && value["index"].is_number_unsigned())
            textures.insert(value["index"].get<std::size_t>());
        collectOther(value, false, textures);
    }
}

bool readElsewhere(const Json& root, std::size_t image)
{
    std::set<std::size_t> textures;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m)
        collectOther(root["materials"][m], true, textures);
    return std::any_of(textures.begin(), textures.end(), [&](std::size_t t) {
        return t < countOf(root, "textures") && root["textures"][t].contains("source")
            && root["textures"][t]["source"].get<std::size_t>() == image;
    });
}

template<class Visit> Status forEachPrimitive(const Json& root, const Visit& visit)
{
    for (std::size_t m = 0; m < countOf(root, "meshes"); ++m)
        for (std::size_t p = 0; p < root["meshes"][m]["primitives"].size(); ++p)
            if (Status status = visit(m, p); !status)
                return status;
    return Done{};
}

} // namespace

Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes)
{
    const Json& root = document.root;
    const auto placed = placings(root);
    std::map<std::size_t, MapJob> jobs;
    const Status status = forEachPrimitive(root, [&](std::size_t m, std::size_t p) -> Status {
        const Json& primitive = root["meshes"][m]["primitives"][p];
        const Json* info = normalTextureOf(root, primitive);
        if (!info)
            return Done{};
        const Json& texture = root["textures"][(*info)["index"].get<std::size_t>()];
        if (!texture.contains("source")) {
            notes.push_back(fieldOf(m, p) + ": its normal map is neither PNG nor JPEG; left as it is");
            return Done{};
        }
        auto geometry = gltfGeometry(document, m, p);
        if (!geometry)
            return geometry.error();
        if (geometry->texcoords.empty() || geometry->indices.empty()) {
            notes.push_back(fieldOf(m, p) + (geometry->indices.empty() ? ": no triangles" : ": no uv for its normal map")
                            + "; its normal map is not converted for it");
            return Done{};
        }
        const std::size_t image = texture["source"].get<std::size_t>();
        MapJob& job = jobs[image];
        job.image = image;
        job.name = root["images"][image].value("name", root["images"][image].value("uri", std::string()));
        if (job.name.empty() || job.name.starts_with("data:"))
            job.name = fmt::format("image {}", image);
        const std::size_t material = primitive["material"].get<std::size_t>();
        if (std::find(job.materials.begin(), job.materials.end(), material) == job.materials.end())
            job.materials.push_back(material);
        const Mesh mesh = meshOf(std::move(*geometry));
        for (const glm::dmat3& linear : placed[m]) {
            MapUse use;
            use.surface = makeSurface(mesh, Texture{}, linear);
            use.format = {0, 0, -1.0, info->value("scale", 1.0)}; // glTF: exact, xyz, green against +v
            use.wrapU = wrapOf(root, texture, "wrapS");
            use.wrapV = wrapOf(root, texture, "wrapT");
            job.uses.push_back(std::move(use));
        }
        return Done{};
    });
    if (!status)
        return status.error();
    std::vector<MapJob> result;
    for (auto& [image, job] : jobs) {
        job.alsoElsewhere = readElsewhere(root, image);
        result.push_back(std::move(job));
    }
    return result;
}

void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> png)
{
    if (!job.alsoElsewhere) {
        replaceGltfImage(document, job.image, std::move(png), "image/png");
        return;
    }
    const std::size_t image = addGltfImage(document, std::move(png), "image/png", job.name);
    std::map<std::size_t, std::size_t> copies;
    for (std::size_t m : job.materials) {
        const std::size_t texture = document.root["materials"][m]["normalTexture"]["index"].get<std::size_t>();
        if (!copies.contains(texture))
            copies[texture] = copyGltfTexture(document, texture, image);
        document.root["materials"][m]["normalTexture"]["index"] = copies[texture];
    }
}

Result<TangentBytes> dropTangents(GltfDocument& document, std::vector<std::string>& notes)
{
    TangentBytes dropped;
    std::set<std::size_t> seen, told;
    const Status status = forEachPrimitive(document.root, [&](std::size_t m, std::size_t p) -> Status {
        const Json& root = document.root;
        const Json& primitive = root["meshes"][m]["primitives"][p];
        if (!primitive["attributes"].contains("TANGENT"))
            return Done{};
        if (primitive.contains("material")) {
            const std::size_t material = primitive["material"].get<std::size_t>();
            const Json& extensions = root["materials"][material].value("extensions", Json::object());
            for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_anisotropy"}) {
                const bool reads = extensions.contains(name)
                    && (name == std::string("KHR_materials_anisotropy") || extensions[name].contains("clearcoatNormalTexture"));
                if (!reads)
                    continue;
                if (told.insert(material).second)
                    notes.push_back(fmt::format("materials[{}]: {} reads tangents and is not converted; TANGENT stays", material, name));
                return Done{};
            }
        }
        auto count = [&](const Json& attributes, bool base) {
            if (!attributes.contains("TANGENT"))
                return;
            const std::size_t index = attributes["TANGENT"].get<std::size_t>();
            if (!seen.insert(index).second)
                return;
            const Json& accessor = root["accessors"][index];
            const int type = accessor["componentType"].get<int>();
            const std::size_t component = type == 5126 ? 4 : type == 5122 || type == 5123 ? 2 : 1;
            const std::size_t vertices = accessor["count"].get<std::size_t>();
            dropped.vertices += base ? vertices : 0;
            dropped.bytes += vertices * component * (base ? 4 : 3);
        };
        count(primitive["attributes"], true);
        for (const Json& target : primitive.value("targets", Json::array()))
            count(target, false);
        const auto done = dropGltfTangents(document, m, p);
        if (!done)
            return done.error();
        dropped.primitives += *done;
        return Done{};
    });
    if (!status)
        return status.error();
    return dropped;
}

Result<std::size_t> giveTangents(GltfDocument& document, Frame frame)
{
    std::vector<GltfCornerTangents> all;
    const Status status = forEachPrimitive(document.root, [&](std::size_t m, std::size_t p) -> Status {
        if (!normalTextureOf(document.root, document.root["meshes"][m]["primitives"][p]))
            return Done{};
        auto geometry = gltfGeometry(document, m, p);
        if (!geometry)
            return geometry.error();
        if (geometry->normals.empty() || geometry->texcoords.empty() || geometry->indices.empty())
            return Done{};
        makeUnit(geometry->normals);
        const MeshView view{geometry->positions, geometry->normals, geometry->texcoords, geometry->indices};
        all.push_back({m, p, frame == Frame::vertex ? vertexTangents(view) : mikktspaceTangents(view)});
        return Done{};
    });
    if (!status)
        return status.error();
    if (const auto added = setGltfTangents(document, all); !added)
        return added.error();
    return all.size();
}

} // namespace cotan::app
