// The textures of a scene on the device: what materials use, each with its mip chain.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "gpu_structs.hpp"
#include "memory.hpp"
#include "texture_mips.hpp"

namespace cotan {

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

} // namespace cotan
