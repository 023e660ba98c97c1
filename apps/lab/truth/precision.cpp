#include "truth/precision.hpp"

#include <cmath>

namespace cotan {

namespace {

template<class V> V at(glm::dvec2 b, const V (&corner)[3])
{
    return corner[0] + (corner[1] - corner[0]) * b.x + (corner[2] - corner[0]) * b.y;
}

float interpolate(float a, float b, float c, glm::dvec2 w)
{
    return std::fma(float(w.y), c - a, std::fma(float(w.x), b - a, a));
}
glm::vec3 interpolate(const glm::vec3 (&p)[3], glm::dvec2 w)
{
    return {interpolate(p[0].x, p[1].x, p[2].x, w), interpolate(p[0].y, p[1].y, p[2].y, w),
            interpolate(p[0].z, p[1].z, p[2].z, w)};
}
glm::vec2 interpolate(const glm::vec2 (&p)[3], glm::dvec2 w)
{
    return {interpolate(p[0].x, p[1].x, p[2].x, w), interpolate(p[0].y, p[1].y, p[2].y, w)};
}

glm::dvec2 barycentric(const glm::dvec3 (&p)[3], glm::dvec3 x)
{
    const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], r = x - p[0];
    const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
    const double ra = glm::dot(r, a), rb = glm::dot(r, b), determinant = aa * bb - ab * ab;
    return {(ra * bb - rb * ab) / determinant, (rb * aa - ra * ab) / determinant};
}

} // namespace

PrecisionTrial makeTrial(Random& random, const PrecisionSetting& setting)
{
    PrecisionTrial t;
    const glm::dvec3 origin = random.direction() * setting.offset;
    AffinePatch q; // stretched by up to two, slightly skewed
    q.normal = random.direction();
    const glm::dvec3 e = glm::normalize(glm::cross(q.normal, random.direction()));
    const glm::dvec3 h = glm::cross(q.normal, e);
    const double rotation = random.azimuth();
    q.gradU = e * std::cos(rotation) + h * std::sin(rotation);
    q.gradV =
        (h * std::cos(rotation) - e * std::sin(rotation)) / random.range(1, 2) + q.gradU * random.range(-0.3, 0.3);
    const glm::dvec2 base = glm::dvec2{random.unit(), random.unit()} * setting.texcoords;
    for (int k = 0; k < 3; ++k) {
        const double z = 2 * std::numbers::pi * k / 3 + random.range(-0.3, 0.3);
        const glm::dvec3 local = (e * std::cos(z) + h * std::sin(z)) * setting.side;
        t.positions[k] = glm::dvec3(glm::vec3(origin + local));
        t.texcoords[k] = glm::dvec2(glm::vec2(base + q.uvAt(local)));
    }
    t.normal = glm::normalize(glm::cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]));
    glm::dvec3 view;
    do
        view = random.direction();
    while (glm::dot(view, t.normal) < 0.35);
    const glm::dvec3 centre = at(glm::dvec2(random.range(0.2, 0.4), random.range(0.2, 0.4)), t.positions);
    const PixelCamera camera =
        PixelCamera::lookAt(centre + view * (setting.footprint * 1000), centre, random.direction(), 1000);
    t.eye = glm::dvec3(glm::vec3(camera.eye));
    const glm::dvec2 pixels[3] = {{0, 0}, {1, 0}, {0, 1}};
    for (int k = 0; k < 3; ++k)
        t.barycentrics[k] = barycentric(t.positions, camera.meet(pixels[k], centre, t.normal));
    auto difference = [&](const auto& corner, int k) {
        return at(t.barycentrics[k], corner) - at(t.barycentrics[0], corner);
    };
    t.exact = {Vector3d(difference(t.positions, 1)), Vector3d(difference(t.positions, 2)), difference(t.texcoords, 1),
               difference(t.texcoords, 2)};
    t.texel = tiltedTexel(random, 35);
    return t;
}

Differences<float> measuredDifferences(const PrecisionTrial& t, PositionSource source)
{
    const glm::vec3 eye(t.eye);
    glm::vec3 corners[3], p[3];
    glm::vec2 texcoords[3], uv[3];
    for (int k = 0; k < 3; ++k) {
        texcoords[k] = glm::vec2(t.texcoords[k]);
        corners[k] = glm::vec3(t.positions[k]);
        if (source == PositionSource::eyeOffsetPerVertex)
            corners[k] -= eye;
        if (source == PositionSource::cameraRelative)
            corners[k] = glm::vec3(t.positions[k] - t.eye);
    }
    for (int k = 0; k < 3; ++k) {
        p[k] = interpolate(corners, t.barycentrics[k]);
        if (source == PositionSource::eyeOffsetPerPixel)
            p[k] -= eye;
        uv[k] = interpolate(texcoords, t.barycentrics[k]);
    }
    return {Vector3f(p[1] - p[0]), Vector3f(p[2] - p[0]), uv[1] - uv[0], uv[2] - uv[0]};
}

Differences<float> floatEdges(const PrecisionTrial& t)
{
    auto edge = [&](int k) { return Vector3f(glm::vec3(t.positions[k]) - glm::vec3(t.positions[0])); };
    auto uvEdge = [&](int k) { return glm::vec2(t.texcoords[k]) - glm::vec2(t.texcoords[0]); };
    return {edge(1), edge(2), uvEdge(1), uvEdge(2)};
}

Differences<double> exactEdges(const PrecisionTrial& t)
{
    return {Vector3d(t.positions[1] - t.positions[0]), Vector3d(t.positions[2] - t.positions[0]),
            t.texcoords[1] - t.texcoords[0], t.texcoords[2] - t.texcoords[0]};
}

} // namespace cotan
