#include "shaders.hpp"

#include "cotanBackgroundFrag.h"
#include "cotanBackgroundVert.h"
#include "cotanComposeFrag.h"
#include "cotanComposeMultisampledFrag.h"
#include "cotanComposeVert.h"
#include "cotanForwardExactExtendedFrag.h"
#include "cotanForwardExactExtendedLayersFrag.h"
#include "cotanForwardExactExtendedMaskedFrag.h"
#include "cotanForwardExactFrag.h"
#include "cotanForwardExactLayersFrag.h"
#include "cotanForwardExactMaskedFrag.h"
#include "cotanForwardExtendedFrag.h"
#include "cotanForwardExtendedLayersFrag.h"
#include "cotanForwardExtendedMaskedFrag.h"
#include "cotanForwardFrag.h"
#include "cotanForwardLayersFrag.h"
#include "cotanForwardMaskedFrag.h"
#include "cotanForwardVert.h"
#include "cotanResolveFrag.h"
#include "cotanResolveMultisampledFrag.h"
#include "cotanShadowFrag.h"
#include "cotanShadowVert.h"

namespace cotan {

std::span<const std::uint32_t> spirv(Shader shader)
{
    switch (shader) {
    case Shader::forwardVert: return cotanForwardVert;
    case Shader::forwardFrag: return cotanForwardFrag;
    case Shader::forwardExactFrag: return cotanForwardExactFrag;
    case Shader::forwardExtendedFrag: return cotanForwardExtendedFrag;
    case Shader::forwardExactExtendedFrag: return cotanForwardExactExtendedFrag;
    case Shader::forwardMaskedFrag: return cotanForwardMaskedFrag;
    case Shader::forwardExactMaskedFrag: return cotanForwardExactMaskedFrag;
    case Shader::forwardExtendedMaskedFrag: return cotanForwardExtendedMaskedFrag;
    case Shader::forwardExactExtendedMaskedFrag: return cotanForwardExactExtendedMaskedFrag;
    case Shader::forwardLayersFrag: return cotanForwardLayersFrag;
    case Shader::forwardExactLayersFrag: return cotanForwardExactLayersFrag;
    case Shader::forwardExtendedLayersFrag: return cotanForwardExtendedLayersFrag;
    case Shader::forwardExactExtendedLayersFrag: return cotanForwardExactExtendedLayersFrag;
    case Shader::composeVert: return cotanComposeVert;
    case Shader::composeFrag: return cotanComposeFrag;
    case Shader::composeMultisampledFrag: return cotanComposeMultisampledFrag;
    case Shader::resolveFrag: return cotanResolveFrag;
    case Shader::resolveMultisampledFrag: return cotanResolveMultisampledFrag;
    case Shader::backgroundVert: return cotanBackgroundVert;
    case Shader::backgroundFrag: return cotanBackgroundFrag;
    case Shader::shadowVert: return cotanShadowVert;
    case Shader::shadowFrag: return cotanShadowFrag;
    }
    return {};
}

} // namespace cotan
