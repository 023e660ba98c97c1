// The compiled shaders.
#pragma once

#include <cstdint>
#include <span>

namespace cotan {

enum class Shader {
    forwardVert,
    forwardFrag,
    forwardExactFrag, // needs the features geometryShader (for gl_PrimitiveID) and buffer addresses
    forwardLayersFrag,
    forwardExactLayersFrag, // as forwardExactFrag
    forwardExtendedFrag,    // from here on with what extensions add to materials
    forwardExactExtendedFrag,
    forwardLayersExtendedFrag,
    forwardExactLayersExtendedFrag,
    composeVert,
    composeFrag,
    composeMultisampledFrag,
    backgroundVert,
    backgroundFrag,
    shadowVert,
    shadowFrag,
};

inline constexpr int kShaderCount = 16;

// SPIR-V words.
std::span<const std::uint32_t> spirv(Shader shader);

} // namespace cotan
