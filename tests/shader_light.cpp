// Lighting cases for every language: the surfaces that are lit, the functions, and the allowed rounding errors.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/render_text.hpp"
#include "shader_cases.hpp"
#include "truth/patch.hpp"

namespace cotan::test {

namespace {

using shader_text::Language;

// A lit surface, from the sixteen numbers of a sample.
struct Lit {
    f64::cotan_surface s;
    glm::dvec3 l;
    double x; // -1.5 to 1.5: a distance, or the argument of a step
    double y; // 0 to 1: a range, an exposure, and the occlusion
    f64::cotan_coat c;
    f64::cotan_gloss g;
    f64::cotan_sheen h;
};

using Numbers = std::array<double, 16>;

Numbers numbersOf(const Vectors& v)
{
    return {v.n.x,    v.n.y,     v.n.z,     v.dpdx.x,  v.dpdx.y,  v.dpdx.z,  v.dpdy.x,  v.dpdy.y,
            v.dpdy.z, v.duvdx.x, v.duvdx.y, v.duvdy.x, v.duvdy.y, v.texel.x, v.texel.y, v.texel.z};
}

Lit litOf(const Numbers& v)
{
    Lit lit;
    lit.s.base_color = lit.s.emissive = {v[13], v[14], v[15]};
    lit.s.metallic = v[9];
    lit.s.roughness = v[10];
    lit.s.occlusion = v[12];
    lit.s.n = {v[0], v[1], v[2]};
    lit.s.v = {v[6], v[7], v[8]};
    lit.l = {v[3], v[4], v[5]};
    lit.x = v[11];
    lit.y = v[12];
    lit.c = {lit.y, lit.s.roughness, lit.s.n};
    lit.g = f64::cotan_gloss_of(std::abs(lit.x), lit.y, lit.s.base_color);
    lit.g.transmission = lit.s.metallic;
    lit.h = {lit.s.base_color, lit.s.roughness};
    lit.g.anisotropy = lit.y;
    lit.g.t = f64::cotan_direction_on_surface(lit.s.n, {1, lit.x, -lit.y}, lit.s.base_color, {lit.x, lit.y}, lit.s.n);
    return lit;
}

constexpr char kLitText[] =
    "COTAN_FUNCTION cotan_vec3 cotan_case(cotan_vec3 n, cotan_vec3 l, cotan_vec3 v, cotan_vec2 material, "
    "cotan_vec2 xy, cotan_vec3 color)\n{\n"
    "    cotan_surface s;\n"
    "    s.base_color = color;\n    s.metallic = material.x;\n    s.roughness = material.y;\n"
    "    s.occlusion = xy.y;\n    s.emissive = color;\n    s.n = n;\n    s.v = v;\n"
    "    cotan_real x = xy.x;\n    cotan_real y = xy.y;\n"
    "    cotan_coat c;\n    c.strength = xy.y;\n    c.roughness = material.y;\n    c.n = n;\n"
    "    cotan_gloss g = cotan_gloss_of(abs(xy.x), xy.y, color);\n    g.transmission = material.x;\n"
    "    cotan_sheen h;\n    h.color = color;\n    h.roughness = material.y;\n    g.anisotropy = xy.y;\n"
    "    g.t = cotan_direction_on_surface(n, cotan_vec3(cotan_real(1.0), xy.x, -xy.y), color, xy, n);\n    return ";

template<class Function> Case litCase(const std::string& label, const std::string& line, Function function)
{
    Case c;
    c.name = label;
    c.light = true;
    c.call = "cotan_case(n, dpdx, dpdy, duvdx, duvdy, m)";
    c.text = [line](Language l) { return shader_text::translate(l, kLitText + line + ";\n}\n"); };
    c.expected = [function](const Vectors& v) { return function(litOf(numbersOf(v))); };
    // Rounding errors of unit vectors are proportional to 1, those of other numbers to the number itself.
    c.allowance = [function](const Vectors& v) {
        const Numbers numbers = numbersOf(v);
        const glm::dvec3 value = function(litOf(numbers));
        glm::dvec3 sum(std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)}) * kRounding);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const double step = kRounding * (k < 9 ? 1.0 : std::abs(numbers[k]));
            glm::dvec3 most(0);
            for (double side : {-step, step}) {
                Numbers moved = numbers;
                moved[k] += side;
                most = glm::max(most, glm::abs(function(litOf(moved)) - value));
            }
            sum += most;
        }
        return sum;
    };
    return c;
}

