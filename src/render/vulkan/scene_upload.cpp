#include "scene_upload.hpp"

#include <algorithm>
#include <cmath>

#include "cotan/convention.hpp"
#include "gpu_structs.hpp"
#include "scene/bounds.hpp"
#include "scene/geometry.hpp"
#include "view_data.hpp"

namespace cotan {

namespace {

constexpr vk::DeviceSize kBufferSize = vk::DeviceSize(64) << 20;
constexpr vk::DeviceSize kStaging = vk::DeviceSize(16) << 20;

// What absent attributes read: white, then zeros. At the start of every buffer.
constexpr std::array<float, 8> kConstants{1, 1, 1, 1, 0, 0, 0, 0};
constexpr vk::DeviceSize kZeroOffset = 16;

template<class T> std::span<const std::byte> bytesOf(const T& array) { return std::as_bytes(std::span(array)); }

struct StreamData {
    std::span<const std::byte> bytes; // empty: absent
    vk::DeviceSize stride = 0;
};

template<class T> StreamData streamOf(const std::vector<T>& values, std::size_t vertices)
{
    if (values.size() != vertices || vertices == 0)
        return {};
    return {bytesOf(values), sizeof(T)};
}

// A value that can be subtracted from each of these without rounding and that makes them smaller:
// their middle, if all are within a factor of two of each other, else 0 (Sterbenz' lemma).
float originOf(float low, float high)
{
    const bool exact = (low > 0 && high <= 2 * low) || (high < 0 && low >= 2 * high);
    return exact ? low + (high - low) * 0.5f : 0.0f;
}

glm::vec2 originOf(const std::vector<glm::vec2>& uv)
{
    if (uv.empty())
        return glm::vec2(0);
    glm::vec2 low = uv[0], high = uv[0];
    for (const glm::vec2& c : uv) {
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    return {originOf(low.x, high.x), originOf(low.y, high.y)};
}

// The uv of a mesh near zero: values minus origin (xy set 0, zw set 1). Differences of uv far from
// zero would lose their digits in the rasteriser.
struct RelativeTexcoords {
    std::array<std::vector<glm::vec2>, 2> values;
    glm::vec4 origin{0};

    explicit RelativeTexcoords(const Mesh& mesh) : values(mesh.texcoords)
    {
        for (int set = 0; set < 2; ++set) {
            const glm::vec2 o = originOf(mesh.texcoords[std::size_t(set)]);
            for (glm::vec2& c : values[std::size_t(set)])
                c -= o;
            origin[2 * set] = o.x;
            origin[2 * set + 1] = o.y;
        }
    }
};

// A stream's bytes must outlive what is returned; so must `texcoords`.
std::array<StreamData, kStreamCount> streamsOf(const Mesh& mesh, const RelativeTexcoords& texcoords)
{
    const std::size_t n = mesh.vertexCount();
    return {streamOf(mesh.positions, n),
            streamOf(mesh.normals, n),
            streamOf(texcoords.values[0], n),
            streamOf(texcoords.values[1], n),
            streamOf(mesh.colors, n),
            streamOf(mesh.tangents, n),
            streamOf(mesh.cotangentsU, n),
            streamOf(mesh.cotangentsV, n),
            StreamData{bytesOf(std::span(&texcoords.origin, 1)), 0}};
}

bool drawable(const glm::vec3& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) <= 1e37f; }

// The triangles that can be drawn.
std::vector<std::uint32_t> usableIndices(const Mesh& mesh)
{
    const std::size_t n = mesh.vertexCount();
    const auto usable = [&](std::uint32_t i) { return i < n && drawable(mesh.positions[i]); };
    std::vector<std::uint32_t> result;
    result.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* t = &mesh.indices[i];
        if (usable(t[0]) && usable(t[1]) && usable(t[2]))
            result.insert(result.end(), t, t + 3);
    }
    return result;
}

// What the shaders' floats can take the square of.
Bounds withinReach(const Bounds& box)
{
    constexpr float kFarthest = 1e18f;
    return {glm::clamp(box.low, -kFarthest, kFarthest), glm::clamp(box.high, -kFarthest, kFarthest)};
}

vk::DeviceSize padded(std::size_t bytes) { return (vk::DeviceSize(bytes) + 15) / 16 * 16; }

// Gives every stream and the indices of the mesh their place from `offset` on; returns the end.
vk::DeviceSize place(GpuMesh& gpu, const Mesh& mesh, const RelativeTexcoords& texcoords, vk::DeviceSize offset)
{
    const std::array<StreamData, kStreamCount> streams = streamsOf(mesh, texcoords);
    for (std::size_t s = 0; s < kStreamCount; ++s) {
        gpu.strides[s] = streams[s].stride;
        gpu.offsets[s] = !streams[s].bytes.empty() ? offset : s == kColor ? 0 : kZeroOffset;
        offset += padded(streams[s].bytes.size());
    }
    gpu.indices = offset;
    return offset + padded(gpu.indexCount * sizeof(std::uint32_t));
}

bool drawable(const Scene& scene, const Instance& instance)
{
    if (instance.mesh < 0 || std::size_t(instance.mesh) >= scene.meshes.size())
        return false;
    const int material = scene.meshes[std::size_t(instance.mesh)].material;
    return material >= 0 && std::size_t(material) < scene.materials.size();
}

gpu::CotanTextureUse useConstants(const Texture& use, bool present)
{
    gpu::CotanTextureUse g{};
    g.uRow = gpu::vec4(use.uRow, use.texcoord == 1 ? 1.0f : 0.0f);
    g.vRow = gpu::vec4(use.vRow, present ? 1.0f : 0.0f);
    return g;
}

bool sameUse(const Texture& a, const Texture& b)
{
    const Sampler& s = a.sampler;
    const Sampler& t = b.sampler;
    return a.image == b.image && a.texcoord == b.texcoord && a.uRow == b.uRow && a.vRow == b.vRow && s.wrapU == t.wrapU
        && s.wrapV == t.wrapV && s.magnify == t.magnify && s.minify == t.minify && s.mip == t.mip;
}

// The maps and layers that are there.
std::uint32_t mapsOf(const Material& m, const Textures& textures)
{
    std::uint32_t maps = 0, bit = 1;
    for (const MapUse& use : mapUses(m)) {
        maps |= textures.present(use) ? bit : 0u;
        bit *= 2;
    }
    const std::uint32_t both = COTAN_MAP_METALLIC_ROUGHNESS | COTAN_MAP_OCCLUSION;
    if ((maps & both) == both && sameUse(m.metallicRoughnessMap, m.occlusionMap))
        maps = (maps & ~COTAN_MAP_OCCLUSION) | COTAN_MAP_OCCLUSION_SHARED;
    if (m.coat.strength > 0)
        maps |= COTAN_LAYER_COAT;
    if (m.glossy())
        maps |= COTAN_LAYER_GLOSS;
    if (m.anisotropy.strength > 0)
        maps |= COTAN_LAYER_ANISOTROPY;
    if (m.transmission.strength > 0)
        maps |= COTAN_LAYER_TRANSMISSION;
    if (m.sheen.present())
        maps |= COTAN_LAYER_SHEEN;
    return maps;
}

// How a normal map is stored; w: 0.
gpu::ivec4 normalConstants(const Scene& scene, const Texture& map, const Convention& format)
{
    const bool mapped = map.present() && std::size_t(map.image) < scene.images.size();
    const PixelType type = mapped ? scene.images[std::size_t(map.image)].type : PixelType::unorm8;
    return {expansionFor(format.expansion, bitsPerComponent(type)), int(format.channels), greenAlongV(format) ? 1 : -1,
            0};
}

bool sameUv(const Texture& a, const Texture& b)
{
    return a.texcoord == b.texcoord && a.uRow == b.uRow && a.vRow == b.vRow;
}

gpu::CotanMaterial materialConstants(const Scene& scene, const Material& m, const Textures& textures)
{
    gpu::CotanMaterial g{};
    g.baseColor = m.baseColor;
    g.emissive = gpu::vec4(m.emissive, m.alphaCutoff);
    g.factors = gpu::vec4(m.metallic, m.roughness, m.occlusionStrength, m.normalScale);
    g.normalMap = normalConstants(scene, m.normalMap, m.normalFormat);
    g.normalMap.w = m.unlit ? 1 : 0;
    g.coat = gpu::vec4(m.coat.strength, m.coat.roughness, m.coat.normalScale, m.transmission.strength);
    g.coatNormalMap = normalConstants(scene, m.coat.normalMap, m.coat.normalFormat);
    g.coatNormalMap.w = sameUv(m.coat.normalMap, m.normalMap.present() ? m.normalMap : Texture{}) ? 1 : 0;
    const Anisotropy& a = m.anisotropy;
    g.anisotropy = gpu::vec4(a.strength, std::cos(a.rotation), -std::sin(a.rotation), m.specular.ior);
    g.specular = gpu::vec4(m.specular.color, m.specular.strength);
    g.sheen = gpu::vec4(m.sheen.color, m.sheen.roughness);
    gpu::CotanTextureUse* const uses[] = {
        &g.baseColorMap,     &g.metallicRoughnessMap, &g.normalMapUse,      &g.occlusionMap,   &g.emissiveMap,
        &g.coatMap,          &g.coatRoughnessMap,     &g.coatNormalMapUse,  &g.anisotropyMap,  &g.specularMap,
        &g.specularColorMap, &g.sheenColorMap,        &g.sheenRoughnessMap, &g.transmissionMap};
    std::size_t k = 0;
    for (const MapUse& use : mapUses(m))
        *uses[k++] = useConstants(*use.texture, textures.present(use));
    // Without a normal map the frame is that of uv set 0 as it is.
    if (!m.normalMap.present())
        g.normalMapUse = useConstants(Texture{}, /*present*/ false);
    return g;
}

} // namespace

