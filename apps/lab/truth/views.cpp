// Whether a frame depends on the source of its differences: compares each source with the edges of a triangle on the
// same patch.
#include "rows.hpp"
#include "tables.hpp"

namespace cotan {

namespace {

struct Sources {
    Differences<double> edges, screen, wide, coarse, raster, normalizedView, secondView;
};

PixelCamera randomView(Random& random, const AffinePatch& patch)
{
    glm::dvec3 eye;
    do
        eye = random.direction();
    while (glm::dot(eye, patch.normal) < 0.2);
    return PixelCamera::lookAt(eye * 4.0, {0, 0, 0}, random.direction(), 1800);
}

// Differences for a map rasterised in uv: one texel along +u and one along -v.
Differences<double> rasterDifferences(const AffinePatch& patch)
{
    const glm::dvec3 area = glm::cross(patch.gradU, patch.gradV);
    const double texel = 1.0 / 1024, scale = texel / glm::dot(area, area);
    return {Vector3d(glm::cross(patch.gradV, area) * scale),
            Vector3d(glm::cross(area, patch.gradU) * -scale),
            {texel, 0},
            {0, -texel}};
}

Sources makeSources(Random& random, const AffinePatch& patch)
{
    Sources s;
    const glm::dvec3 e = glm::normalize(glm::cross(patch.normal, random.direction()));
    const glm::dvec3 second = glm::cross(patch.normal, e) * 1.5 + e * 0.3;
    s.edges = {Vector3d(e), Vector3d(second), patch.uvAt(e), patch.uvAt(second)};
    const PixelCamera camera = randomView(random, patch);
    const glm::dvec3 p = e * 0.2;
    s.screen = screenDifferences(camera, patch, p);
    s.wide = screenDifferences(camera, patch, p, 64);
    s.normalizedView = screenDifferences(camera, patch, p, 1, true);
    // Hardware that computes one pair per quad gives a pixel the differences of the diagonally opposite pixel.
    const glm::dvec2 pixel = camera.project(p);
    const glm::dvec3 across = camera.meet(pixel - glm::dvec2(1, 1), patch.origin, patch.normal);
    s.coarse = screenDifferences(camera, patch, across);
    s.secondView = screenDifferences(randomView(random, patch), patch, p);
    s.raster = rasterDifferences(patch);
    return s;
}

} // namespace

std::vector<Measurement> measureViews(const AccuracySelection& selection)
{
    struct SourcePair {
        const char* name;
        Differences<double> Sources::*first;
        Differences<double> Sources::*second;
    };
    const SourcePair scenes[] = {
        {"screen quad", &Sources::edges, &Sources::screen},
        {"screen quad of 64 pixels", &Sources::edges, &Sources::wide},
        {"coarse against fine derivatives", &Sources::screen, &Sources::coarse},
        {"raster in uv", &Sources::edges, &Sources::raster},
        {"two views", &Sources::screen, &Sources::secondView},
        {"normalised view vector", &Sources::edges, &Sources::normalizedView},
    };
    std::vector<Measurement> result;
    for (const SourcePair& scene : scenes) {
        if (!selection.wantsScene(scene.name))
            continue;
        FrameRows rows;
        for (Frame frame : differenceFrames())
            rows.add(selection, frame, {"views", scene.name, "texel tilt 45", "", "itself", ""});
        Random random(41);
        for (int i = 0; i < 10000; ++i) {
            const AffinePatch patch = randomPatch(random, i & 1);
            const glm::dvec3 n = glm::normalize(patch.normal + random.direction() * 0.3);
            const glm::dvec3 m = tiltedTexel(random, 45);
            const Sources sources = makeSources(random, patch);
            for (FrameRows::Row& row : rows.rows)
                row.angles.add(degreesBetween(shadeAs(row.single, row.frame, n, sources.*scene.first, m),
                                              shadeAs(row.single, row.frame, n, sources.*scene.second, m)));
        }
        rows.finish(result);
    }
    return result;
}

} // namespace cotan
