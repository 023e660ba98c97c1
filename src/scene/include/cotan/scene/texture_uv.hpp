// The uv that a texture is read with.
#pragma once

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

} // namespace cotan