// A case given by one line of portable text, which is also compiled as C++ with the names of f64.
#define COTAN_LIT_CASE(label, ...)                                                                                     \
    litCase(label, #__VA_ARGS__, [](const Lit& lit) -> glm::dvec3 {                                                    \
        using namespace f64;                                                                                           \
        const cotan_surface& s = lit.s;                                                                                \
        const glm::dvec3 l = lit.l;                                                                                    \
        const double x = lit.x, y = lit.y;                                                                             \
        const cotan_coat& c = lit.c;                                                                                   \
        const cotan_gloss& g = lit.g;                                                                                  \
        const cotan_sheen& h = lit.h;                                                                                  \
        (void)s, (void)l, (void)x, (void)y, (void)c, (void)g, (void)h;                                                 \
        return __VA_ARGS__;                                                                                            \
    })

// A unit vector whose angle to z has the cosine `c`.
glm::vec3 leaned(Random& random, glm::vec3 z, double c)
{
    const glm::dvec3 side = glm::normalize(glm::cross(glm::dvec3(z), random.direction()));
    return glm::vec3(glm::normalize(glm::dvec3(z) * c + side * std::sqrt(1 - c * c)));
}

Vectors randomLit(Random& random)
{
    auto unit = [&] { return static_cast<float>(random.range(0, 1)); };
    Vectors v;
    v.n = glm::vec3(random.direction());
    v.dpdx = leaned(random, v.n, random.range(0.02, 1));
    v.dpdy = leaned(random, v.n, random.range(0.02, 1));
    v.duvdx = {unit(), unit()};
    v.duvdy = {static_cast<float>(random.range(-1.5, 1.5)), unit()};
    v.texel = {unit(), unit(), unit()};
    return v;
}

} // namespace

std::vector<Sample> litSamples()
{
    Random random(402);
    std::vector<Sample> all;
    for (int k = 0; k < 512; ++k)
        all.push_back({randomLit(random), Kind::light});
    const glm::vec3 up(0, 1, 0);
    using Change = void (*)(Random&, Vectors&, glm::vec3);
    const Change changes[] = {
        [](Random& r, Vectors& v, glm::vec3) { v.dpdx = leaned(r, v.n, -0.3); }, // lit from behind
        [](Random& r, Vectors& v, glm::vec3) { v.dpdy = leaned(r, v.n, -0.3); }, // seen from behind
        [](Random& r, Vectors& v, glm::vec3) { v.dpdx = leaned(r, v.n, 1e-4); }, // grazing light
        [](Random& r, Vectors& v, glm::vec3) { v.dpdy = leaned(r, v.n, 1e-5); }, // grazing view
        [](Random& r, Vectors& v, glm::vec3) { v.dpdx = leaned(r, v.dpdy = leaned(r, v.n, 0.01), 0.99); },
        [](Random&, Vectors& v, glm::vec3) { v.dpdx = -v.dpdy; },      // no half vector
        [](Random&, Vectors& v, glm::vec3) { v.dpdx = v.n = v.dpdy; }, // head on
        [](Random&, Vectors& v, glm::vec3) { v.duvdx.y = 0; },         // a mirror
        [](Random&, Vectors& v, glm::vec3) {
            v.dpdx = v.n * (2 * glm::dot(v.n, v.dpdy)) - v.dpdy;
            v.duvdx.y = 0;
        }, // light in the mirror direction
        [](Random&, Vectors& v, glm::vec3) {
            v.dpdx = v.n * (2 * glm::dot(v.n, v.dpdy)) - v.dpdy;
            v.duvdx.y = 0.2f;
        },
        [](Random&, Vectors& v, glm::vec3) {
            v.duvdx = {0, 1};
        }, // completely rough
        [](Random&, Vectors& v, glm::vec3) {
            v.duvdx = {1, 0.5f};
            v.texel = {0, 0, 0};
        }, // black metal
        [](Random&, Vectors& v, glm::vec3) {
            v.texel = {1, 1, 1};
            v.duvdy = {1, 1};
        }, // distance = range
        [](Random&, Vectors& v, glm::vec3) {
            v.texel = {0.0031308f, 0.04045f, 1e-9f};
            v.duvdy = {0, 0};
        },
        [](Random&, Vectors& v, glm::vec3 y) { v.n = v.dpdx = y; },  // straight up
        [](Random&, Vectors& v, glm::vec3 y) { v.n = v.dpdx = -y; }, // straight down
    };
    for (Change change : changes)
        for (int k = 0; k < 4; ++k) {
            Vectors v = randomLit(random);
            change(random, v, up);
            all.push_back({v, Kind::light});
        }
    return all;
}

