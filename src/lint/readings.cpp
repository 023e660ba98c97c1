#include <algorithm>
#include <cmath>

#include "cotan/lint/texel.hpp"
#include "parts.hpp"

namespace cotan::lint {

namespace {

constexpr std::size_t kSamples = 4096;

struct Point {
    std::size_t triangle;
    glm::dvec3 barycentric;
};

// Points at equal steps of area, in the triangles by the sequence of the plastic number (R2).
std::vector<Point> pointsOver(const MappedSurface& s)
{
    std::vector<double> upTo;
    double total = 0;
    for (std::size_t i = 0; i < s.triangleCount(); ++i)
        upTo.push_back(total += orientationOf(s, i) != 0 ? areaOf(s, i) : 0);
    std::vector<Point> points;
    if (!(total > 0))
        return points;
    std::size_t triangle = 0;
    for (std::size_t k = 0; k < kSamples; ++k) {
        const double at = (double(k) + 0.5) / double(kSamples) * total;
        while (triangle + 1 < upTo.size() && upTo[triangle] <= at)
            ++triangle;
        double a = std::fmod(0.5 + 0.7548776662466927 * double(k), 1.0);
        double b = std::fmod(0.5 + 0.5698402909980532 * double(k), 1.0);
        if (a + b > 1) {
            a = 1 - a;
            b = 1 - b;
        }
        points.push_back({triangle, glm::dvec3(1 - a - b, a, b)});
    }
    return points;
}

} // namespace

std::vector<Reading> readings(const MappedSurface& s, const Material& material, const Image& map)
{
    struct Reader {
        std::string name;
        Frame frame;
        TangentOrigin tangents;
        std::vector<std::pair<double, double>> errors;
    };
    std::vector<Reader> readers;
    for (Frame f : {Frame::cotangent, Frame::orthonormal, Frame::smooth, Frame::exact})
        readers.push_back({std::string(name(f)), f, TangentOrigin::generated, {}});
    if (!s.stored.empty())
        readers.push_back({"stored", Frame::mikktspace, TangentOrigin::stored, {}});

    const f64::cotan_normal_format format = formatOf(material, map.type);
    for (const Point& p : pointsOver(s)) {
        const glm::dvec3 m =
            decodedAt(map, material.normalMap, format, atPoint(s.uv, p.triangle, p.barycentric));
        const glm::dvec3 truth = f64::cotan_apply(
            frameAt(s, Frame::mikktspace, TangentOrigin::generated, p.triangle, p.barycentric), m);
        for (Reader& r : readers)
            r.errors.emplace_back(
                degreesBetween(f64::cotan_apply(frameAt(s, r.frame, r.tangents, p.triangle, p.barycentric), m), truth),
                1.0);
    }
    std::vector<Reading> result;
    for (Reader& r : readers)
        result.push_back({r.name, spreadOf(std::move(r.errors))});
    return result;
}

} // namespace cotan::lint