GpuScene::GpuScene(const Device& device, const Layouts& layouts, const Scene& scene, Textures textures)
    : bounds(withinReach(cotan::bounds(scene))), device_(&device), memory_(device), samplers_(device),
      textures_(std::move(textures))
{
    for (const FrameInfo& f : frames())
        withFrame.push_back(checkVertexAttributes(scene, f.frame));
    Uploader uploader(device, kStaging);
    textures_.load(scene, uploader);
    loadMeshes(scene, uploader);
    loadMaterials(scene, layouts, uploader);
    uploader.finish();
}

void GpuScene::loadMeshes(const Scene& scene, Uploader& uploader)
{
    constexpr std::size_t kNone = ~std::size_t(0);
    std::vector<std::size_t> gpuOf(scene.meshes.size(), kNone);
    std::vector<const Mesh*> sources;
    std::vector<RelativeTexcoords> texcoords;
    std::vector<std::vector<std::uint32_t>> indices;
    for (const Instance& instance : scene.instances) {
        if (!drawable(scene, instance))
            continue;
        const auto m = std::size_t(instance.mesh);
        if (gpuOf[m] == kNone) {
            const Mesh& mesh = scene.meshes[m];
            gpuOf[m] = meshes.size();
            GpuMesh& gpu = meshes.emplace_back();
            sources.push_back(&mesh);
            texcoords.emplace_back(mesh);
            indices.push_back(usableIndices(mesh));
            gpu.indexCount = static_cast<std::uint32_t>(indices.back().size());
            gpu.material = mesh.material;
            gpu.box = cotan::bounds(mesh);
        }
        const GpuMesh& gpu = meshes[gpuOf[m]];
        if (gpu.indexCount == 0)
            continue;
        instances.push_back({instance.toWorld, gpuOf[m]});
    }

    // Many meshes share a buffer; one larger than a buffer has its own.
    std::vector<vk::DeviceSize> sizes;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const vk::DeviceSize alone = place(meshes[i], *sources[i], texcoords[i], 0);
        if (sizes.empty() || sizes.back() + alone > kBufferSize)
            sizes.push_back(sizeof kConstants);
        meshes[i].buffer = sizes.size() - 1;
        sizes.back() = place(meshes[i], *sources[i], texcoords[i], sizes.back());
    }
    vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndexBuffer
        | vk::BufferUsageFlagBits::eTransferDst;
    if (device_->exact)
        usage |= vk::BufferUsageFlagBits::eShaderDeviceAddress | vk::BufferUsageFlagBits::eStorageBuffer;
    for (const vk::DeviceSize size : sizes) {
        buffers.push_back(makeDeviceBuffer(*device_, memory_, size, usage));
        uploader.buffer(buffers.back(), 0, bytesOf(kConstants));
    }
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const GpuMesh& gpu = meshes[i];
        const std::array<StreamData, kStreamCount> streams = streamsOf(*sources[i], texcoords[i]);
        for (std::size_t s = 0; s < kStreamCount; ++s)
            uploader.buffer(buffers[gpu.buffer], gpu.offsets[s], streams[s].bytes);
        uploader.buffer(buffers[gpu.buffer], gpu.indices, bytesOf(indices[i]));
    }
}

