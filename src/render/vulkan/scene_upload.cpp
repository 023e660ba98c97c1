#include "scene_upload.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cotan/convention.hpp"
#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr vk::DeviceSize kBufferSize = vk::DeviceSize(64) << 20;
constexpr vk::DeviceSize kStaging = vk::DeviceSize(16) << 20;

// Values of absent attributes: white, then zeros. At the start of every buffer.
constexpr std::array<float, 8> kConstants{1, 1, 1, 1, 0, 0, 0, 0};
constexpr vk::DeviceSize kZeroOffset = 16;

template<class T> std::span<const std::byte> bytesOf(const T& array) { return std::as_bytes(std::span(array)); }

struct StreamData {
    std::span<const std::byte> bytes; // empty: absent
    vk::DeviceSize stride = 0;
};

template<class T> StreamData streamOf(const std::vector<T>& values)
{
    return values.empty() ? StreamData{} : StreamData{bytesOf(values), sizeof(T)};
}

// A value that can be subtracted from all values in [low, high] exactly and makes them smaller: the midpoint if they
// are within a factor of two of each other (Sterbenz' lemma), else 0.
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

bool drawable(const glm::vec3& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) <= 1e37f; }

// The data of a mesh that is uploaded.
struct MeshSource {
    const Mesh* mesh;
    // uv minus their origin (xy: set 0, zw: set 1). Differences of uv far from zero would lose precision in the
    // rasteriser.
    std::array<std::vector<glm::vec2>, 2> texcoords;
    glm::vec4 texcoordOrigin{};
    std::vector<std::uint32_t> indices; // of the triangles that can be drawn

    explicit MeshSource(const Mesh& source) : mesh(&source), texcoords(source.texcoords)
    {
        for (int set = 0; set < 2; ++set) {
            const glm::vec2 o = originOf(source.texcoords[std::size_t(set)]);
            for (glm::vec2& c : texcoords[std::size_t(set)])
                c -= o;
            texcoordOrigin[2 * set] = o.x;
            texcoordOrigin[2 * set + 1] = o.y;
        }
        const auto usable = [&](std::uint32_t i) { return drawable(source.positions[i]); };
        indices.reserve(source.indices.size());
        for (std::size_t i = 0; i + 2 < source.indices.size(); i += 3) {
            const std::uint32_t* t = &source.indices[i];
            if (usable(t[0]) && usable(t[1]) && usable(t[2]))
                indices.insert(indices.end(), t, t + 3);
        }
    }

    std::array<StreamData, kStreamCount> streams() const // the streams refer to this object
    {
        return {streamOf(mesh->positions),
                streamOf(mesh->normals),
                streamOf(texcoords[0]),
                streamOf(texcoords[1]),
                streamOf(mesh->colors),
                streamOf(mesh->tangents),
                streamOf(mesh->cotangentsU),
                streamOf(mesh->cotangentsV),
                StreamData{bytesOf(std::span(&texcoordOrigin, 1)), 0}};
    }
};

// Clamps a box to coordinates whose squares the shaders' floats can represent.
Bounds withinReach(const Bounds& box)
{
    constexpr float kFarthest = 1e18f;
    return {glm::clamp(box.low, -kFarthest, kFarthest), glm::clamp(box.high, -kFarthest, kFarthest)};
}

// Assigns offsets, from `offset` on, to all streams and the indices of the mesh; returns the end.
vk::DeviceSize assignOffsets(GpuMesh& gpu, const MeshSource& source, vk::DeviceSize offset)
{
    const std::array<StreamData, kStreamCount> streams = source.streams();
    for (std::size_t s = 0; s < kStreamCount; ++s) {
        gpu.strides[s] = streams[s].stride;
        gpu.offsets[s] = !streams[s].bytes.empty() ? offset : s == kColor ? 0 : kZeroOffset;
        offset += aligned(streams[s].bytes.size(), 16);
    }
    gpu.indices = offset;
    return offset + aligned(gpu.indexCount * sizeof(std::uint32_t), 16);
}

gpu::CotanTextureUse useConstants(const Texture& use, bool present)
{
    return {gpu::vec4(use.uRow, use.texcoord == 1 ? 1.0f : 0.0f), gpu::vec4(use.vRow, present ? 1.0f : 0.0f)};
}

bool sameUv(const Texture& a, const Texture& b)
{
    return a.texcoord == b.texcoord && a.uRow == b.uRow && a.vRow == b.vRow;
}

bool sameUse(const Texture& a, const Texture& b)
{
    const Sampler &s = a.sampler, &t = b.sampler;
    return a.image == b.image && sameUv(a, b) && s.wrapU == t.wrapU && s.wrapV == t.wrapV && s.magnify == t.magnify
        && s.minify == t.minify && s.mip == t.mip;
}

// COTAN_MAP_... and COTAN_LAYER_... bits of the material's maps and layers.
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
    const std::pair<bool, std::uint32_t> layers[] = {{m.coat.strength > 0, COTAN_LAYER_COAT},
                                                     {m.glossy(), COTAN_LAYER_GLOSS},
                                                     {m.anisotropy.strength > 0, COTAN_LAYER_ANISOTROPY},
                                                     {m.transmission.strength > 0, COTAN_LAYER_TRANSMISSION},
                                                     {m.sheen.present(), COTAN_LAYER_SHEEN}};
    for (const auto& [there, layer] : layers)
        maps |= there ? layer : 0u;
    return maps;
}

// Encoding of a normal map; w: 0.
gpu::ivec4 normalConstants(const Scene& scene, const Texture& map, const Convention& format)
{
    const PixelType type = map.present() ? scene.images[std::size_t(map.image)].type : PixelType::unorm8;
    return {expansionFor(format.expansion, bitsPerComponent(type)), int(format.channels), greenAlongV(format) ? 1 : -1,
            0};
}

