#include "languages.hpp"

#include <algorithm>

#include "core/named_values.hpp"

namespace cotan::shader_text {

namespace {

constexpr std::string_view kMslPrelude = R"(#include <metal_stdlib>
using namespace metal;

)";

constexpr std::string_view kCppPrelude = R"(#include <cmath>
#include <cstdint>
#include <cstring>

namespace cotan_shader {

using cotan_real = float; // or double
using cotan_uint = std::uint32_t;

struct cotan_vec2 { cotan_real x, y; };
struct cotan_vec3 { cotan_real x, y, z; };
struct cotan_vec4 { cotan_real x, y, z, w; };

inline cotan_vec3 operator+(cotan_vec3 a, cotan_vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline cotan_vec3 operator-(cotan_vec3 a, cotan_vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline cotan_vec3 operator*(cotan_vec3 a, cotan_vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline cotan_vec3 operator*(cotan_vec3 a, cotan_real k) { return {a.x * k, a.y * k, a.z * k}; }
inline cotan_vec3 operator/(cotan_vec3 a, cotan_vec3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
inline cotan_vec3 operator/(cotan_vec3 a, cotan_real k) { return {a.x / k, a.y / k, a.z / k}; }
inline cotan_vec2 operator+(cotan_vec2 a, cotan_vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline cotan_vec2 operator*(cotan_vec2 a, cotan_real k) { return {a.x * k, a.y * k}; }
inline cotan_vec2 operator-(cotan_vec2 a, cotan_vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline cotan_vec4 operator*(cotan_vec4 a, cotan_real k) { return {a.x * k, a.y * k, a.z * k, a.w * k}; }
inline cotan_real dot(cotan_vec2 a, cotan_vec2 b) { return a.x * b.x + a.y * b.y; }
inline cotan_real dot(cotan_vec3 a, cotan_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline cotan_vec3 cross(cotan_vec3 a, cotan_vec3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline cotan_real max(cotan_real a, cotan_real b) { return a < b ? b : a; }
inline cotan_real min(cotan_real a, cotan_real b) { return b < a ? b : a; }
using std::abs;
using std::copysign;
using std::exp2;
using std::log2;
using std::pow;
using std::sqrt;

// 1 / 2^e for 2^e <= m < 2^(e+1), from the bits of m's exponent. m: in [1e-37, 1e37].
inline float cotan_inverse_power_of_two(float m)
{
    std::uint32_t bits;
    std::memcpy(&bits, &m, sizeof m);
    bits = 0x7f000000u - (bits & 0x7f800000u);
    std::memcpy(&m, &bits, sizeof m);
    return m;
}
inline double cotan_inverse_power_of_two(double m)
{
    std::uint64_t bits;
    std::memcpy(&bits, &m, sizeof m);
    bits = 0x7fe0000000000000u - (bits & 0x7ff0000000000000u);
    std::memcpy(&m, &bits, sizeof m);
    return m;
}

)";

// Two halfs in a word, for languages without such a function.
constexpr std::string_view kHlslHalfs = R"(uint cotan_pack_half(float2 v)
{
    return f32tof16(v.x) | (f32tof16(v.y) << 16u);
}
float2 cotan_unpack_half(uint word)
{
    return float2(f16tof32(word & 0xffffu), f16tof32(word >> 16u));
}

)";

constexpr std::string_view kMslHalfs = R"(inline uint cotan_pack_half(float2 v) { return as_type<uint>(half2(v)); }
inline float2 cotan_unpack_half(uint word) { return float2(as_type<half2>(word)); }

)";

constexpr std::string_view kCppHalfs = R"(// Rounded to the nearest, ties to even.
inline std::uint32_t cotan_half_bits(float x)
{
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    const std::uint32_t sign = bits >> 16 & 0x8000u;
    std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u)
        return sign | 0x7e00u; // NaN
    if (magnitude >= 0x47800000u)
        return sign | 0x7c00u; // too large: infinity
    if (magnitude < 0x38800000u) { // subnormal: the addition rounds
        float shifted;
        std::memcpy(&shifted, &magnitude, sizeof shifted);
        shifted += 0.5f;
        std::memcpy(&magnitude, &shifted, sizeof magnitude);
        return sign | (magnitude - 0x3f000000u);
    }
    return sign | (magnitude + 0xfffu + (magnitude >> 13 & 1u) - 0x38000000u) >> 13;
}
inline float cotan_float_of_half(std::uint32_t half)
{
    std::uint32_t bits = (half & 0x7fffu) << 13;
    float x;
    std::memcpy(&x, &bits, sizeof x);
    x *= 5192296858534827628530496329220096.0f; // 2^112
    std::memcpy(&bits, &x, sizeof bits);
    bits |= (half & 0x7c00u) == 0x7c00u ? 0x7f800000u : 0u;
    bits |= (half & 0x8000u) << 16;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}
inline cotan_uint cotan_pack_half(cotan_vec2 v)
{
    return cotan_half_bits(float(v.x)) | cotan_half_bits(float(v.y)) << 16;
}
inline cotan_vec2 cotan_unpack_half(cotan_uint word)
{
    return {cotan_float_of_half(word & 0xffffu), cotan_float_of_half(word >> 16)};
}

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