void GpuScene::loadMaterials(const Scene& scene, const Layouts& layouts, Uploader& uploader)
{
    const std::size_t count = scene.materials.size();
    materials.resize(count);
    maps_.resize(count);
    if (count == 0)
        return;
    const vk::DeviceSize alignment = std::max<vk::DeviceSize>(device_->limits.minUniformBufferOffsetAlignment, 16);
    const vk::DeviceSize stride = (sizeof(gpu::CotanMaterial) + alignment - 1) / alignment * alignment;
    materialBuffer_ = makeDeviceBuffer(*device_, memory_, stride * count,
                                       vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eTransferDst);

    const auto sets = static_cast<std::uint32_t>(count);
    const std::array sizes{vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, sets),
                           vk::DescriptorPoolSize(vk::DescriptorType::eCombinedImageSampler, sets * COTAN_MAP_COUNT)};
    pool_ = vk::raii::DescriptorPool(device_->device, vk::DescriptorPoolCreateInfo({}, sets, sizes));

    for (std::size_t i = 0; i < count; ++i) {
        const Material& m = scene.materials[i];
        const gpu::CotanMaterial constants = materialConstants(scene, m, textures_);
        uploader.buffer(materialBuffer_, i * stride, bytesOf(std::span(&constants, 1)));
        std::size_t k = 0;
        for (const MapUse& use : mapUses(m))
            maps_[i][k++] = {use.texture->sampler, textures_.view(use)};

        GpuMaterial& gpu = materials[i];
        gpu.alphaMode = m.alphaMode;
        gpu.doubleSided = m.doubleSided;
        gpu.translucent = m.translucent();
        gpu.throwsShadow = m.throwsShadow();
        gpu.maps = mapsOf(m, textures_);
        gpu.set = allocateSet(*device_, pool_, layouts.materialOf(gpu.extended()));
        const vk::DescriptorBufferInfo buffer(*materialBuffer_.buffer, i * stride, sizeof(gpu::CotanMaterial));
        device_->device.updateDescriptorSets(
            vk::WriteDescriptorSet(gpu.set, 0, 0, vk::DescriptorType::eUniformBuffer, {}, buffer), {});
        writeTextures(i);
    }
    limitPipelines();
}

