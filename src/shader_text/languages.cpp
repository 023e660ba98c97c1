#include "print.hpp"

namespace cotan::shader_text {

namespace {

const Names kGlsl = {{{"cotan_real", "float"},
                      {"cotan_vec2", "vec2"},
                      {"cotan_vec3", "vec3"},
                      {"cotan_vec4", "vec4"},
                      {"cotan_uint", "uint"},
                      {"cotan_inversesqrt", "inversesqrt"},
                      {"cotan_mix", "mix"},
                      {"cotan_float_bits", "floatBitsToUint"},
                      {"cotan_bits_float", "uintBitsToFloat"},
                      {"cotan_ddx", "dFdx"},
                      {"cotan_ddy", "dFdy"}},
                     "",
                     "",
                     "dFdx",
                     "dFdy",
                     false,
                     false,
                     false};

const Names kHlsl = {{{"cotan_real", "float"},
                      {"cotan_vec2", "float2"},
                      {"cotan_vec3", "float3"},
                      {"cotan_vec4", "float4"},
                      {"cotan_uint", "uint"},
                      {"cotan_inversesqrt", "rsqrt"},
                      {"cotan_mix", "lerp"},
                      {"cotan_float_bits", "asuint"},
                      {"cotan_bits_float", "asfloat"},
                      {"cotan_ddx", "ddx_fine"},
                      {"cotan_ddy", "ddy_fine"}},
                     "",
                     "",
                     "ddx_fine",
                     "ddy_fine",
                     false,
                     false,
                     false};

const Names kWgsl = {{{"cotan_real", "f32"},
                      {"cotan_vec2", "vec2f"},
                      {"cotan_vec3", "vec3f"},
                      {"cotan_vec4", "vec4f"},
                      {"cotan_uint", "u32"},
                      {"int", "i32"},
                      {"cotan_inversesqrt", "inverseSqrt"},
                      {"cotan_mix", "mix"},
                      {"cotan_float_bits", "bitcast<u32>"},
                      {"cotan_bits_float", "bitcast<f32>"},
                      {"cotan_ddx", "dpdxFine"},
                      {"cotan_ddy", "dpdyFine"},
                      {"target", "target_normal"}}, // a reserved word
                     "",
                     "",
                     "dpdxFine",
                     "dpdyFine",
                     false,
                     false,
                     true};

const Names kMsl = {{{"cotan_real", "float"},
                     {"cotan_vec2", "float2"},
                     {"cotan_vec3", "float3"},
                     {"cotan_vec4", "float4"},
                     {"cotan_uint", "uint"},
                     {"cotan_inversesqrt", "rsqrt"},
                     {"cotan_mix", "mix"},
                     {"cotan_float_bits", "as_type<uint>"},
                     {"cotan_bits_float", "as_type<float>"},
                     {"cotan_ddx", "dfdx"},
                     {"cotan_ddy", "dfdy"}},
                    "f",
                    "inline ",
                    "dfdx",
                    "dfdy",
                    false,
                    false,
                    false};

const Names kCpp = {{}, "", "inline ", "", "", true, true, false};

constexpr std::string_view kMslPrelude = R"(#include <metal_stdlib>
using namespace metal;

)";

constexpr std::string_view kCppPrelude = R"(#include <cmath>
#include <cstdint>
#include <cstring>

namespace cotan_shader {

using cotan_real = float; // or double

struct cotan_vec2 { cotan_real x, y; };
struct cotan_vec3 { cotan_real x, y, z; };

inline cotan_vec3 operator+(cotan_vec3 a, cotan_vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline cotan_vec3 operator-(cotan_vec3 a, cotan_vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline cotan_vec3 operator*(cotan_vec3 a, cotan_vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline cotan_vec3 operator*(cotan_vec3 a, cotan_real k) { return {a.x * k, a.y * k, a.z * k}; }
inline cotan_vec3 operator/(cotan_vec3 a, cotan_real k) { return {a.x / k, a.y / k, a.z / k}; }
inline cotan_vec2 operator*(cotan_vec2 a, cotan_real k) { return {a.x * k, a.y * k}; }
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

constexpr std::string_view kNames[] = {"glsl", "essl", "hlsl", "wgsl", "msl", "cpp"};

} // namespace

std::string_view name(Language language) { return kNames[int(language)]; }

std::optional<Language> languageFromName(std::string_view text)
{
    for (Language l : kLanguages)
        if (name(l) == text)
            return l;
    return std::nullopt;
}

const Names& namesOf(Language language)
{
    switch (language) {
    case Language::glsl:
    case Language::essl: return kGlsl;
    case Language::hlsl: return kHlsl;
    case Language::wgsl: return kWgsl;
    case Language::msl: return kMsl;
    case Language::cpp: break;
    }
    return kCpp;
}

std::string_view prelude(Language language)
{
    return language == Language::msl ? kMslPrelude : language == Language::cpp ? kCppPrelude : std::string_view();
}

std::string_view postlude(Language language)
{
    return language == Language::cpp ? std::string_view("\n} // namespace cotan_shader\n") : std::string_view();
}

std::string wordOf(Language language, const std::string& portable)
{
    const auto& words = namesOf(language).words;
    const auto word = words.find(portable);
    return word == words.end() ? portable : word->second;
}

} // namespace cotan::shader_text
