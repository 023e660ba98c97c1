#include "cotan/lint/map_fit.hpp"
#include "cotan/lint/texel.hpp"
#include "parts.hpp"

namespace cotan::lint {

namespace {

constexpr std::size_t kSamples = 4096;

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
    for (Frame f : {Frame::cotangent, Frame::orthonormal, Frame::smooth, Frame::exact, Frame::triangle})
        readers.push_back({std::string(name(f)), f, TangentOrigin::generated, {}});
    if (!s.stored.empty())
        readers.push_back({"stored", Frame::mikktspace, TangentOrigin::stored, {}});

    const f64::cotan_normal_format format = formatOf(material, map.type);
    for (const SurfacePoint& p : pointsOver(s, kSamples)) {
        const glm::dvec3 m = decodedAt(map, material.normalMap, format, atPoint(s.uv, p.triangle, p.barycentric));
        const glm::dvec3 truth =
            f64::cotan_apply(frameAt(s, Frame::mikktspace, TangentOrigin::generated, p.triangle, p.barycentric), m);
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
