// Non-affine uv computed in the shader: a plane, seen at 45 degrees, whose uv are warped by sines of wavelength one and
// amplitude 0.1.
#include "rows.hpp"
#include "tables.hpp"

#include <fmt/format.h>

namespace cotan {

namespace {

constexpr double kWave = 2 * std::numbers::pi, kAmplitude = 0.1;

glm::dvec2 warpedUv(glm::dvec3 p)
{
    return {p.x + kAmplitude * std::sin(kWave * p.y), p.y + kAmplitude * std::sin(kWave * p.x + 1)};
}

AffinePatch tangentPatch(glm::dvec3 p) // its gradients are those of the warped uv at p
{
    AffinePatch patch;
    patch.gradU = {1, kAmplitude * kWave * std::cos(kWave * p.y), 0};
    patch.gradV = {kAmplitude * kWave * std::cos(kWave * p.x + 1), 1, 0};
    return patch;
}

struct Pixel {
    const PixelCamera& camera;
    glm::dvec2 quad; // position of the quad's first pixel
    int lane[2];

    glm::dvec3 at(int x, int y) const { return camera.meet(quad + glm::dvec2(x, y), {0, 0, 0}, {0, 0, 1}); }
    Differences<double> differences(glm::ivec2 x0, glm::ivec2 x1, glm::ivec2 y0, glm::ivec2 y1) const
    {
        const glm::dvec3 a = at(x0.x, x0.y), b = at(x1.x, x1.y), c = at(y0.x, y0.y), d = at(y1.x, y1.y);
        return {Vector3d(b - a), Vector3d(d - c), warpedUv(b) - warpedUv(a), warpedUv(d) - warpedUv(c)};
    }
    Differences<double> fine() const { return differences({0, lane[1]}, {1, lane[1]}, {lane[0], 0}, {lane[0], 1}); }
    Differences<double> coarse() const { return differences({0, 0}, {1, 0}, {0, 0}, {0, 1}); }
    Differences<double> centred() const
    {
        return differences({lane[0] - 1, lane[1]}, {lane[0] + 1, lane[1]}, {lane[0], lane[1] - 1},
                           {lane[0], lane[1] + 1});
    }
    // Differenced positions; uv differences by the analytic Jacobian along the same displacement.
    Differences<double> analytic() const
    {
        Differences<double> d = fine();
        const AffinePatch patch = tangentPatch(at(lane[0], lane[1]));
        d.duvdx = patch.uvAt(d.dpdx.raw());
        d.duvdy = patch.uvAt(d.dpdy.raw());
        return d;
    }
};

} // namespace

std::vector<Measurement> measureProcedural(const AccuracySelection& selection)
{
    const std::pair<const char*, Differences<double> (Pixel::*)() const> scenes[] = {
        {"fine derivatives", &Pixel::fine},
        {"coarse derivatives", &Pixel::coarse},
        {"centred differences", &Pixel::centred},
        {"analytic Jacobian", &Pixel::analytic},
    };
    std::vector<Measurement> result;
    for (const auto& [scene, differences] : scenes) {
        if (!selection.wantsScene(scene))
            continue;
        for (int pixels : {256, 64, 16, 8, 4}) {
            FrameRows rows;
            for (Frame frame : {Frame::cotangent, Frame::gradient})
                rows.add(selection, frame,
                         {"procedural", scene, fmt::format("{} pixels a wave", pixels), "",
                          frame == Frame::gradient ? "E" : "S", ""});
            const PixelCamera camera = PixelCamera::lookAt({12, -16, 20}, {0, 0, 0}, {0.5, 0, 1}, pixels, true);
            Random random(7);
            for (int i = 0; i < 6000; ++i) {
                const glm::dvec2 quad{std::floor(random.range(-500, 500)), std::floor(random.range(-500, 500))};
                const Pixel pixel{camera, quad, {random.unit() < 0.5, random.unit() < 0.5}};
                const AffinePatch patch = tangentPatch(pixel.at(pixel.lane[0], pixel.lane[1]));
                const glm::dvec3 m = tiltedTexel(random, 35);
                const Differences<double> d = (pixel.*differences)();
                for (FrameRows::Row& row : rows.rows) {
                    const glm::dvec3 truth = row.frame == Frame::gradient ? truthE(patch, m) : truthS(patch, m);
                    row.angles.add(degreesBetween(shadeAs(row.single, row.frame, patch.normal, d, m), truth));
                }
            }
            rows.finish(result);
        }
    }
    return result;
}

} // namespace cotan
