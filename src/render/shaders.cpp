#include "shaders.hpp"

#include "cotanBackgroundFrag.h"
#include "cotanBackgroundVert.h"
#include "cotanComposeFrag.h"
#include "cotanComposeMultisampledFrag.h"
#include "cotanComposeVert.h"
#include "cotanForwardExactExtendedFrag.h"
#include "cotanForwardExactFrag.h"
#include "cotanForwardExactLayersExtendedFrag.h"
#include "cotanForwardExactLayersFrag.h"
#include "cotanForwardExtendedFrag.h"
#include "cotanForwardFrag.h"
#include "cotanForwardLayersExtendedFrag.h"
#include "cotanForwardLayersFrag.h"
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
    case Shader::forwardLayersFrag: return cotanForwardLayersFrag;
    case Shader::forwardExactLayersFrag: return cotanForwardExactLayersFrag;
    case Shader::forwardExtendedFrag: return cotanForwardExtendedFrag;
    case Shader::forwardExactExtendedFrag: return cotanForwardExactExtendedFrag;
    case Shader::forwardLayersExtendedFrag: return cotanForwardLayersExtendedFrag;
    case Shader::forwardExactLayersExtendedFrag: return cotanForwardExactLayersExtendedFrag;
    case Shader::composeVert: return cotanComposeVert;
    case Shader::composeFrag: return cotanComposeFrag;
    case Shader::composeMultisampledFrag: return cotanComposeMultisampledFrag;
    case Shader::backgroundVert: return cotanBackgroundVert;
    case Shader::backgroundFrag: return cotanBackgroundFrag;
    case Shader::shadowVert: return cotanShadowVert;
    case Shader::shadowFrag: return cotanShadowFrag;
    }
    return {};
}

} // namespace cotan
