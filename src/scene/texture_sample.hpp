// Texture sampling: which uv are used, which texels are read, how they are filtered, and how they encode a normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "cotan/convention.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// ---- uv --------------------------------------------------------------------------------------

// Returns uv transformed by the rows of an affine map, computed in the type of the rows.
template<class T> glm::vec2 moveUv(const glm::vec<3, T>& uRow, const glm::vec<3, T>& vRow, const glm::vec2& uv)
{
    const glm::vec<2, T> p(uv);
    return glm::vec2(uRow.x * p.x + uRow.y * p.y + uRow.z, vRow.x * p.x + vRow.y * p.y + vRow.z);
}

// Returns the mesh's uv with the texture's transform applied (KHR_texture_transform); unchanged if there is no image.
inline glm::vec2 textureUv(const Texture& texture, glm::vec2 uv)
{
    return texture.present() ? moveUv(texture.uRow, texture.vRow, uv) : uv;
}

// The uv set that a texture uses; 0 if it has no image.
inline std::size_t uvSetOf(const Texture& texture) { return texture.present() && texture.texcoord == 1 ? 1 : 0; }

// The transformed uv of a texture at each vertex of a mesh. Empty if the mesh has none.
inline std::vector<glm::vec2> textureUv(const Texture& texture, const Mesh& mesh)
{
    std::vector<glm::vec2> uv = mesh.texcoords[uvSetOf(texture)];
    for (glm::vec2& c : uv)
        c = textureUv(texture, c);
    return uv;
}

// The texture whose uv the material's frame follows: its normal map; without one, the map of its anisotropy, whose
// directions are along these uv. Without both the frame follows uv set 0 untransformed. glTF gives a material one
// tangent space and, for files without TANGENT, defines it by the normal map (KHR_materials_anisotropy).
inline const Texture& frameTexture(const Material& material)
{
    return material.normalMap.present() || !material.anisotropy.map.present() ? material.normalMap
                                                                              : material.anisotropy.map;
}

// ---- texels ----------------------------------------------------------------------------------

// Maximum magnitude of uv. Larger values have no fraction in float, and would overflow as texel numbers.
inline constexpr float kFarthestUv = 1e8f;

// Calls use(components, one) with the four components at column x, row y, inside the image, and the number encoding 1.
template<class Use> auto atTexel(const Image& image, int x, int y, const Use& use)
{
    const std::size_t at = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    if (image.type == PixelType::unorm8)
        return use(image.bytes8() + at, 255);
    return image.type == PixelType::unorm16 ? use(image.words() + at, 65535) : use(image.floats() + at, 1);
}

// The components at column x, row y, inside the image, as a sampler returns them: unorm as [0,1].
inline glm::vec4 storedComponents(const Image& image, int x, int y)
{
    return atTexel(image, x, y,
                   [](const auto* c, int one) { return glm::vec4(c[0], c[1], c[2], c[3]) * (1.0f / float(one)); });
}

// Maps texel i of the infinitely repeated or extended axis to a column or row of an image with `size` of them.
inline int wrapTexel(std::int64_t i, int size, Wrap mode)
{
    if (i >= 0 && i < size)
        return int(i); // same in all modes; the common case
    if (mode == Wrap::clamp)
        return int(std::clamp<std::int64_t>(i, 0, size - 1));
    const std::int64_t period = mode == Wrap::mirror ? 2 * std::int64_t(size) : size;
    std::int64_t k = i % period;
    k = k < 0 ? k + period : k;
    return int(k < size ? k : 2 * std::int64_t(size) - 1 - k);
}

// The texel at uv in an image of `width` x `height`. texel(x, y): a glm vector. uv: at most kFarthestUv from zero.
template<class Texel> auto nearestTexel(int width, int height, const Sampler& s, glm::dvec2 uv, Texel texel)
{
    const auto x = std::int64_t(std::floor(uv.x * width)), y = std::int64_t(std::floor(uv.y * height));
    return texel(wrapTexel(x, width, s.wrapU), wrapTexel(y, height, s.wrapV));
}

// The texels around a point, and how far it is from the first of them towards the others.
struct TexelSquare {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0; // columns and rows
    float kx = 0, ky = 0;               // from 0 to 1
};

// Texel centres are at half-integers. uv: at most kFarthestUv from zero.
inline TexelSquare texelsAround(int width, int height, const Sampler& s, glm::dvec2 uv)
{
    const double u = uv.x * width - 0.5, v = uv.y * height - 0.5;
    const double fu = std::floor(u), fv = std::floor(v);
    const auto x = std::int64_t(fu), y = std::int64_t(fv);
    return {wrapTexel(x, width, s.wrapU),
            wrapTexel(x + 1, width, s.wrapU),
            wrapTexel(y, height, s.wrapV),
            wrapTexel(y + 1, height, s.wrapV),
            float(u - fu),
            float(v - fv)};
}

template<class Texel> auto mixTexels(const TexelSquare& s, Texel texel)
{
    const auto top = glm::mix(texel(s.x0, s.y0), texel(s.x1, s.y0), s.kx);
    const auto bottom = glm::mix(texel(s.x0, s.y1), texel(s.x1, s.y1), s.kx);
    return glm::mix(top, bottom, s.ky);
}

// Bilinear interpolation of the four texels around uv.
template<class Texel> auto bilinearTexel(int width, int height, const Sampler& s, glm::dvec2 uv, Texel texel)
{
    return mixTexels(texelsAround(width, height, s, uv), texel);
}

// ---- normals ---------------------------------------------------------------------------------

// Format: f32:: or f64::cotan_normal_format. type: of the components that are read or written; zero is at the middle of
// its range. strength: factor on the slopes.
template<class Format> Format toFormat(const Convention& c, PixelType type, double strength = 1)
{
    return toFormat<Format>(c, strength, bitsPerComponent(type));
}

// Converts a map's convention to that of a scene, where v runs down: green up or down then refers to the image.
constexpr Convention inScene(Convention c)
{
    c.v = VDirection::down;
    return c;
}

} // namespace cotan
