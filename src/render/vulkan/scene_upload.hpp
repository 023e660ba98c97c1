// A scene in device memory.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "gpu_structs.hpp"
#include "memory.hpp"
#include "pipeline.hpp"
#include "texture_mips.hpp"

namespace cotan {

// ---- textures: what materials use, each with its mip chain ---------------------------------

// Samplers, created on demand and shared.
class Samplers {
public:
    explicit Samplers(const Device& device) : device_(&device) {}

    // pointSampled: nearest texel of the finest level regardless of the sampler's filters; its wrap modes are kept.
    vk::Sampler get(const Sampler& sampler, bool pointSampled);

private:
    using Key = std::tuple<Wrap, Wrap, Filter, Filter, MipFilter, bool>;
    const Device* device_;
    std::map<Key, vk::raii::Sampler> made_;
};

// A float image on the device, as halfs. It is kept for later images while its owner stays the same.
struct HeldTexture {
    std::shared_ptr<const void> owner; // of the uploaded image; null: none
    std::optional<DeviceImage> image;

    void hold(const Device& device, std::shared_ptr<const void> newOwner, const Image& values);
};

// How a material uses an image.
struct MapUse {
    const Texture* texture = nullptr;
    TextureKind kind = TextureKind::data;
    Convention format; // of normal maps
    gpu::CotanTextureUse gpu::CotanMaterial::*constants = nullptr;
};

// All uses by a material, in the order of the bits COTAN_MAP_... and of the bindings.
std::array<MapUse, COTAN_MAP_COUNT> mapUses(const Material& material);

class Textures {
public:
    explicit Textures(const Device& device) : device_(&device), memory_(device) {}

    // Uploads every image that the scene's materials use, once per kind of use. All cores build mips. Images without
    // size or data count as absent. A second scene must have the same images as the first: only new kinds of use are
    // uploaded.
    void load(const Scene& scene, Uploader& uploader);

    // The view of a used image; a white texel if it is absent.
    vk::ImageView view(const MapUse& use) const;
    bool present(const MapUse& use) const;

private:
    // Image, kind, and for normal maps the encoding, which determines the average.
    using Key = std::tuple<int, TextureKind, Expansion, Channels>;
    static Key keyOf(const MapUse& use);
    void request(const Scene& scene, const MapUse& use, std::vector<MipRequest>& missing);
    Texture2D upload(const MipChain& chain, Uploader& uploader);

    const Device* device_;
    Memory memory_;
    std::map<Key, std::size_t> made_;  // all textures on the device
    std::map<Key, std::size_t> index_; // those that the scene uses
    std::vector<Texture2D> textures_;  // [0] is white
};

// ---- the scene -----------------------------------------------------------------------------

// The vertex attributes, each a tightly packed stream. The numbers are the shader's locations.
enum Stream {
    kPosition,
    kNormal,
    kTexcoord0,
    kTexcoord1,
    kColor,
    kTangent,
    kCotangentU,
    kCotangentV,
    kTexcoordOrigin, // origin of both uv sets, constant over the mesh; the uv streams are relative to it
    kStreamCount
};

struct GpuMesh {
    std::size_t buffer = 0; // index into GpuScene::buffers
    // Start of each stream. An absent one has stride 0: all vertices read the same constant.
    std::array<vk::DeviceSize, kStreamCount> offsets{};
    std::array<vk::DeviceSize, kStreamCount> strides{};
    vk::DeviceSize indices = 0; // offset in the buffer
    std::uint32_t indexCount = 0;
    int material = 0;
    std::optional<Frame> readWith; // of the mesh
    Bounds box;                    // in the mesh's space

    bool has(Stream stream) const { return strides[stream] != 0; }
};

struct GpuMaterial {
    AlphaMode alphaMode = AlphaMode::opaque;
    bool doubleSided = false;
    bool translucent = false;
    bool castsShadow = true;
    std::uint32_t maps = 0; // COTAN_MAP_..., COTAN_LAYER_...
    vk::DescriptorSet set;  // owned by the scene's pool; layout: Layouts::materialOf(extended())

    bool extended() const { return (maps & ~COTAN_MAPS_PLAIN) != 0; }
};

struct GpuInstance {
    glm::mat4 toWorld{1};
    std::size_t mesh = 0; // index into GpuScene::meshes
};

// Of a consistent scene (checkScene). Omits triangles with a corner that is not finite.
class GpuScene {
public:
    // textures: empty, or those of a scene with the same images.
    GpuScene(const Device& device, const Layouts& layouts, const Scene& scene, Textures textures);

    // Moves the textures out for the next scene; afterwards this one cannot be drawn.
    Textures takeTextures() { return std::move(textures_); }

    // Switches the textures of all materials between the samplers' filters and nearest texels.
    void setPointSampled(bool pointSampled);

    std::vector<Buffer> buffers;
    std::vector<GpuMesh> meshes;
    std::vector<GpuMaterial> materials; // same indices as in the scene
    std::vector<GpuInstance> instances;
    Bounds bounds;                          // world space
    std::vector<Status> withFrame;          // for each frame: whether the scene has the vertex attributes that it reads
    std::vector<Status> withFramesOfMeshes; // the same where meshes have frames of their own

private:
    void loadMeshes(const Scene& scene, Uploader& uploader);
    void loadMaterials(const Scene& scene, const Layouts& layouts, Uploader& uploader);
    void writeTextures(std::size_t material);
    void limitPipelines();

    struct BoundMap {
        Sampler sampler;
        vk::ImageView view;
    };

    const Device* device_;
    Memory memory_;
    Samplers samplers_;
    Textures textures_;
    Buffer materialBuffer_;
    std::vector<std::array<BoundMap, COTAN_MAP_COUNT>> maps_; // for each material, in binding order
    vk::raii::DescriptorPool pool_{nullptr};
    bool pointSampled_ = false;
};

} // namespace cotan
