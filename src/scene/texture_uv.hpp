// The uv that a texture is read with.
#pragma once

#include <vector>

#include "cotan/scene.hpp"

namespace cotan {

// uv moved by the rows of an affine map, reckoned in the type of the rows.
template<class T> glm::vec2 moveUv(const glm::vec<3, T>& uRow, const glm::vec<3, T>& vRow, const glm::vec2& uv)
{
    const glm::vec<2, T> p(uv);
    return glm::vec2(uRow.x * p.x + uRow.y * p.y + uRow.z, vRow.x * p.x + vRow.y * p.y + vRow.z);
}

// uv of the mesh, moved as the texture says (KHR_texture_transform). A texture without an image moves nothing.
inline glm::vec2 textureUv(const Texture& texture, glm::vec2 uv)
{
    return texture.present() ? moveUv(texture.uRow, texture.vRow, uv) : uv;
}

// The uv set that a texture asks for; 0 for one without an image.
inline std::size_t uvSetOf(const Texture& texture) { return texture.present() && texture.texcoord == 1 ? 1 : 0; }

// The uv that a mesh's texture is read with, a vertex each. Empty if the mesh has none.
inline std::vector<glm::vec2> textureUv(const Texture& texture, const Mesh& mesh)
{
    std::vector<glm::vec2> uv = mesh.texcoords[uvSetOf(texture)];
    for (glm::vec2& c : uv)
        c = textureUv(texture, c);
    return uv;
}

} // namespace cotan
