#include "bake/convert/map_jobs.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "bake/convert/choose_primitives.hpp"
#include "core/try.hpp"
#include "cotan/image.hpp"
#include "gltf/json/lookup.hpp"

namespace cotan {

using gltf::Json;

std::string imageName(const Json& root, std::size_t image)
{
    if (image >= countOf(root, "images"))
        return "a map in an unknown format";
    const std::string name = root["images"][image].value("name", root["images"][image].value("uri", std::string()));
    return name.empty() || name.starts_with("data:") ? fmt::format("image {}", image) : name;
}

namespace {

// The images that materials read in slots other than those of normal maps.
std::set<int> imagesReadElsewhere(const Json& root)
{
    std::set<std::size_t> textures;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m)
        textures.merge(texturesBesideNormalMaps(root["materials"][m]));
    std::set<int> images;
    for (const std::size_t t : textures)
        if (t < countOf(root, "textures"))
            images.insert(textureAt(root, int(t)).image);
    return images;
}

// Makes the image the texture's own, and removes the images that extensions name instead.
void dropOtherForms(Json& root, std::size_t index, std::size_t image, std::vector<std::string>& notes)
{
    Json& texture = root["textures"][index];
    texture["source"] = image;
    if (!texture.contains("extensions") || !texture["extensions"].is_object())
        return;
    Json kept = Json::object();
    std::vector<std::string> dropped;
    for (const auto& [name, value] : texture["extensions"].items())
        if (!value.is_object() || !value.contains("source")) {
            kept[name] = value;
        } else {
            dropped.push_back(name);
            if (value["source"] != image)
                notes.push_back(fmt::format("textures[{}]: {} removed: its image is not converted", index, name));
        }
    if (kept.empty())
        texture.erase("extensions");
    else
        texture["extensions"] = std::move(kept);
    for (const std::string& name : dropped)
        if (std::ranges::none_of(root["textures"], [&](const Json& t) { return gltf::extension(t, name); }))
            takeOffExtension(root, name);
}

// Lets an extension name a texture's image, and the document require it: without it, readers cannot read the image.
void nameSource(Json& root, std::size_t texture, std::size_t image, const std::string& extension)
{
    if (extension.empty())
        return;
    root["textures"][texture].erase("source");
    root["textures"][texture]["extensions"][extension]["source"] = image;
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        if (std::ranges::find(root[list], Json(extension)) == root[list].end())
            root[list].push_back(extension);
}

// The factor on the slopes; 0 for a coat whose factor is 0.
double strengthOf(const Json& material, const gltf::TextureUse& map, NormalSlot slot)
{
    const Json* const coat = gltf::extension(material, "KHR_materials_clearcoat");
    return slot == NormalSlot::coat && coat->value("clearcoatFactor", 0.0) <= 0 ? 0 : map.scale;
}

const char* whatOf(NormalSlot slot) { return slot == NormalSlot::coat ? "its coat's normal map" : "its normal map"; }

// The primitive's mesh with the uv of its own normal map as set 0 and, for a coat, those of the coat's map as set 1.
// Sets `why` if there are no triangles or no uv for the map.
Result<Mesh> meshFor(const GltfDocument& document, std::size_t m, std::size_t p, MapSlot slot, std::string& why)
{
    const NormalSlot kind = slot.kind;
    COTAN_TRY(geometry, gltfGeometry(document, m, p, NormalSlot::surface, slot.material));
    Mesh mesh = gltfMesh(std::move(*geometry));
    if (kind == NormalSlot::coat) {
        COTAN_TRY(coat, gltfGeometry(document, m, p, kind, slot.material));
        mesh.texcoords[1] = std::move(gltfMesh(std::move(*coat)).texcoords[0]);
    }
    if (mesh.indices.empty())
        why = "no triangles";
    else if (mesh.texcoords[kind == NormalSlot::coat ? 1 : 0].empty())
        why = std::string("no uv for ") + whatOf(kind);
    return mesh;
}

// The image of a texture, or the one that an unknown extension names; -1 if there is none.
int anyImage(const Json& root, int texture)
{
    if (const int image = textureAt(root, texture).image; image >= 0)
        return image;
    const Json& json = root["textures"][std::size_t(texture)];
    if (json.contains("extensions"))
        for (const Json& extension : json["extensions"])
            if (extension.is_object() && extension.contains("source") && extension["source"].is_number_unsigned()
                && extension["source"] < countOf(root, "images"))
                return extension["source"];
    return -1;
}

// Adds one primitive with one of its materials to the job of a normal map of that material.
Status addUse(const GltfDocument& document, std::size_t m, std::size_t p, MapSlot slot, bool foreign,
              const std::vector<glm::dmat3>& transforms, std::map<std::size_t, MapJob>& jobs,
              std::vector<std::string>& notes)
{
    const Json& root = rootOf(document);
    const gltf::TextureUse map = normalMapOf(root, slot.material, slot.kind);
    if (map.texture < 0)
        return Done{};
    if (foreign) {
        notes.push_back(
            fmt::format("{}: {} is in an unsupported format; left unchanged", primitiveField(m, p), whatOf(slot.kind)));
        return Done{};
    }
    std::string why;
    COTAN_TRY(mesh, meshFor(document, m, p, slot, why));
    if (!why.empty()) {
        notes.push_back(
            fmt::format("{}: {}; {} is not converted for it", primitiveField(m, p), why, whatOf(slot.kind)));
        return Done{};
    }
    const gltf::Texture texture = textureAt(root, map.texture);
    const Sampler sampler = samplerOf(root, texture);
    const auto image = std::size_t(anyImage(root, map.texture));
    MapJob& job = jobs[image];
    job.image = image;
    job.name = imageName(root, image);
    if (std::ranges::find(job.slots, slot) == job.slots.end())
        job.slots.push_back(slot);
    job.readers.push_back({.mesh = m,
                           .primitive = p,
                           .slot = slot,
                           .strength = strengthOf(root["materials"][slot.material], map, slot.kind),
                           .wrapU = sampler.wrapU,
                           .wrapV = sampler.wrapV,
                           .transforms = transforms,
                           .vertices = mesh->vertexCount(),
                           .triangles = mesh->triangleCount(),
                           .stored = !mesh->tangents.empty(),
                           .green = storedGreen(*mesh, mesh->texcoords[0])});
    return Done{};
}

} // namespace

