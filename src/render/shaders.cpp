#include "shaders.hpp"

#include "cotanBackgroundFrag.h"
#include "cotanBackgroundVert.h"
#include "cotanForwardExactFrag.h"
#include "cotanForwardFrag.h"
#include "cotanForwardVert.h"
#include "cotanShadowFrag.h"
#include "cotanShadowVert.h"

namespace cotan {

std::span<const std::uint32_t> spirv(Shader shader)
{
    switch (shader) {
    case Shader::forwardVert: return cotanForwardVert;
    case Shader::forwardFrag: return cotanForwardFrag;
    case Shader::forwardExactFrag: return cotanForwardExactFrag;
    case Shader::backgroundVert: return cotanBackgroundVert;
    case Shader::backgroundFrag: return cotanBackgroundFrag;
    case Shader::shadowVert: return cotanShadowVert;
    case Shader::shadowFrag: return cotanShadowFrag;
    }
    return {};
}

} // namespace cotan
