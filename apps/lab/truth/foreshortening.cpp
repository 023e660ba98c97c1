// A square patch tilted away from the camera, without and with perspective: Figure 2.6.5 of the 2006 chapter in
// numbers. All frames except the shortcuts are exact here.
#include "rows.hpp"
#include "tables.hpp"

#include <fmt/format.h>

namespace cotan {

namespace {

// A patch with orthonormal gradients of u and v in the plane of e and h, rotated by `rotation` radians.
AffinePatch squarePatch(glm::dvec3 e, glm::dvec3 h, double rotation)
{
    AffinePatch p;
    p.normal = glm::cross(e, h);
    p.gradU = e * std::cos(rotation) + h * std::sin(rotation);
    p.gradV = h * std::cos(rotation) - e * std::sin(rotation);
    return p;
}

void addAll(FrameRows& rows, const AffinePatch& patch, const Differences<double>& d, glm::dvec3 m)
{
    const glm::dvec3 truth = truthS(patch, m);
    for (FrameRows::Row& row : rows.rows)
        row.angles.add(degreesBetween(shadeAs(row.single, row.frame, patch.normal, d, m), truth));
}

} // namespace

std::vector<Measurement> measureForeshortening(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    const char* scene = "square patch, orthographic";
    if (!selection.wantsScene(scene))
        return result;
    for (int tilt : {0, 10, 20, 30, 45, 60, 70, 80, 85}) {
        FrameRows rows;
        for (Frame frame : differenceFrames())
            rows.add(selection, frame, {"foreshortening", scene, fmt::format("tilt {}", tilt), "", "S", ""});
        Random random(5);
        for (int i = 0; i < 4000; ++i) {
            const AffinePatch patch = squarePatch({1, 0, 0}, {0, 1, 0}, random.azimuth());
            const PixelCamera camera = viewAt(random, tilt, true);
            addAll(rows, patch, screenDifferences(camera, patch, {0, 0, 0}), tiltedTexel(random, 35));
        }
        rows.finish(result);
    }
    return result;
}

// A ground plane with the eye one unit above it, looking at the horizon; field of view 90 degrees, 1000 pixels wide;
// depths in eye heights.
std::vector<Measurement> measurePerspective(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    const PixelCamera camera = PixelCamera::lookAt({0, 1, 0}, {0, 1, 1}, {0, 1, 0}, 500);
    for (int rotation : {0, 30, 45}) {
        const std::string scene = fmt::format("ground plane, uv turned {}", rotation);
        if (!selection.wantsScene(scene))
            continue;
        // e x h = +y
        const AffinePatch patch = squarePatch({0, 0, 1}, {1, 0, 0}, rotation * kDegree);
        for (double depth : {0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 50.0, 300.0}) {
            const Measurement names{"perspective", scene, fmt::format("depth {:g}", depth), "", "S", ""};
            FrameRows rows, normalized;
            for (Frame frame : differenceFrames())
                rows.add(selection, frame, names);
            normalized.add(selection, Frame::cotangent, names);
            for (FrameRows::Row& row : normalized.rows)
                row.names.frame = "(cotangent of a normalised view vector)";
            Random random(9);
            for (int i = 0; i < 3000; ++i) {
                const glm::dvec3 p{random.range(-1, 1) * depth, 0, depth};
                const glm::dvec3 m = tiltedTexel(random, 35);
                addAll(rows, patch, screenDifferences(camera, patch, p), m);
                addAll(normalized, patch, screenDifferences(camera, patch, p, 1, true), m);
            }
            rows.finish(result);
            normalized.finish(result);
        }
    }
    return result;
}

} // namespace cotan
