// The compiled shaders.
#pragma once

#include <cstdint>
#include <span>

namespace cotan {

enum class Shader {
    forwardVert,
    // For opaque materials, masked ones and translucent layers; of these for materials without and with what extensions
    // add; of these without and with the frame `exact` (needs the features geometryShader, for gl_PrimitiveID, and
    // buffer addresses).
    forwardFrag,
    forwardExactFrag,
    forwardExtendedFrag,
    forwardExactExtendedFrag,
    forwardMaskedFrag,
    forwardExactMaskedFrag,
    forwardExtendedMaskedFrag,
    forwardExactExtendedMaskedFrag,
    forwardLayersFrag,
    forwardExactLayersFrag,
    forwardExtendedLayersFrag,
    forwardExactExtendedLayersFrag,
    composeVert,
    composeFrag,
    composeMultisampledFrag,
    resolveFrag,
    resolveMultisampledFrag,
    backgroundVert,
    backgroundFrag,
    shadowVert,
    shadowFrag,
};

// SPIR-V words.
std::span<const std::uint32_t> spirv(Shader shader);

} // namespace cotan