namespace {

// The polynomial of AgX adds terms of up to 40 to a value below 1, which amplifies rounding errors inside it as much.
constexpr double kAgxTerm = 40.14;

void steeper(Case& c, double times)
{
    c.allowance = [allowed = c.allowance, times](const Vectors& v) { return allowed(v) * times; };
}

void addPictureCases(std::vector<Case>& all)
{
    // A tile is an integer by definition; fractional arguments are compared as well.
    all.push_back(COTAN_LIT_CASE("tile", cotan_environment_tile(y * cotan_real(10.0))));
    all.push_back(COTAN_LIT_CASE(
        "octahedral place", cotan_vec3(cotan_octahedral_point(l).x, cotan_octahedral_point(l).y, cotan_real(1.0))));
    all.push_back(COTAN_LIT_CASE("octahedral direction", cotan_octahedral_direction(cotan_vec2(s.metallic, y))));
    all.push_back(COTAN_LIT_CASE("environment texel",
                                 cotan_vec3(cotan_environment_texel(l, cotan_real(0.0)).x,
                                            cotan_environment_texel(s.v, cotan_real(6.0)).y, cotan_real(1.0))));
    all.push_back(COTAN_LIT_CASE("albedo texel",
                                 cotan_vec3(cotan_environment_albedo_texel(x, s.roughness).x,
                                            cotan_environment_albedo_texel(x, s.roughness).y, cotan_real(1.0))));
    all.push_back(
        COTAN_LIT_CASE("bounces, once", cotan_bounces_of(s.base_color, y, cotan_split_sum(y, s.roughness)).once));
    all.push_back( // base_color is added because `more` vanishes where the split sum is 1
        COTAN_LIT_CASE("bounces, more",
                       cotan_bounces_of(s.base_color, y, cotan_split_sum(y, s.roughness)).more + s.base_color));
    all.push_back(COTAN_LIT_CASE(
        "reflect image",
        cotan_reflect_image(s, g, s.emissive, s.base_color * cotan_real(2.0), cotan_split_sum(y, s.roughness))));
    all.push_back(COTAN_LIT_CASE("reflect coat image",
                                 cotan_reflect_coat_image(c, s.base_color, cotan_split_sum(y, s.roughness))));
    all.push_back(COTAN_LIT_CASE("tone neutral", cotan_tone_neutral(s.base_color * (y * cotan_real(8.0)))));
    all.push_back(COTAN_LIT_CASE(
        "AgX, contrast, encoded",
        cotan_vec3(cotan_agx_contrast(y), cotan_agx_encoded(s.roughness * cotan_real(8.0)), cotan_real(1.0))));
    steeper(all.back(), kAgxTerm);
    all.push_back(COTAN_LIT_CASE("tone AgX", cotan_tone_agx(s.base_color * (y * cotan_real(8.0)))));
    steeper(all.back(), kAgxTerm);
    all.push_back(COTAN_LIT_CASE("tone of",
                                 cotan_vec3(cotan_tone_of(1, s.base_color * x * x).x, cotan_tone_of(2, s.base_color).y,
                                            cotan_tone_of(3, s.base_color).z)
                                     + cotan_tone_of(0, s.base_color * x)));
    steeper(all.back(), kAgxTerm);
    all.push_back(COTAN_LIT_CASE("saturate color", cotan_saturate_color(s.base_color * x)));
    all.push_back(COTAN_LIT_CASE(
        "tap",
        cotan_vec3(cotan_next_tap(cotan_vec2(x, y)).x, cotan_next_tap(cotan_vec2(x, y)).y, cotan_tap_radius(3, 24))));
    all.push_back(COTAN_LIT_CASE("penumbra",
                                 cotan_vec3(cotan_penumbra(abs(x), y, cotan_real(0.01), s.roughness),
                                            cotan_penumbra(abs(x), y, s.metallic, cotan_real(1.0)), cotan_real(1.0))));
}

} // namespace

