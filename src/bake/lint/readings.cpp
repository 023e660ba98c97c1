#include <glm/geometric.hpp>

#include "bake/lint/map_fit.hpp"
#include "bake/lint/texel.hpp"
#include "lint_parts.hpp"
#include "scene/normal_format.hpp"

namespace cotan::lint {

namespace {

constexpr double kSameWay = 0.7071; // cosine of kTurned

// What engines show with tangents: MikkTSpace, but of unit vectors. mikktspace.h wants them as interpolated; three.js
// and others normalise them, which on coarse meshes is a third of what is predicted here. With the directions of stored
// tangents where they are within 45 degrees: on a mesh that is bent by its bones these were made before it was bent.
f64::cotan_frame meantFrame(const MappedSurface& s, const MeshPoint& p)
{
    f64::cotan_frame frame = frameAt(s, Frame::mikktspace, TangentOrigin::generated, p.triangle, p.barycentric);
    if (!s.hasStored() || !s.hasGenerated(Frame::mikktspace))
        return frame;
    glm::dvec4 t(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec4 own = s.stored(3 * p.triangle + k), made = s.generated(Frame::mikktspace, 3 * p.triangle + k);
        const bool along = glm::dot(glm::dvec3(own), glm::dvec3(made))
            > kSameWay * glm::length(glm::dvec3(own)) * glm::length(glm::dvec3(made));
        t += p.barycentric[int(k)] * (along ? glm::dvec4(glm::dvec3(own), made.w) : made);
    }
    return f64::cotan_frame_mikktspace(f64::cotan_normalize_or(frame.n, frame.n),
                                       f64::cotan_normalize_or(glm::dvec3(t), glm::dvec3(0)), t.w);
}

} // namespace

std::vector<Reading> readings(const MappedSurface& s, const std::vector<MeshPoint>& points, Frame madeFor,
                              const Material& material, const Image& map, double maxPixels)
{
    struct Reader {
        std::string name;
        Frame frame;
        TangentOrigin tangents;
        ValueStatistics errors;
    };
    std::vector<Reader> readers;
    for (Frame f : {Frame::cotangent, Frame::orthonormal, Frame::smooth, Frame::exact, Frame::triangle})
        readers.push_back({std::string(name(f)), f, TangentOrigin::generated, {}});
    if (s.hasStored() && madeFor == Frame::mikktspace)
        readers.push_back({"stored", Frame::mikktspace, TangentOrigin::stored, {}});

    const auto format =
        toFormat<f64::cotan_normal_format>(material.normalFormat, map.type, double(material.normalScale));
    const Sampler& sampler = material.normalMap.sampler;
    const std::vector<double> weights = seen(s, points, material.doubleSided, maxPixels);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const MeshPoint& p = points[k];
        const glm::dvec3 m = decodedAt(map, sampler.wrapU, sampler.wrapV, format, uvAt(s, p.triangle, p.barycentric));
        const auto readBy = [&](Frame frame, TangentOrigin tangents) {
            return f64::cotan_apply(frameAt(s, frame, tangents, p.triangle, p.barycentric), m);
        };
        const glm::dvec3 generated = readBy(madeFor, TangentOrigin::generated);
        const glm::dvec3 meant = madeFor == Frame::mikktspace ? f64::cotan_apply(meantFrame(s, p), m) : generated;
        for (Reader& r : readers)
            r.errors.add(
                degreesBetween(readBy(r.frame, r.tangents), r.tangents == TangentOrigin::stored ? generated : meant),
                weights[k]);
    }
    std::vector<Reading> result;
    for (Reader& r : readers)
        result.push_back({r.name, summaryOf(std::move(r.errors))});
    return result;
}

} // namespace cotan::lint
