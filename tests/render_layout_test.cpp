// The structs that C++ fills have the memory layout that the compiled shaders read.
#include <initializer_list>
#include <map>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "cotan_shaders.h"
#include "gpu_structs.hpp"

namespace cotan {

namespace {

using Spirv = std::span<const std::uint32_t>;

// "Struct.member" -> byte offset, from the names and decorations of a SPIR-V module.
std::map<std::string, std::uint32_t> memberOffsets(Spirv words)
{
    constexpr std::uint32_t kName = 5, kMemberName = 6, kMemberDecorate = 72, kOffset = 35;
    std::map<std::uint32_t, std::string> structs;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> members;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> offsets;
    for (std::size_t i = 5; i < words.size();) {
        const std::uint32_t length = words[i] >> 16;
        const auto text = [&](std::size_t at) { return std::string(reinterpret_cast<const char*>(&words[i + at])); };
        switch (words[i] & 0xffff) {
        case kName: structs[words[i + 1]] = text(2); break;
        case kMemberName: members[{words[i + 1], words[i + 2]}] = text(3); break;
        case kMemberDecorate:
            if (words[i + 3] == kOffset)
                offsets[{words[i + 1], words[i + 2]}] = words[i + 4];
            break;
        }
        if (length == 0)
            break;
        i += length;
    }
    std::map<std::string, std::uint32_t> result;
    for (const auto& [at, offset] : offsets)
        result[structs[at.first] + "." + members[at]] = offset;
    return result;
}

#define EXPECT_OFFSET(type, member)                                                                                    \
    ASSERT_TRUE(offsets.contains(#type "." #member)) << #type "." #member;                                             \
    EXPECT_EQ(offsets.at(#type "." #member), offsetof(gpu::type, member)) << #type "." #member

} // namespace

TEST(RenderLayout, fragmentStageHasTheOffsetsOfMaterialLightAndView)
{
    for (const Spirv& shader : std::initializer_list<Spirv>{cotanForwardFrag, cotanForwardExactFrag}) {
        const auto offsets = memberOffsets(shader);
        EXPECT_OFFSET(CotanTextureUse, uRow);
        EXPECT_OFFSET(CotanTextureUse, vRow);
        EXPECT_OFFSET(CotanMaterial, baseColor);
        EXPECT_OFFSET(CotanMaterial, emissive);
        EXPECT_OFFSET(CotanMaterial, factors);
        EXPECT_OFFSET(CotanMaterial, normalMap);
        EXPECT_OFFSET(CotanMaterial, baseColorMap);
        EXPECT_OFFSET(CotanMaterial, metallicRoughnessMap);
        EXPECT_OFFSET(CotanMaterial, normalMapUse);
        EXPECT_OFFSET(CotanMaterial, occlusionMap);
        EXPECT_OFFSET(CotanMaterial, emissiveMap);
        EXPECT_OFFSET(CotanLight, position);
        EXPECT_OFFSET(CotanLight, direction);
        EXPECT_OFFSET(CotanLight, color);
        EXPECT_OFFSET(CotanLight, cone);
        EXPECT_OFFSET(CotanView, forward);
        EXPECT_OFFSET(CotanView, shadowX);
        EXPECT_OFFSET(CotanView, shadow);
        EXPECT_OFFSET(CotanView, tone);
        EXPECT_OFFSET(CotanView, counts);
    }
}

TEST(RenderLayout, extendedFragmentStageHasTheOffsetsOfTheExtensions)
{
    for (const Spirv& shader :
         std::initializer_list<Spirv>{cotanForwardExtendedFrag, cotanForwardExactExtendedFrag,
                                      cotanForwardExtendedMaskedFrag, cotanForwardExactExtendedLayersFrag}) {
        const auto offsets = memberOffsets(shader);
        EXPECT_OFFSET(CotanMaterial, coat);
        EXPECT_OFFSET(CotanMaterial, coatNormalMap);
        EXPECT_OFFSET(CotanMaterial, anisotropy);
        EXPECT_OFFSET(CotanMaterial, specular);
        EXPECT_OFFSET(CotanMaterial, sheen);
        EXPECT_OFFSET(CotanMaterial, coatMap);
        EXPECT_OFFSET(CotanMaterial, transmissionMap);
        EXPECT_OFFSET(CotanMaterial, heights);
        EXPECT_OFFSET(CotanMaterial, heightMapUse);
    }
}

TEST(RenderLayout, vertexStageHasTheOffsetsOfViewAndDraw)
{
    const auto offsets = memberOffsets(cotanForwardVert);
    EXPECT_OFFSET(CotanView, clipX);
    EXPECT_OFFSET(CotanView, clipY);
    EXPECT_OFFSET(CotanView, clipZ);
    EXPECT_OFFSET(CotanView, clipW);
    EXPECT_OFFSET(CotanView, right);
    EXPECT_OFFSET(CotanView, up);
    EXPECT_OFFSET(CotanDraw, rowX);
    EXPECT_OFFSET(CotanDraw, rowZ);
    EXPECT_OFFSET(CotanDraw, normalX);
    EXPECT_OFFSET(CotanDraw, normalZ);
    EXPECT_OFFSET(CotanDraw, positions);
    EXPECT_OFFSET(CotanDraw, texcoords);
    EXPECT_OFFSET(CotanDraw, indices);
    EXPECT_OFFSET(CotanDraw, flags);
}

TEST(RenderLayout, layerShadersHaveTheOffsetsOfTheLayerLists)
{
    for (const Spirv& shader : std::initializer_list<Spirv>{cotanForwardLayersFrag, cotanForwardExactLayersFrag,
                                                            cotanComposeFrag, cotanComposeMultisampledFrag}) {
        const auto offsets = memberOffsets(shader);
        EXPECT_OFFSET(CotanLayerLists, count);
        EXPECT_OFFSET(CotanLayerLists, capacity);
        EXPECT_OFFSET(CotanLayerLists, width);
        EXPECT_OFFSET(CotanLayerLists, top);
        EXPECT_OFFSET(CotanLayer, light);
        EXPECT_OFFSET(CotanLayer, transmittance);
        EXPECT_OFFSET(CotanLayer, depthY);
        EXPECT_OFFSET(CotanLayer, orderAndCoverage);
        EXPECT_OFFSET(CotanLayer, previous);
    }
    EXPECT_EQ(memberOffsets(cotanComposeFrag).at("ListBlock.newest"), sizeof(gpu::CotanLayerLists));
}

} // namespace cotan
