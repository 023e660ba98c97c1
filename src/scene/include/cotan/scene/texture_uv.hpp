// The uv that a texture is read with.
#pragma once

#include <vector>

#include "cotan/scene/scene.hpp"

namespace cotan {

// uv of the mesh, moved as the texture says (KHR_texture_transform). A texture without an image moves nothing.
inline glm::vec2 textureUv(const Texture& texture, glm::vec2 uv)
{
    if (!texture.present())
        return uv;
    return {texture.uRow.x * uv.x + texture.uRow.y * uv.y + texture.uRow.z,
            texture.vRow.x * uv.x + texture.vRow.y * uv.y + texture.vRow.z};
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
