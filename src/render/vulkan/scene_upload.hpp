// A scene on the device.
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

// Samplers made on demand and shared.
class Samplers {
public:
    explicit Samplers(const Device& device) : device_(&device) {}

    // pointSampled: nearest texel of the finest level whatever the sampler says; wrap is kept.
    vk::Sampler get(const Sampler& sampler, bool pointSampled);

private:
    using Key = std::tuple<Wrap, Wrap, Filter, Filter, MipFilter, bool>;
    const Device* device_;
    std::map<Key, vk::raii::Sampler> made_;
};

// A picture of floats on the device, as halfs; kept from one picture to the next as long as it is the same one.
struct HeldPicture {
    std::shared_ptr<const void> owner; // what the texture holds; null: nothing
    std::unique_ptr<Memory> memory;
    Texture2D texture;

    void hold(const Device& device, std::shared_ptr<const void> newOwner, const Image& picture);
};

// How a material uses an image.
struct MapUse {
    const Texture* texture = nullptr;
    TextureKind kind = TextureKind::data;
    Convention format; // of normals
    gpu::CotanTextureUse gpu::CotanMaterial::*constants = nullptr;
};

// All uses of a material, in the order of the bits COTAN_MAP_... and of the bindings.
std::array<MapUse, COTAN_MAP_COUNT> mapUses(const Material& material);

class Textures {
public:
    explicit Textures(const Device& device) : device_(&device), memory_(device) {}

    // Uploads every image that the scene's materials use, once for each way of use. Mips are
    // built by all cores. Images without size or data count as absent. A second scene must have the
    // images of the first: only ways of use that are new are uploaded.
    void load(const Scene& scene, Uploader& uploader);

    // The view of a use of an image; a white texel where there is none.
    vk::ImageView view(const MapUse& use) const;
    bool present(const MapUse& use) const;

private:
    // Image, kind, and for normal maps the coding that they are averaged in.
    using Key = std::tuple<int, TextureKind, Expansion, Channels>;
    static Key keyOf(const MapUse& use);
    void request(const Scene& scene, const MapUse& use, std::vector<MipRequest>& missing);
    Texture2D upload(const MipChain& chain, Uploader& uploader);

    const Device* device_;
    Memory memory_;
    std::map<Key, std::size_t> made_;  // on the device
    std::map<Key, std::size_t> index_; // that the scene uses
    std::vector<Texture2D> textures_;  // the first one is white
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
    kTexcoordOrigin, // of both uv sets, one for all vertices; the uv streams are relative to it
    kStreamCount
};

struct GpuMesh {
    std::size_t buffer = 0; // index into GpuScene::buffers
    // Where each stream starts. An absent one has stride 0: all vertices read one constant.
    std::array<vk::DeviceSize, kStreamCount> offsets{};
    std::array<vk::DeviceSize, kStreamCount> strides{};
    vk::DeviceSize indices = 0; // offset
    std::uint32_t indexCount = 0;
    int material = 0;
    Bounds box; // in the mesh's space

    bool has(Stream stream) const { return strides[stream] != 0; }
};

struct GpuMaterial {
    AlphaMode alphaMode = AlphaMode::opaque;
    bool doubleSided = false;
    bool translucent = false;
    bool throwsShadow = true;
    std::uint32_t maps = 0; // COTAN_MAP_..., COTAN_LAYER_...
    vk::DescriptorSet set;  // owned by the scene's pool; as Layouts::materialOf(extended())

    bool extended() const { return (maps & ~COTAN_MAPS_PLAIN) != 0; }
};

struct GpuInstance {
    glm::mat4 toWorld{1};
    std::size_t mesh = 0; // index into GpuScene::meshes
};

// What cannot be drawn is left out: instances of no mesh, triangles with an index out of range or
// a corner that is not finite, attributes with a wrong count.
class GpuScene {
public:
    // textures: empty, or those of a scene with the same images.
    GpuScene(const Device& device, const Layouts& layouts, const Scene& scene, Textures textures);

    // For the next scene; this one cannot be drawn any more.
    Textures takeTextures() { return std::move(textures_); }

    // Switches the textures of all materials between the samplers' filters and nearest texels.
    void setPointSampled(bool pointSampled);

    std::vector<Buffer> buffers;
    std::vector<GpuMesh> meshes;
    std::vector<GpuMaterial> materials; // as in the scene
    std::vector<GpuInstance> instances;
    Bounds bounds;                 // world
    std::vector<Status> withFrame; // whether it has what each frame reads at the vertices

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
    std::vector<std::array<BoundMap, COTAN_MAP_COUNT>> maps_; // of each material, in the order of the bindings
    vk::raii::DescriptorPool pool_{nullptr};
    bool pointSampled_ = false;
};

} // namespace cotan
