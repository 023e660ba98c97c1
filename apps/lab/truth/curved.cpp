// A relief in a normal map on curved surfaces, by the number of segments of their tessellation.
#include "rows.hpp"
#include "tables.hpp"
#include "truth/tessellation.hpp"

#include <fmt/format.h>

namespace cotan {

namespace {

constexpr int kCurvedSamples = 12000;
constexpr int kSegments[] = {8, 16, 32, 64, 128, 256};

// A camera with a focal length of 1800 pixels, 4 units away, at most 84 degrees from the normal.
PixelCamera randomCamera(Random& random, glm::dvec3 target, glm::dvec3 normal)
{
    glm::dvec3 direction;
    do
        direction = random.direction();
    while (glm::dot(direction, normal) <= 0.1);
    return PixelCamera::lookAt(target + direction * 4.0, target + random.direction() * 0.5, {0.1, 0.2, 1}, 1800);
}

// Rows of each frame against the truth that it claims and against the other, and control rows: what remains without a
// map, and what exact normals or gradients would give.
struct CurvedRows {
    FrameRows frames;
    AngleCollector none, normal, gradients, blinn, fusedSmooth;
    Measurement names;

    CurvedRows(const AccuracySelection& selection, Measurement names_) : names(std::move(names_))
    {
        for (const FrameInfo& f : cotan::frames()) {
            const bool metric = f.frame == Frame::gradient;
            Measurement row = names;
            row.truth = metric ? "E" : "S";
            frames.add(selection, f.frame, row);
            row.truth = metric ? "S" : "E"; // the frame measured by the other truth
            frames.addOne(selection, f.frame, false, row);
        }
    }

    void add(const Surface& surface, double unitsPerUv, const Interpolated& x, const PixelCamera& camera)
    {
        const SurfacePoint p = surface.at(x.parameters);
        const ReliefSample relief = Waves{}.at(x.uv.x, x.uv.y);
        const glm::dvec3 texel = texelOf(relief), metric = texelOf(relief, unitsPerUv);
        const glm::dvec3 s = truthS(p, texel), e = surface.displacedNormal(p, relief, unitsPerUv);
        const glm::dvec3 n = glm::normalize(x.n);
        const Differences<double> screen = screenDifferences(camera, x.plane, x.position);
        for (FrameRows::Row& row : frames.rows) {
            const bool isMetric = row.frame == Frame::gradient;
            const glm::dvec3 shaded = shade(row.frame, row.single, x, screen, isMetric ? metric : texel);
            row.angles.add(degreesBetween(shaded, row.names.truth == "E" ? e : s));
        }
        fusedSmooth.add(degreesBetween(f64::cotan_perturb_smooth(x.n, x.unitU, x.unitV, texel), s));
        normal.add(degreesBetween(n, p.normal));
        none.add(degreesBetween(n, s));
        SurfacePoint interpolated = p; // the true gradients with the interpolated normal
        interpolated.normal = n;
        gradients.add(degreesBetween(truthS(interpolated, texel), s));
        // J. Blinn's perturbed normal, 1978, which ignores the product of height and curvature.
        const glm::dvec3 slope = p.gradU * relief.hu + p.gradV * relief.hv;
        blinn.add(degreesBetween(p.normal - slope * unitsPerUv, e));
    }

    void finish(std::vector<Measurement>& into)
    {
        const struct {
            AngleCollector* angles;
            const char *name, *truth;
        } controls[] = {{&none, "(no map)", "S"},
                        {&normal, "(interpolated normal)", "smooth normal"},
                        {&gradients, "(analytic gradients)", "S"},
                        {&fusedSmooth, "(smooth, fused)", "S"},
                        {&blinn, "(Blinn, analytic)", "E"}};
        for (const auto& c : controls) {
            Measurement row = names;
            row.frame = c.name;
            row.truth = c.truth;
            row.arithmetic = "double";
            into.push_back(c.angles->finish(std::move(row)));
        }
        frames.finish(into);
    }
};

} // namespace

std::vector<Measurement> measureCurved(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    for (const Surface& surface : surfaces()) {
        if (!selection.wantsScene(surface.name))
            continue;
        const double unitsPerUv = surface.unitsPerUv();
        for (bool irregular : {false, true})
            for (int segments : kSegments) {
                const Tessellation mesh = tessellate(surface, segments, irregular);
                CurvedRows rows(
                    selection,
                    {"curved", surface.name, fmt::format("{}{}", segments, irregular ? " irregular" : ""), "", "", ""});
                Random random(std::uint64_t(1000 + segments));
                for (int i = 0; i < kCurvedSamples; ++i) {
                    const Interpolated x = interpolate(mesh, randomPoint(random, mesh));
                    rows.add(surface, unitsPerUv, x, randomCamera(random, x.position, x.plane.normal));
                }
                rows.finish(result);
            }
    }
    return result;
}

} // namespace cotan