std::vector<MapSlot> foreignNormalMaps(const GltfDocument& document, const LoadLimits& limits)
{
    const Json& root = rootOf(document);
    std::map<int, bool> images = {{-1, true}};
    std::vector<MapSlot> foreign;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m)
        for (const NormalSlot slot : kNormalSlots) {
            const gltf::TextureUse map = normalMapOf(root, m, slot);
            if (map.texture < 0)
                continue;
            const int image = textureAt(root, map.texture).image;
            if (!images.contains(image)) {
                const auto bytes = gltfImageBytes(document, std::size_t(image), limits);
                images[image] = bytes && !unreadableFormat(*bytes, limits).empty();
            }
            if (images[image])
                foreign.push_back({m, slot});
        }
    return foreign;
}

std::vector<UnreadMap> unreadNormalMaps(const GltfDocument& document, const LoadLimits& limits)
{
    const Json& root = rootOf(document);
    std::set<int> images;
    for (const MapSlot& slot : foreignNormalMaps(document, limits))
        images.insert(anyImage(root, normalMapOf(root, slot.material, slot.kind).texture));
    std::vector<UnreadMap> unread;
    for (const int image : images)
        if (image >= 0)
            if (const auto bytes = gltfImageBytes(document, std::size_t(image), limits)) {
                const std::string format = unreadableFormat(*bytes);
                unread.push_back(
                    {std::size_t(image), imageName(root, std::size_t(image)),
                     format.empty() ? "an unknown format" : format,
                     format.starts_with("KTX2")
                         ? "make it PNG with \"gltf-transform ktxdecompress IN.glb OUT.glb\", convert, and "
                           "compress it again"
                         : "make it PNG or JPEG, and convert again"});
            }
    return unread;
}

Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes,
                                    const LoadLimits& limits, bool unread)
{
    const Json& root = rootOf(document);
    const auto transforms = gltfMeshTransforms(root);
    const std::vector<MapSlot> foreign = unread ? std::vector<MapSlot>() : foreignNormalMaps(document, limits);
    std::map<std::size_t, MapJob> jobs;
    const Status status = forEachPrimitive(root, [&](std::size_t m, std::size_t p) -> Status {
        for (const std::size_t material : materialsOf(root, root["meshes"][m]["primitives"][p]))
            for (const NormalSlot kind : kNormalSlots) {
                const MapSlot slot{material, kind};
                const bool isForeign = std::binary_search(foreign.begin(), foreign.end(), slot);
                COTAN_CHECK(addUse(document, m, p, slot, isForeign, transforms[m], jobs, notes));
            }
        return Done{};
    });
    if (!status)
        return status.error();
    const std::set<int> elsewhere = imagesReadElsewhere(root);
    for (std::size_t t = 0; t < countOf(root, "textures"); ++t)
        if (const auto job = jobs.find(std::size_t(anyImage(root, int(t)))); job != jobs.end())
            job->second.textures.push_back(t);
    std::vector<MapJob> result;
    for (auto& [image, job] : jobs) {
        job.alsoElsewhere = elsewhere.contains(int(image));
        StoredGreen whole;
        for (const MapReader& reader : job.readers)
            whole.add(reader.green);
        for (MapReader& reader : job.readers) {
            reader.reversed = readsReversed(reader.green, whole);
            const Json& material = root["materials"][reader.slot.material];
            reader.keeps = reader.stored
                && (!gltf::tangentRequirement(material).empty()
                    || (reader.reversed && !gltf::tangentReader(material).empty()));
        }
        result.push_back(std::move(job));
    }
    return result;
}