// Every set of maps is a pipeline to compile. Where there are many, all materials take one that
// does everything and asks at run time; those with extensions one of their own.
void GpuScene::limitPipelines()
{
    constexpr std::size_t kMax = 4;
    std::vector<std::uint32_t> sets;
    for (const GpuMesh& mesh : meshes)
        sets.push_back(materials[std::size_t(mesh.material)].maps);
    std::sort(sets.begin(), sets.end());
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    if (sets.size() <= kMax)
        return;
    std::uint32_t all = COTAN_MAP_BASE_COLOR | COTAN_MAP_METALLIC_ROUGHNESS | COTAN_MAP_NORMAL | COTAN_MAP_OCCLUSION
        | COTAN_MAP_EMISSIVE;
    for (const std::uint32_t set : sets)
        all |= set & ~COTAN_MAP_OCCLUSION_SHARED;
    for (GpuMaterial& material : materials)
        material.maps = material.extended() ? all : all & COTAN_MAPS_PLAIN;
}

void GpuScene::writeTextures(std::size_t material)
{
    const std::size_t count = materials[material].extended() ? COTAN_MAP_COUNT : COTAN_MAP_COUNT_PLAIN;
    std::array<vk::DescriptorImageInfo, COTAN_MAP_COUNT> images;
    std::vector<vk::WriteDescriptorSet> writes;
    for (std::uint32_t k = 0; k < count; ++k) {
        const BoundMap& map = maps_[material][k];
        images[k] = {samplers_.get(map.sampler, pointSampled_), map.view, vk::ImageLayout::eShaderReadOnlyOptimal};
        writes.emplace_back(materials[material].set, k + 1, 0, vk::DescriptorType::eCombinedImageSampler, images[k]);
    }
    device_->device.updateDescriptorSets(writes, {});
}

void GpuScene::setPointSampled(bool pointSampled)
{
    if (pointSampled == pointSampled_)
        return;
    pointSampled_ = pointSampled;
    for (std::size_t i = 0; i < materials.size(); ++i)
        writeTextures(i);
}

} // namespace cotan