std::vector<Case> litCases()
{
    std::vector<Case> all;
    addPictureCases(all);
    all.push_back(COTAN_LIT_CASE("saturate, smooth",
                                 cotan_vec3(cotan_saturate(x), cotan_smooth(-y, y + cotan_real(0.1), x),
                                            cotan_smooth(y + cotan_real(0.1), -y, x))));
    all.push_back(COTAN_LIT_CASE("half vector", cotan_half_vector(l, s.v)));
    all.push_back(COTAN_LIT_CASE("reflect pbr", cotan_reflect_pbr(s, l)));
    all.push_back(COTAN_LIT_CASE("reflect Blinn-Phong", cotan_reflect_blinn_phong(s, l)));
    all.push_back(COTAN_LIT_CASE("environment", cotan_environment(l, s.roughness)));
    all.push_back(COTAN_LIT_CASE("reflect environment", cotan_reflect_environment(s)));
    all.push_back(COTAN_LIT_CASE(
        "ggx, grazing, split sum",
        cotan_vec3(cotan_ggx(s.n, s.v, l, s.roughness), cotan_grazing(y), cotan_split_sum(y, s.roughness).y)));
    all.push_back(
        COTAN_LIT_CASE("ggx stretched", cotan_vec3(cotan_ggx_anisotropic(s.n, s.v, l, s.roughness, y, g.t), y, y)));
    all.push_back(COTAN_LIT_CASE("gloss", cotan_gloss_of(abs(x), y, s.base_color).f0));
    all.push_back(COTAN_LIT_CASE(
        "direction",
        cotan_direction_on_surface(s.n, cotan_vec3(cotan_real(1.0), x, -y), s.base_color, cotan_vec2(x, y), s.n)));
    all.push_back(COTAN_LIT_CASE("reflect highlight", cotan_reflect_highlight(s, g, l, cotan_real(2.0))));
    all.push_back(COTAN_LIT_CASE("reflect glossy", cotan_reflect_glossy(s, g, l)));
    all.push_back(
        COTAN_LIT_CASE("bent normal, mirrored", cotan_mirrored(cotan_bent_normal(s.n, s.v, s.roughness, y, g.t), s.v)));
    all.push_back(COTAN_LIT_CASE("plain gloss", cotan_plain_gloss().f0));
    all.push_back(COTAN_LIT_CASE("reflecting normal", cotan_reflecting_normal(s, g)));
    all.push_back(COTAN_LIT_CASE("transmittance", cotan_transmittance(s, g)));
    all.push_back(COTAN_LIT_CASE("charlie's masking",
                                 cotan_vec3(cotan_charlie_fit(y * cotan_real(0.5), s.metallic),
                                            cotan_real(1.0) / (cotan_real(1.0) + cotan_charlie_masking(y, s.metallic)),
                                            cotan_real(1.0))));
    all.push_back(COTAN_LIT_CASE("charlie, sheen's share",
                                 cotan_vec3(cotan_charlie(s.n, s.v, l, s.roughness), cotan_sheen_albedo(y, s.roughness),
                                            cotan_sheen_fraction(h, y))));
    all.push_back(COTAN_LIT_CASE("reflect sheen", cotan_reflect_sheen(h, s.n, s.v, l, s.base_color)));
    all.push_back(
        COTAN_LIT_CASE("sheen around", cotan_reflect_sheen_around(h, s.n, s.v, s.base_color, s.base_color * y)));
    all.push_back(COTAN_LIT_CASE("environment glossy", cotan_reflect_environment_glossy(s, g)));
    all.push_back(COTAN_LIT_CASE("coat", cotan_vec3(cotan_coat_fraction(c, s.v), cotan_reflect_coat(c, s.v, l), y)));
    all.push_back(COTAN_LIT_CASE("coat environment", cotan_reflect_coat_environment(c, s.v)));
    all.push_back(COTAN_LIT_CASE("falloff",
                                 cotan_vec3(cotan_light_falloff(abs(x), y), cotan_light_falloff(y, abs(x)),
                                            cotan_light_falloff(y, cotan_real(0.0)))));
    all.push_back(COTAN_LIT_CASE("roughness of a spread",
                                 cotan_vec3(cotan_roughness_of_variance(s.roughness, y),
                                            cotan_variance_of_curvature(l, s.v), cotan_variance_of_length(y))));
    all.push_back(COTAN_LIT_CASE("places of a roughness",
                                 cotan_vec3(cotan_samples_of_roughness(s.roughness), cotan_samples_of_roughness(y),
                                            cotan_samples_of_roughness(cotan_real(0.0)))
                                     * cotan_real(0.0625)));
    all.push_back(COTAN_LIT_CASE("tone map", cotan_tone_map(s.base_color * (y * cotan_real(8.0)))));
    all.push_back(COTAN_LIT_CASE("linear to sRGB",
                                 cotan_vec3(cotan_linear_to_srgb(s.base_color.x), cotan_linear_to_srgb(s.base_color.y),
                                            cotan_linear_to_srgb(s.base_color.z))));
    all.push_back(COTAN_LIT_CASE("sRGB to linear",
                                 cotan_vec3(cotan_srgb_to_linear(s.base_color.x), cotan_srgb_to_linear(s.base_color.y),
                                            cotan_srgb_to_linear(s.base_color.z))));
    return all;
}

} // namespace cotan::test
