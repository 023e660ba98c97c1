// Flat patches with seven layouts of uv: Figure 2.6.4 of the 2006 chapter in numbers.
#include "rows.hpp"
#include "tables.hpp"

#include "truth/tessellation.hpp"

namespace cotan {

namespace {

// The results of the per-vertex frame generators on a patch, which are the same at every point.
Interpolated vertexFrames(const Layout& l)
{
    std::vector<glm::vec3> positions, normals(4, glm::vec3(0, 0, 1));
    std::vector<glm::vec2> texcoords;
    for (glm::dvec2 uv : {glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        positions.emplace_back(float(l.a * uv.x + l.b * uv.y), float(l.c * uv.x + l.d * uv.y), 0.0f);
        texcoords.emplace_back(uv);
    }
    // Triangles are counter-clockwise seen from +z, even if the layout mirrors.
    const std::vector<std::uint32_t> indices = l.a * l.d - l.b * l.c > 0 ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}
                                                                         : std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2};
    const MeshView mesh{positions, normals, texcoords, indices};
    const Cotangents cotangents = smoothCotangents(mesh);
    Interpolated made{};
    made.n = {0, 0, 1};
    made.cotangentU = glm::dvec3(cotangents.u.front());
    made.cotangentV = glm::dvec3(cotangents.v.front());
    for (const FrameInfo& f : frames())
        if (readsTangents(f.frame))
            made.tangents[std::size_t(f.frame)] = glm::dvec4(tangentAlongV(generateTangents(f.frame, mesh).front()));
    return made;
}

// The rows of one layout and view, to which samples are added.
struct PatchRows {
    FrameRows s, e;

    PatchRows(const AccuracySelection& selection, const char* layout, const char* view)
    {
        for (const FrameInfo& f : frames()) {
            if (f.frame != Frame::gradient) // metric by definition
                s.add(selection, f.frame, {"flat", layout, view, "", "S", ""});
            e.add(selection, f.frame, {"flat", layout, view, "", "E", ""});
        }
    }

    // Skips pixels whose true normal is tilted by less than `minTilt` degrees.
    void add(const AffinePatch& patch, const Interpolated& vertices, const Differences<double>& d, glm::dvec3 m,
             double minTilt)
    {
        const glm::dvec3 truths[] = {truthS(patch, m), truthE(patch, m)};
        for (int k = 0; k < 2; ++k) {
            if (degreesBetween(truths[k], patch.normal) < minTilt)
                continue;
            for (FrameRows::Row& row : (k == 0 ? s : e).rows) {
                const glm::dvec3 n = readsVertices(row.frame) ? shade(row.frame, row.single, vertices, d, m)
                                                              : shadeAs(row.single, row.frame, patch.normal, d, m);
                row.angles.add(degreesBetween(n, truths[k]));
            }
        }
    }
};

// Embossed domes seen by an orthographic camera in direction `from`.
void measureDomes(PatchRows& rows, const Layout& layout, glm::dvec3 from, glm::dvec3 up)
{
    const AffinePatch patch = patchOf(layout);
    const Interpolated vertices = vertexFrames(layout);
    const PixelCamera camera = PixelCamera::lookAt(glm::dvec3(1, 1, 0) + from * 5.0, {1, 1, 0}, up, 200, true);
    for (int j = 0; j < 128; ++j)
        for (int i = 0; i < 128; ++i) {
            const double u = (i + 0.5) / 128, v = (j + 0.5) / 128;
            const glm::dvec3 m = domeTexel(u, v);
            const glm::dvec3 p{layout.a * u + layout.b * v, layout.c * u + layout.d * v, 0};
            rows.add(patch, vertices, screenDifferences(camera, patch, p), m, 5);
        }
}

// Views tilted by 0 to 80 degrees, orthographic and perspective, with texels tilted by 35 degrees.
void measureAllViews(PatchRows& rows, const Layout& layout)
{
    Random random(4);
    const AffinePatch patch = patchOf(layout);
    const Interpolated vertices = vertexFrames(layout);
    for (double tilt = 0; tilt <= 80; tilt += 5)
        for (int i = 0; i < 200; ++i) {
            const PixelCamera camera = viewAt(random, tilt, i & 1);
            const glm::dvec3 p{random.range(-0.5, 0.5), random.range(-0.5, 0.5), 0};
            rows.add(patch, vertices, screenDifferences(camera, patch, p), tiltedTexel(random, 35), 0);
        }
}

} // namespace

std::vector<Measurement> measureFlat(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    const double tilt = 60 * kDegree, azimuth = 30 * kDegree;
    const glm::dvec3 tilted{std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
    for (const Layout& layout : kLayouts) {
        if (!selection.wantsScene(layout.name))
            continue;
        PatchRows frontal(selection, layout.name, "domes, frontal"),
            inclined(selection, layout.name, "domes, 60 degrees, orthographic"),
            all(selection, layout.name, "any view, 0 to 80 degrees");
        measureDomes(frontal, layout, {0, 0, 1}, {0, 1, 0});
        measureDomes(inclined, layout, tilted, {0, 0, 1});
        measureAllViews(all, layout);
        for (PatchRows* rows : {&frontal, &inclined, &all}) {
            rows->s.finish(result);
            rows->e.finish(result);
        }
    }
    return result;
}

} // namespace cotan
