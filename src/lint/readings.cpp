#include "cotan/lint/map_fit.hpp"
#include "cotan/lint/texel.hpp"
#include "parts.hpp"

namespace cotan::lint {

std::vector<Reading> readings(const MappedSurface& s, const std::vector<SurfacePoint>& points, Frame madeFor,
                              const Material& material, const Image& map)
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
    if (s.hasStored() && madeFor == Frame::mikktspace)
        readers.push_back({"stored", Frame::mikktspace, TangentOrigin::stored, {}});

    const f64::cotan_normal_format format = formatOf(material, map.type);
    for (const SurfacePoint& p : points) {
        const glm::dvec3 m = decodedAt(map, material.normalMap, format, uvAt(s, p.triangle, p.barycentric));
        const glm::dvec3 truth =
            f64::cotan_apply(frameAt(s, madeFor, TangentOrigin::generated, p.triangle, p.barycentric), m);
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
