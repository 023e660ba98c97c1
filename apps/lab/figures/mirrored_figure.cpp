// Mirrored texture coordinates, and the sign that stored tangents need for them.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

namespace {

constexpr float kMirrorRepeatU = 4, kMirrorRepeatV = 2;
constexpr int kMirrorSegments = 96; // even: a column of vertices lies on the mirror line

Scene sphereScene(bool mirrored, const Image& map)
{
    Mesh mesh = makeSphere(1, kMirrorSegments);
    if (mirrored)
        for (glm::vec2& uv : mesh.texcoords[0])
            uv.x = std::min(uv.x, 1 - uv.x);
    scaleTexcoords(mesh, kMirrorRepeatU, kMirrorRepeatV);
    return sceneOf(std::move(mesh), map, dielectric({0.30f, 0.13f, 0.02f}, 0.4f));
}

// The relief in the sphere's unmirrored texcoords: the right half mirrors the left half.
HeightSample mirroredDomes(double u, double v)
{
    if (u <= kMirrorRepeatU / 2)
        return relief(Relief::domes, u, v);
    HeightSample h = relief(Relief::domes, kMirrorRepeatU - u, v);
    h.hu = -h.hu;
    return h;
}

} // namespace

Figure makeMirroredFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Mirrored texture coordinates";
    figure.text = {
        "The right half of the sphere shows the left half's image mirrored, as artists do to save texture space. The "
        "frame made in the pixel sees it in the derivatives; nothing is stored and no vertex is split. Tangents stored "
        "at the vertices also need a sign: without it, the mirrored half is lit from below."};
    figure.measured = "Angles to the analytic normals, within 75 degrees of the equator.";
    Camera camera = frontal(2.1f);
    const View view = squareView(studio, camera);
    const Image map = heightMap16([](double u, double v) { return relief(Relief::domes, u, v); }, 512);

    const Scene plain = sphereScene(false, map);
    studio.show(plain);
    const Image uv = studio.vectors(view, Frame::exact, Output::uv);
    const Image truth = truthNormals(uv, mirroredDomes, sphereChart({kMirrorRepeatU, kMirrorRepeatV}));

    const Scene mirrored = sphereScene(true, map);
    Scene signless = withVertexFrames(mirrored, Frame::vertex);
    const Scene signedTangents = signless;
    // The left half is not mirrored; its sign is what a program without signs would assume everywhere.
    const float sign = signless.meshes[0].tangents[0].w;
    for (glm::vec4& tangent : signless.meshes[0].tangents)
        tangent.w = sign;
    const struct {
        const Scene& scene;
        Frame frame;
        const char *file, *label;
    } rows[] = {{signless, Frame::vertex, "a-no-sign", "stored tangents without their sign"},
                {mirrored, Frame::cotangent, "b-cotangent", "cotangent, nothing stored"},
                {signedTangents, Frame::vertex, "c-sign", "stored tangents with their sign"}};
    std::vector<Panel> heats;
    for (const auto& row : rows) {
        studio.show(row.scene);
        figure.panels.push_back(
            {row.file, row.label, fmt::format("Frame {}.", name(row.frame)), studio.shaded(view, row.frame)});
        Compared c = compareNormals(studio.normals(view, row.frame), truth);
        figure.measures.push_back({row.label, c.degrees});
        heats.push_back({std::string(row.file) + "-error", std::string(row.label) + ": error",
                         "Black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees.", std::move(c.heat)});
    }
    for (std::size_t i = 0; i < std::size(rows); ++i)
        addError(figure, i, rows[i].label);
    figure.panels.insert(figure.panels.end(), heats.begin(), heats.end());
    figure.sliders = {{0, 1}};
    return figure;
}

} // namespace cotan::figures
