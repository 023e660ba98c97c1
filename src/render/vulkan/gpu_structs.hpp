// The structs of shaders/gpu_structs.glsl as C++.
#pragma once

#include <cstddef>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace cotan::gpu {

using glm::ivec4;
using glm::uvec2;
using glm::uvec4;
using glm::vec4;
using uint = glm::uint;

#include "gpu_structs.glsl"

static_assert(sizeof(CotanTextureUse) == 32);
static_assert(sizeof(CotanMaterial) == 160 + COTAN_MAP_COUNT * sizeof(CotanTextureUse));
static_assert(sizeof(CotanLight) == 64);
static_assert(sizeof(CotanView) == 15 * 16);
static_assert(sizeof(CotanDraw) == 128);
static_assert(offsetof(CotanDraw, flags) == 120);
static_assert(sizeof(CotanLayerLists) == 20);
static_assert(sizeof(CotanLayer) == 48);

} // namespace cotan::gpu
