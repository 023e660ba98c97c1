// Facts about src/core in a stand-alone program, for systems without a test library: core_32bit.cmake builds it where
// size_t has 32 bits, scripts/try-smallest against an installed core. Returns the number of facts that do not hold.
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "../src/core/loops.hpp"
#include "cotan/frame.hpp"
#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;

int failures = 0;

void expect(bool fact, const char* what)
{
    if (!fact)
        std::printf("does not hold: %s\n", what);
    failures += !fact;
}

bool near(glm::vec3 a, glm::vec3 b) { return glm::length(a - b) < 1e-5f; }

bool areAll(const std::vector<glm::vec4>& tangents, glm::vec3 t, float w)
{
    for (const glm::vec4& x : tangents)
        if (!near(glm::vec3(x), t) || x.w != w)
            return false;
    return !tangents.empty();
}

void tangentsAreThoseOfTheLayout()
{
    const Arrays plain = flatGrid(160, {1, 0}, {0, 1}), mirrored = flatGrid(160, {-2, 0}, {0, 1});
    for (const int threads : {1, 2, 5}) { // hash tables are partitioned among them
        expect(areAll(cotan::mikktspaceTangents(plain.view(), threads), {1, 0, 0}, 1), "mikktspace");
        expect(areAll(cotan::mikktspaceTangents(mirrored.view(), threads), {-1, 0, 0}, -1), "mikktspace, mirrored");
    }
    expect(areAll(cotan::vertexTangents(plain.view()), {1, 0, 0}, 1), "vertex");
    expect(areAll(cotan::vertexTangents(mirrored.view()), {-1, 0, 0}, -1), "vertex, mirrored");
    const cotan::Cotangents gradients = cotan::smoothCotangents(mirrored.view());
    bool right = gradients.u.size() == mirrored.positions.size();
    for (std::size_t i = 0; right && i < gradients.u.size(); ++i) // uv differences of 1/160, rounded at 6e-8
        right = glm::length(gradients.u[i] - glm::vec3(-2, 0, 0)) < 1e-3f
            && glm::length(gradients.v[i] - glm::vec3(0, -1, 0)) < 1e-3f;
    expect(right, "smooth");
}

void equalVerticesAreOne()
{
    // On a curved surface tangents differ between triangles, so averaging is visible.
    const Arrays shared = sphereGrid(100), single = unindexed(shared);
    const auto a = cotan::mikktspaceTangents(shared.view(), 1), b = cotan::mikktspaceTangents(single.view(), 3);
    bool same = a.size() == b.size();
    for (std::size_t c = 0; same && c < a.size(); ++c)
        same = near(glm::vec3(a[c]), glm::vec3(b[c])) && a[c].w == b[c].w;
    expect(same, "indexed or not, on one thread or three");
    bool east = true;
    for (std::size_t c = 0; c < a.size(); ++c) // the error is less than the change of east over a cell
        east &=
            degreesBetween(glm::vec3(a[c]), glm::cross(glm::vec3(0, 1, 0), shared.normals[shared.indices[c]])) < 1.1;
    expect(east, "tangents of a sphere point east");
}

void verticesAreSplit()
{
    const Arrays a = gridOf(8, [](float x, float y) { return Vertex{{x, -y, 0}, {0, 0, 1}, {std::abs(x - 0.5f), y}}; });
    expect(cotan::splitMirrored(a.view()).sources.size() == 81 + 9, "a mirror line of nine vertices");
}

void framesAndParts()
{
    const cotan::Differences<float> d{
        cotan::Vector3f(0.01f, 0, 0), cotan::Vector3f(0, 0.02f, 0), {0.03f, 0}, {0, 0.03f}};
    const auto f = cotan::makeFrame(cotan::Frame::cotangent, cotan::Covector3f(0, 0, 2), d);
    expect(near(f.t.raw(), {1, 0, 0}) && near(f.b.raw(), {0, 0.5f, 0}), "cotangent frame");
    expect(cotan::partBegin(4000000000u, 63, 64) == 3937500000u, "parts of four billion items");
}

} // namespace

int main()
{
    tangentsAreThoseOfTheLayout();
    equalVerticesAreOne();
    verticesAreSplit();
    framesAndParts();
    std::printf("size_t has %zu bits, %d facts do not hold\n", 8 * sizeof(std::size_t), failures);
    return failures;
}