std::size_t surfacesOf(const MapJob& job)
{
    std::size_t count = 0;
    for (const MapReader& reader : job.readers)
        count += reader.transforms.size();
    return count;
}

Status reverseBitangents(GltfDocument& document, std::size_t mesh, std::size_t primitive)
{
    COTAN_TRY(geometry,
              gltfGeometry(document, mesh, primitive, NormalSlot::surface, std::nullopt, TexcoordSpace::file));
    GltfCornerTangents tangents{mesh, primitive, {}};
    for (const std::uint32_t i : geometry->indices)
        tangents.corners.push_back(geometry->tangents[i] * glm::vec4(1, 1, 1, -1));
    const auto set = setGltfTangents(document, {&tangents, 1});
    return set ? Status(Done{}) : set.error();
}

GreenWithoutTangents greenWithoutTangents(const MapJob& job)
{
    bool reversed = false, declared = false;
    for (const MapReader& reader : job.readers)
        if (std::abs(reader.strength) > kFlattened && !reader.follows)
            (reader.reversed && !reader.keeps ? reversed : declared) = true;
    return !reversed ? GreenWithoutTangents::declared
        : declared   ? GreenWithoutTangents::both
                     : GreenWithoutTangents::reversed;
}

Result<std::vector<MapUse>> usesOf(const GltfDocument& document, const MapJob& job, const FramePair& frames)
{
    std::vector<MapUse> uses;
    for (const MapReader& r : job.readers) {
        std::string why;
        COTAN_TRY(mesh, meshFor(document, r.mesh, r.primitive, r.slot, why));
        const auto held = std::make_shared<const Mesh>(*std::move(mesh));
        FramePair used = frames;
        used.to = r.readWith.value_or(frames.to);
        const FrameSet read = framesRead(used, r.stored);
        const MappedSurface surface = r.slot.kind == NormalSlot::coat
            ? makeCoatSurface(held, Texture{}, Texture{.image = 0, .texcoord = 1, .sampler = {}}, read)
            : makeSurface(held, Texture{}, glm::dmat3(1), read);
        for (const glm::dmat3& linear : r.transforms)
            uses.push_back({placedBy(surface, linear), Convention{}, r.strength, r.wrapU, r.wrapV, r.readWith});
    }
    return uses;
}

std::size_t bytesOf(const MapJob& job, const FramePair& frames)
{
    constexpr std::size_t kVertex = sizeof(glm::vec3) * 2 + sizeof(glm::vec2);
    std::size_t kept = 0, most = 0, rasters = 0; // rasters: after all surfaces are made
    for (const MapReader& r : job.readers) {
        const SurfaceBytes bytes = surfaceBytes(r.vertices, r.triangles, framesRead(frames, r.stored));
        const std::size_t indices = 3 * sizeof(std::uint32_t) * r.triangles;
        kept += (kVertex + (r.stored ? sizeof(glm::vec4) : 0)) * r.vertices + indices + bytes.kept;
        most = std::max(most, bytes.making);
        rasters += kRasterBytes * r.triangles + sizeof(glm::vec2) * r.vertices + indices;
    }
    return kept + std::max(most, rasters);
}

void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> bytes, const std::string& mime,
                std::vector<std::string>& notes, const std::string& namedBy)
{
    const std::string extension = mime == "image/webp" ? "EXT_texture_webp" : namedBy;
    if (!job.alsoElsewhere) {
        replaceGltfImage(document, job.image, std::move(bytes), mime);
        for (const std::size_t t : job.textures) {
            dropOtherForms(rootOf(document), t, job.image, notes);
            nameSource(rootOf(document), t, job.image, extension);
        }
        return;
    }
    const std::size_t image = addGltfImage(document, std::move(bytes), mime, job.name);
    std::map<std::size_t, std::size_t> copies;
    for (const MapSlot slot : job.slots) {
        Json& index = normalSlotOf(rootOf(document), slot.material, slot.kind)["index"];
        const std::size_t texture = index.get<std::size_t>();
        if (!copies.contains(texture))
            copies[texture] = copyGltfTexture(document, texture, image);
        index = copies[texture];
    }
    for (const auto& [old, copy] : copies)
        nameSource(rootOf(document), copy, image, extension);
}