gpu::CotanMaterial materialConstants(const Scene& scene, const Material& m, const Textures& textures)
{
    gpu::CotanMaterial g{};
    g.baseColor = m.baseColor;
    g.emissive = gpu::vec4(m.emissive, m.alphaCutoff);
    g.factors = gpu::vec4(m.metallic, m.roughness, m.occlusionStrength, m.normalScale);
    g.normalMap = normalConstants(scene, m.normalMap, m.normalFormat);
    g.normalMap.w = m.unlit ? 1 : 0;
    const Texture frameMap = frameTexture(m).present() ? frameTexture(m) : Texture{};
    g.coat = gpu::vec4(m.coat.strength, m.coat.roughness, m.coat.normalScale, m.transmission.strength);
    g.coatNormalMap = normalConstants(scene, m.coat.normalMap, m.coat.normalFormat);
    g.coatNormalMap.w = sameUv(m.coat.normalMap, frameMap) ? 1 : 0;
    const Anisotropy& a = m.anisotropy;
    g.anisotropy = gpu::vec4(a.strength, std::cos(a.rotation), -std::sin(a.rotation), m.specular.ior);
    g.specular = gpu::vec4(m.specular.color, m.specular.strength);
    g.sheen = gpu::vec4(m.sheen.color, m.sheen.roughness);
    g.heights = gpu::vec4(m.heightMap.depth, kMinHeightSteps, kMaxHeightSteps, kHeightHalvings);
    for (const MapUse& use : mapUses(m))
        g.*use.constants = useConstants(*use.texture, textures.present(use));
    if (!m.normalMap.present())
        g.normalMapUse = useConstants(frameMap, /*present*/ false);
    return g;
}

} // namespace

GpuScene::GpuScene(const Device& device, const Layouts& layouts, const Scene& scene, Textures textures)
    : bounds(withinReach(cotan::bounds(scene))), device_(&device), memory_(device), samplers_(device),
      textures_(std::move(textures))
{
    for (const FrameInfo& f : frames()) {
        withFrame.push_back(checkVertexAttributes(scene, f.frame));
        withFramesOfMeshes.push_back(checkVertexAttributes(scene, f.frame, /*framesOfMeshes*/ true));
    }
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
    std::vector<MeshSource> sources;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        std::size_t& at = gpuOf[std::size_t(instance.mesh)];
        if (at == kNone) {
            at = meshes.size();
            const MeshSource& source = sources.emplace_back(mesh);
            GpuMesh& gpu = meshes.emplace_back();
            gpu.indexCount = static_cast<std::uint32_t>(source.indices.size());
            gpu.material = mesh.material;
            gpu.readWith = mesh.readWith;
            gpu.box = cotan::bounds(mesh);
        }
        if (meshes[at].indexCount > 0)
            instances.push_back({instance.toWorld, at});
    }

    // Several meshes share a buffer; a mesh that exceeds the buffer size has its own.
    std::vector<vk::DeviceSize> sizes;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const vk::DeviceSize alone = assignOffsets(meshes[i], sources[i], 0);
        if (sizes.empty() || sizes.back() + alone > kBufferSize)
            sizes.push_back(sizeof kConstants);
        meshes[i].buffer = sizes.size() - 1;
        sizes.back() = assignOffsets(meshes[i], sources[i], sizes.back());
    }
    vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndexBuffer
        | vk::BufferUsageFlagBits::eTransferDst;
    if (device_->exact)
        usage |= vk::BufferUsageFlagBits::eShaderDeviceAddress | vk::BufferUsageFlagBits::eStorageBuffer;
    for (const vk::DeviceSize size : sizes) {
        buffers.push_back(makeDeviceBuffer(memory_, size, usage));
        uploader.buffer(buffers.back(), 0, bytesOf(kConstants));
    }
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const GpuMesh& gpu = meshes[i];
        const std::array<StreamData, kStreamCount> streams = sources[i].streams();
        for (std::size_t s = 0; s < kStreamCount; ++s)
            uploader.buffer(buffers[gpu.buffer], gpu.offsets[s], streams[s].bytes);
        uploader.buffer(buffers[gpu.buffer], gpu.indices, bytesOf(sources[i].indices));
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
    const vk::DeviceSize stride = aligned(sizeof(gpu::CotanMaterial), alignment);
    materialBuffer_ = makeDeviceBuffer(memory_, stride * count,
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
        gpu = {m.alphaMode, m.doubleSided, m.translucent(), m.castsShadow(), mapsOf(m, textures_), {}};
        gpu.set = allocateSet(*device_, pool_, layouts.materialOf(gpu.extended()));
        const vk::DescriptorBufferInfo buffer(*materialBuffer_.buffer, i * stride, sizeof(gpu::CotanMaterial));
        device_->device.updateDescriptorSets(
            vk::WriteDescriptorSet(gpu.set, 0, 0, vk::DescriptorType::eUniformBuffer, {}, buffer), {});
        writeTextures(i);
    }
    limitPipelines();
}

// Each distinct set of maps needs a pipeline. If there are many, all materials share one pipeline that reads all maps
// and tests for them at run time; materials with extensions share another.
void GpuScene::limitPipelines()
{
    constexpr std::size_t kMax = 4;
    std::set<std::uint32_t> sets;
    for (const GpuMesh& mesh : meshes)
        sets.insert(materials[std::size_t(mesh.material)].maps);
    if (sets.size() <= kMax)
        return;
    std::uint32_t all = COTAN_MAPS_PLAIN & ~COTAN_MAP_OCCLUSION_SHARED;
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
