#include "languages.hpp"

#include <algorithm>

#include "core/named_values.hpp"
#include "cpp_prelude.hpp" // prelude/*.txt

namespace cotan::shader_text {

namespace {

constexpr std::string_view kMslPrelude = R"(#include <metal_stdlib>
using namespace metal;

)";

// Two halfs in a word, for languages without such a function. HLSL's f32tof16 may cut off instead of rounding.
constexpr std::string_view kHlslHalfs = R"(uint cotan_pack_half(float2 v)
{
    uint2 w = f32tof16(asfloat((asuint(v) + 0x1000u) & 0xffffe000u));
    return w.x | (w.y << 16u);
}
float2 cotan_unpack_half(uint word) { return float2(f16tof32(word & 0xffffu), f16tof32(word >> 16u)); }

)";

constexpr std::string_view kMslHalfs = R"(inline uint cotan_pack_half(float2 v) { return as_type<uint>(half2(v)); }
inline float2 cotan_unpack_half(uint word) { return float2(as_type<half2>(word)); }

)";

constexpr Word kWords[] = {
    // portable, GLSL, HLSL, WGSL, MSL
    {"cotan_real", "float", "float", "f32", "float"},
    {"cotan_vec2", "vec2", "float2", "vec2f", "float2"},
    {"cotan_vec3", "vec3", "float3", "vec3f", "float3"},
    {"cotan_vec4", "vec4", "float4", "vec4f", "float4"},
    {"cotan_uint", "uint", "uint", "u32", "uint"},
    {"int", "", "", "i32", ""},
    {"cotan_inversesqrt", "inversesqrt", "rsqrt", "inverseSqrt", "rsqrt"},
    {"cotan_mix", "mix", "lerp", "mix", "mix"},
    {"cotan_float_bits", "floatBitsToUint", "asuint", "bitcast<u32>", "as_type<uint>"},
    {"cotan_bits_float", "uintBitsToFloat", "asfloat", "bitcast<f32>", "as_type<float>"},
    {"cotan_real_of", "float", "float", "f32", "float"},
    {"cotan_pack_half", "packHalf2x16", "", "pack2x16float", ""},
    {"cotan_unpack_half", "unpackHalf2x16", "", "unpack2x16float", ""},
    {"cotan_ddx", "dFdx", "ddx_fine", "dpdxFine", "dfdx"},
    {"cotan_ddy", "dFdy", "ddy_fine", "dpdyFine", "dfdy"},
    {"target", "", "", "target_normal", ""}, // a reserved word
};

// In the order of Language.
constexpr LanguageInfo kInfos[] = {
    {.name = "glsl",
     .title = "GLSL 3.30 and later",
     .titleWithHalfs = "GLSL 4.20 and later", // packHalf2x16
     .sample = "texture(normal_map, uv).xyz",
     .grammar = {.words = &Word::glsl}},
    {.name = "essl",
     .title = "GLSL ES 3.00 (WebGL 2)",
     .sample = "texture(normal_map, uv).xyz",
     .cornersIn = "data textures",
     .limits = "//   The shader must say: precision highp float; precision highp int;\n",
     .grammar = {.words = &Word::glsl}},
    {.name = "hlsl",
     .title = "HLSL, shader model 5 and later",
     .sample = "normal_map.Sample(map_sampler, uv).xyz",
     .halfs = kHlslHalfs,
     .grammar = {.words = &Word::hlsl}},
    {.name = "wgsl",
     .title = "WGSL",
     .sample = "textureSample(normal_map, map_sampler, uv).xyz",
     .limits = "//   WGSL lets an implementation assume that no number is NaN or infinite: the guards against\n"
               "//   non-finite input may then not hold. Those against zeros and empty areas do.\n",
     .grammar = {.words = &Word::wgsl, .typesAfterNames = true}},
    {.name = "msl",
     .title = "Metal shading language",
     .sample = "normal_map.sample(map_sampler, uv).xyz",
     .limits = "//   Fast mathematics, Metal's default, may drop the guards against non-finite input; compile\n"
               "//   with -fno-fast-math where these matter. Those against zeros and empty areas stay.\n",
     .prelude = kMslPrelude,
     .halfs = kMslHalfs,
     .grammar = {.words = &Word::msl, .floatSuffix = "f", .functionPrefix = "inline "}},
    {.name = "cpp",
     .title = "C++17",
     .branch = "COTAN_LANG_CPP",
     .sample = "texel",
     .scope = "cotan_shader::",
     .limits = "//   Change cotan_real to double for double precision.\n",
     .prelude = kCppPrelude,
     .halfs = kCppHalfs,
     .postlude = "\n} // namespace cotan_shader\n",
     .grammar = {.functionPrefix = "inline ", .realCalls = true, .braces = true}},
    // The common part of Godot 3 and 4: the words of GLSL, but no structs. OpenGL ES 2 has no access to the bits of
    // floats; lang.h handles that.
    {.name = "godot",
     .title = "Godot 3.2 and later and Godot 4",
     .branch = "COTAN_LANG_GODOT",
     .sample = "texture(normal_map, uv).xyz",
     .limits = "//   GLES2 on phones may compute with 16 bits, which is too little for positions: use GLES3 there.\n"
               "//   Whether guards against non-finite input hold is up to the driver.\n",
     .grammar = {.words = &Word::glsl, .structs = false}},
};
static_assert(std::size(kInfos) == std::size(kLanguages));

} // namespace

const LanguageInfo& infoOf(Language language) { return kInfos[std::size_t(language)]; }

std::string_view name(Language language) { return infoOf(language).name; }

std::string languageNames()
{
    std::vector<std::string> names;
    for (const LanguageInfo& info : kInfos)
        names.emplace_back(info.name);
    return eitherOf(names);
}

std::optional<Language> languageFromName(std::string_view text)
{
    const auto found = std::ranges::find(kLanguages, text, [](Language l) { return name(l); });
    return found == std::end(kLanguages) ? std::nullopt : std::optional(*found);
}

std::string_view name(Stage stage)
{
    constexpr std::string_view kStageNames[] = {"all", "fragment", "vertex", "mesh", "compute"};
    return textAt(kStageNames, stage, 0);
}

std::optional<Stage> stageFromName(std::string_view text)
{
    const auto found = std::ranges::find(kStages, text, [](Stage s) { return name(s); });
    return found == std::end(kStages) ? std::nullopt : std::optional(*found);
}

std::string wordOf(Language language, const std::string& portable)
{
    const auto own = infoOf(language).grammar.words;
    for (const Word& word : kWords)
        if (own && word.portable == portable && !(word.*own).empty())
            return std::string(word.*own);
    return portable;
}

} // namespace cotan::shader_text