// ---- tangents ---------------------------------------------------------------------------------

namespace {

// How far the direction of a primitive's highlights rotates, for its worst placing.
Result<ValueSummary> turnOf(const GltfDocument& document, std::size_t m, std::size_t p,
                            const std::vector<glm::dmat3>& transforms, const FramePair& frames)
{
    COTAN_TRY(geometry, gltfGeometry(document, m, p));
    const auto mesh = std::make_shared<const Mesh>(gltfMesh(std::move(*geometry)));
    const MappedSurface surface =
        makeSurface(mesh, Texture{}, glm::dmat3(1), framesRead(frames, !mesh->tangents.empty()));
    ValueSummary worst;
    for (const glm::dmat3& linear : transforms) {
        const MappedSurface moved = placedBy(surface, linear);
        const ValueSummary turn = directionTurn(moved, pointsOver(moved, kPointsOfSurface), frames);
        if (turn.count == 0)
            return turn;
        if (worst.count == 0 || turn.percentile95 > worst.percentile95)
            worst = turn;
    }
    return worst;
}

// Why a material keeps TANGENT for its direction.
std::string whyDirectionNeedsTangents(const RotatedDirection& d, Frame to)
{
    if (d.degrees.count == 0)
        return "the direction of its anisotropy is defined by TANGENT alone: there is no uv to derive it from";
    return fmt::format("the direction of its anisotropy would rotate by {:.1f} degrees with {} (95 % of {})",
                       d.degrees.percentile95, name(to), primitiveField(d.mesh, d.primitive));
}

} // namespace

Result<TangentBytes> dropTangents(GltfDocument& document, const FramePair& frames, const std::vector<MapSlot>& foreign,
                                  const std::vector<KeptTangents>& kept,
                                  const std::vector<PrimitiveDecision>& decisions, std::vector<std::string>& notes)
{
    TangentBytes dropped;
    std::set<std::size_t> seen, reported;
    const auto transforms = gltfMeshTransforms(rootOf(document));
    const Status status = forEachPrimitive(rootOf(document), [&](std::size_t m, std::size_t p) -> Status {
        const Json& root = rootOf(document);
        const Json& primitive = root["meshes"][m]["primitives"][p];
        if (!primitive["attributes"].contains("TANGENT"))
            return Done{};
        bool stays = false;
        const auto keepFor = [&](std::size_t material, const std::string& reason) {
            stays = true;
            if (!reason.empty() && reported.insert(material).second)
                notes.push_back(fmt::format("materials[{}]: {}; TANGENT is kept", material, reason));
        };
        for (const KeptTangents& k : kept)
            if (k.mesh == m && k.primitive == p)
                keepFor(k.material, k.reason);
        for (const std::size_t material : materialsOf(root, primitive)) {
            for (const MapSlot& slot : foreign)
                if (slot.material == material)
                    keepFor(material, "its normal map is in an unsupported format and is not converted");
            const std::string requirement = gltf::tangentRequirement(root["materials"][material]);
            if (!requirement.empty())
                keepFor(material, fmt::format("glTF requires TANGENT for {} without a normalTexture", requirement));
            if (gltf::tangentReader(root["materials"][material]).empty())
                continue;
            FramePair own = frames;
            if (const FrameDecision* const chosen = decisionOf(decisions, {m, p}))
                own.to = chosen->frame;
            COTAN_TRY(turn, turnOf(document, m, p, transforms[m], own));
            RotatedDirection& d = dropped.directions.emplace_back(RotatedDirection{m, p, material, *turn, false});
            d.stays = !requirement.empty() || !directionStays(d.degrees);
            if (d.stays)
                keepFor(material, whyDirectionNeedsTangents(d, own.to));
        }
        if (stays)
            return Done{};
        auto count = [&](const Json& attributes, bool base) {
            if (!attributes.contains("TANGENT"))
                return;
            const std::size_t index = attributes["TANGENT"].get<std::size_t>();
            if (!seen.insert(index).second)
                return;
            const gltf::Accessor accessor = gltf::readAccessor(root["accessors"][index]);
            dropped.vertices += base ? accessor.count : 0;
            dropped.bytes += accessor.count * gltf::elementSize(accessor);
        };
        count(primitive["attributes"], true);
        for (const Json& target : primitive.value("targets", Json::array()))
            count(target, false);
        dropped.primitives += dropGltfTangents(document, m, p);
        return Done{};
    });
    if (!status)
        return status.error();
    return dropped;
}

} // namespace cotan
