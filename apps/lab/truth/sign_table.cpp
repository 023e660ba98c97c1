// The directions of t and b in all 24 configurations of viewing a surface, and of green in the four storage
// conventions.
#include "rows.hpp"
#include "tables.hpp"
#include "truth/signs.hpp"

namespace cotan {

namespace {

// Square uv seen face on: every frame is exact if its signs are right.
SignTrial faceOn(Random& random, const SignCase& c)
{
    SignTrial t;
    AffinePatch& p = t.patch;
    p.normal = random.direction();
    p.gradU = glm::normalize(glm::cross(p.normal, random.direction()));
    p.gradV = glm::cross(p.normal, p.gradU) * (c.mirrored ? -1.0 : 1.0);
    const glm::dvec3 side = c.back ? -p.normal : p.normal;
    PixelCamera camera = PixelCamera::lookAt(side * 3.0, {0, 0, 0}, random.direction(), 800, true);
    camera.rowsDown = c.rowsDown;
    t.d = screenDifferences(camera, p, {0, 0, 0});
    if (c.leftHanded) { // the same view in coordinates with negated z
        for (glm::dvec3* v : {&p.normal, &p.gradU, &p.gradV})
            v->z = -v->z;
        t.d.dpdx.z = -t.d.dpdx.z;
        t.d.dpdy.z = -t.d.dpdy.z;
    }
    if (c.flippedNormal)
        p.normal = -p.normal;
    t.n = p.normal;
    return t;
}

void measureCase(const AccuracySelection& selection, const SignCase& c, std::vector<Measurement>& result)
{
    const std::string scene = c.name();
    if (!selection.wantsScene(scene))
        return;
    FrameRows rows;
    for (Frame frame : differenceFrames())
        rows.add(selection, frame, {"signs", scene, "square, face on", "", "S", ""});
    Random random(7);
    for (int i = 0; i < 500; ++i) {
        const SignTrial t = faceOn(random, c);
        const glm::dvec3 m = tiltedTexel(random, 35);
        const glm::dvec3 truth = truthS(t.patch, m);
        for (FrameRows::Row& row : rows.rows)
            row.angles.add(degreesBetween(shadeAs(row.single, row.frame, t.n, t.d, m), truth));
    }
    rows.finish(result);
}

// A dome drawn upright in an image on an upright plane. The directions of v and of green are independent; the flag to
// store is whether green points along +v.
void measureGreen(const AccuracySelection& selection, bool vDown, bool greenUp, std::vector<Measurement>& result)
{
    const std::string scene = std::string(vDown ? "v down" : "v up") + (greenUp ? ", green up" : ", green down");
    if (!selection.wantsScene(scene))
        return;
    AffinePatch patch;
    patch.gradV = {0, vDown ? -1.0 : 1.0, 0};
    const auto d = screenDifferences(PixelCamera::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 100), patch, {0, 0, 0});
    const bool alongV = greenUp != vDown;
    for (bool flagRight : {true, false}) {
        FrameRows rows;
        rows.add(selection, Frame::cotangent, {"signs", scene, flagRight ? "flag right" : "flag wrong", "", "S", ""});
        Random random(8);
        for (int i = 0; i < 500; ++i) {
            const double slopeRight = random.range(-0.4, 0.4), slopeUp = random.range(-0.4, 0.4);
            const glm::dvec3 truth = glm::normalize(glm::dvec3(-slopeRight, -slopeUp, 1));
            const double green = greenUp ? truth.y : -truth.y;
            const double sign = (alongV == flagRight) ? 1 : -1; // cotan_normal_format::green
            const glm::dvec3 m{truth.x, green * sign, truth.z};
            for (FrameRows::Row& row : rows.rows)
                row.angles.add(degreesBetween(shadeAs(row.single, row.frame, patch.normal, d, m), truth));
        }
        rows.finish(result);
    }
}

} // namespace

std::vector<Measurement> measureSigns(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    for (const SignCase& c : signCases())
        measureCase(selection, c, result);
    for (bool vDown : {true, false})
        for (bool greenUp : {true, false})
            measureGreen(selection, vDown, greenUp, result);
    return result;
}

} // namespace cotan
