// The materials of a detailed surface, for maps that carry them over.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "bake/high_surface.hpp"

namespace cotan {

// The colour of the nth id, from 1, as IdBy says: 0xrrggbb. Different for all n below 2^24.
std::uint32_t idColor(std::uint32_t n);

// The linear colour of 0xrrggbb in sRGB.
glm::vec3 linearColor(std::uint32_t color);

// What the materials say at the hits of a packet; without meaning where nothing was hit, and for what no kind reads.
struct MaterialValues {
    Lanes3 baseColor, emissive; // linear
    Lanes3 surface;             // (1, roughness, metallic)
    Lanes<float> id{};          // 0xrrggbb
};

// Textures, uv, colours and names of all instances of some scenes.
class HighMaterials {
public:
    // scenes: those that `surface` was made from, in the same order; uv, colours and images are moved out of them, but
    // for images that normal maps also use. surface: must outlive the result. Errors: ErrorKind::input for a kind that
    // no instance has, since its file states no map, colour or vertex colour for it, and for images without pixels.
    static Result<HighMaterials> make(std::vector<Scene>& scenes, const HighSurface& surface,
                                      const std::vector<BakeKind>& kinds, IdBy idBy);

    // Reads each texture once for all kinds. Textures are filtered as their samplers say, in linear light.
    void read(const Hits& hits, MaterialValues& values) const;

    const std::vector<IdColor>& ids() const { return ids_; } // empty for vertex colours

private:
    struct Attributes { // of a mesh
        std::array<std::vector<glm::vec2>, 2> uv;
        std::vector<glm::vec4> colors;
    };
    struct Map {
        const Image* image = nullptr; // null: none
        Texture texture;
        bool isColor = false;
        int square = 0; // maps of a part with the same number read the same texels at each point
    };
    struct Part { // an instance, with the index of Hits::instance
        std::span<const std::uint32_t> indices;
        const Attributes* attributes = nullptr;
        glm::vec3 baseColor{1}, emissive{0};
        float roughness = 1, metallic = 1;
        Map baseColorMap, surfaceMap, emissiveMap; // surface: roughness and metallic; only those that kinds read
        std::uint32_t id = 0;                      // a colour
    };
    struct Corners;
    struct Maker;

    struct Square;

    static void numberSquares(Part& part);
    glm::vec3 texelAt(const Map& map, const Part& part, const Corners& at, Square& square) const;

    std::deque<Image> images_; // deques, because parts_ points into them
    std::deque<Attributes> attributes_;
    std::vector<Part> parts_;
    std::vector<IdColor> ids_;
    IdBy idBy_ = IdBy::material;
};

} // namespace cotan
