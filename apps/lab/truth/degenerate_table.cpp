// Results of every frame for nineteen kinds of pixel, in float with denormals flushed to zero. The important column is
// the fraction of results that are not finite.
#include "rows.hpp"
#include "tables.hpp"
#include "truth/degenerate.hpp"

namespace cotan {

namespace {

// normalize(t m.x + b m.y + n m.z) without a guard, as in widely used shaders.
glm::dvec3 applyUnguarded(const CotangentFrame<float>& f, glm::vec3 m)
{
    const glm::vec3 v = f.t.raw() * m.x + f.b.raw() * m.y + f.n.raw() * m.z;
    return glm::dvec3(v * (1 / std::sqrt(glm::dot(v, v))));
}

} // namespace

std::vector<Measurement> measureDegenerate(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    for (const DegenerateCase& c : degenerateCases()) {
        if (!selection.wantsScene(c.name))
            continue;
        for (Frame frame : differenceFrames()) {
            if (!selection.wants(frame))
                continue;
            Random random(91);
            AngleCollector angles;
            for (int i = 0; i < 2000; ++i) {
                const PixelInput x = makeInput(random, c);
                const glm::dvec3 n = glm::dvec3(x.n);
                glm::dvec3 r;
                if (info(frame).total) {
                    const FlushDenormals flush;
                    r = glm::dvec3(perturb(makeFrame(frame, Covector3f(x.n), x.d), x.m).raw());
                } else {
                    const FlushDenormals flush;
                    const glm::vec3 unit = x.n * (1 / std::sqrt(glm::dot(x.n, x.n)));
                    r = applyUnguarded(makeFrame(frame, Covector3f(unit), x.d), x.m);
                }
                // Without a normal there is nothing to compare with, so only validity counts.
                angles.add(glm::dot(n, n) > 0 ? degreesBetween(r, n) : degreesBetween(r, r));
            }
            result.push_back(angles.finish({"degenerate", c.name, "tilt from the plain normal",
                                            std::string(name(frame)), "plain normal", "float"}));
        }
    }
    return result;
}

} // namespace cotan
