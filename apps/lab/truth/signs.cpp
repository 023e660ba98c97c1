#include "truth/signs.hpp"

namespace cotan {

std::string SignCase::name() const
{
    std::string s = leftHanded ? "left-handed" : "right-handed";
    s += rowsDown ? ", rows down" : ", rows up";
    s += !back ? ", front" : flippedNormal ? ", back, n turned" : ", back";
    return mirrored ? s + ", mirrored" : s;
}

std::vector<SignCase> signCases()
{
    std::vector<SignCase> cases;
    for (int k = 0; k < 32; ++k) {
        const SignCase c{bool(k & 1), bool(k & 2), bool(k & 4), bool(k & 8), bool(k & 16)};
        if (c.back || !c.flippedNormal)
            cases.push_back(c);
    }
    return cases;
}

SignTrial makeSignTrial(Random& random, const SignCase& c)
{
    SignTrial t;
    t.patch = randomPatch(random, c.mirrored);
    const glm::dvec3 side = c.back ? -t.patch.normal : t.patch.normal;
    glm::dvec3 eye;
    do
        eye = random.direction();
    while (glm::dot(eye, side) < 0.3);
    PixelCamera camera = PixelCamera::lookAt(eye * 3.0, {0, 0, 0}, random.direction(), 800);
    camera.rowsDown = c.rowsDown;
    t.d = screenDifferences(camera, t.patch, {0, 0, 0});
    t.n = glm::normalize(t.patch.normal + random.direction() * 0.1);
    if (c.flippedNormal)
        t.n = -t.n;
    if (c.leftHanded) { // the same view in coordinates with negated z
        for (glm::dvec3* v : {&t.n, &t.patch.gradU, &t.patch.gradV})
            v->z = -v->z;
        t.d.dpdx.z = -t.d.dpdx.z;
        t.d.dpdy.z = -t.d.dpdy.z;
    }
    return t;
}

bool signsRight(Frame frame, const SignTrial& t)
{
    const auto f = makeFrame(frame, Covector3d(t.n), t.d);
    return glm::dot(f.t.raw(), t.patch.gradU) > 0 && glm::dot(f.b.raw(), t.patch.gradV) > 0;
}

} // namespace cotan
