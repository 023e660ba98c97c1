// The built-in environments.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/named_values.hpp"
#include "cotan/view.hpp"

namespace cotan {

namespace {

// 0 below `low`, 1 above `high`, smooth between.
float smooth(float low, float high, float x) { return f32::cotan_smooth(low, high, x); }

// A rectangular light at distance 1 along `axis`, upright; half sizes and soft rim in the same unit. Emits 0 to 1.
struct SoftBox {
    glm::vec3 axis, right, up; // unit
    float halfWidth, halfHeight, rim;

    SoftBox(glm::vec3 towards, float width, float height, float soft)
        : axis(glm::normalize(towards)), halfWidth(width), halfHeight(height), rim(soft)
    {
        const glm::vec3 upright = std::abs(axis.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
        right = glm::normalize(glm::cross(axis, upright));
        up = glm::cross(right, axis);
    }

    float seen(glm::vec3 d) const
    {
        const float along = glm::dot(d, axis);
        if (along <= 0.01f)
            return 0;
        const float x = std::abs(glm::dot(d, right)) / along, y = std::abs(glm::dot(d, up)) / along;
        return (1 - smooth(halfWidth - rim, halfWidth + rim, x)) * (1 - smooth(halfHeight - rim, halfHeight + rim, y));
    }
};

// Grey walls that darken upwards, a floor with a pool of light around the model, a large box on the front left, a lower
// one on the right, a ceiling light, two strips at the sides, slightly behind, for rim light, and a narrow card in
// front on the floor: seen from slightly above, upright metals reflect its edges, which shows their relief. Models face
// +z.
glm::vec3 studio(glm::vec3 d)
{
    static const SoftBox key{glm::vec3(-0.75f, 0.62f, 0.75f), 0.55f, 0.5f, 0.05f};
    static const SoftBox fill{glm::vec3(0.95f, 0.15f, 0.45f), 0.35f, 0.75f, 0.06f};
    static const SoftBox ceiling{glm::vec3(0, 1, 0), 0.75f, 0.35f, 0.06f};
    static const SoftBox left{glm::vec3(-1, 0.25f, -0.2f), 0.16f, 0.8f, 0.03f};
    static const SoftBox right{glm::vec3(1, 0.3f, -0.35f), 0.16f, 0.8f, 0.03f};
    static const SoftBox card{glm::vec3(0, -0.27f, 1), 0.8f, 0.09f, 0.025f};
    const glm::vec3 wall = glm::vec3(0.30f, 0.30f, 0.31f) * (1 - 0.55f * smooth(0, 0.9f, d.y));
    const glm::vec3 paper(1, 0.985f, 0.96f);
    const glm::vec3 floor = paper * glm::mix(0.04f, 0.7f, smooth(0.3f, 0.7f, -d.y));
    glm::vec3 c = glm::mix(floor, wall, smooth(-0.12f, 0.12f, d.y));
    c += glm::vec3(5.0f, 4.9f, 4.7f) * key.seen(d);
    c += glm::vec3(1.9f, 2.0f, 2.1f) * fill.seen(d);
    c += glm::vec3(3.0f) * ceiling.seen(d);
    c += paper * (2.4f * card.seen(d));
    c += glm::vec3(4.2f, 4.4f, 4.6f) * (left.seen(d) + right.seen(d));
    return c;
}

// The CIE standard overcast sky: three times as bright at the zenith as at the horizon. The ground reflects about half
// of the light that falls on it.
glm::vec3 overcast(glm::vec3 d)
{
    const glm::vec3 zenith(1.9f, 2.0f, 2.1f);
    const glm::vec3 sky = zenith * ((1 + 2 * std::max(d.y, 0.0f)) / 3);
    const glm::vec3 ground = zenith * glm::vec3(0.25f, 0.23f, 0.20f);
    return glm::mix(ground, sky, smooth(-0.04f, 0.04f, d.y));
}

// The glow of a low sun on the front right, along the horizon and around the sun, with a dark blue sky. The sun itself
// is a separate light, which casts shadows.
glm::vec3 evening(glm::vec3 d)
{
    static const glm::vec3 sun = glm::normalize(glm::vec3(0.8f, 0.28f, 0.6f));
    const float height = std::max(d.y, 0.0f);
    const float toSun = std::max(glm::dot(d, sun), 0.0f);
    const glm::vec3 sky =
        glm::mix(glm::vec3(0.70f, 0.42f, 0.30f), glm::vec3(0.07f, 0.12f, 0.30f), 1 - std::exp(-3.2f * height));
    const glm::vec3 glow = glm::vec3(1.8f, 0.75f, 0.22f) * (std::pow(toSun, 8.0f) * std::exp(-2.5f * height));
    const glm::vec3 halo = glm::vec3(6, 3.2f, 1.2f) * std::pow(toSun, 120.0f);
    const glm::vec3 ground = glm::vec3(0.14f, 0.11f, 0.10f) * (1 + 0.6f * std::max(glm::dot(d, sun), 0.0f));
    return 1.6f * glm::mix(ground, sky + glow + halo, smooth(-0.03f, 0.03f, d.y));
}

constexpr Named<glm::vec3 (*)(glm::vec3)> kBuiltin[] = {
    {"studio", studio}, {"overcast", overcast}, {"evening", evening}};

} // namespace

const std::vector<std::string>& environmentNames()
{
    static const std::vector<std::string> names = wordsOf(kBuiltin);
    return names;
}

std::optional<Radiance> builtinRadiance(const std::string& name) { return valueOf(kBuiltin, name); }

} // namespace cotan
