// Cotan's headers must leave a program's own GLM vectors unchanged, and both must agree on arrays between them.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <glm/vec3.hpp>

#include <cotan/frame.hpp>
#include <cotan/tangents.hpp>
#include <cotan/triangle.hpp>
#include <cotan/vector.hpp>
#include <cotan/version.hpp>

#ifdef GLM_FORCE_DEFAULT_ALIGNED_GENTYPES
static_assert(sizeof(glm::vec3) == 16 && alignof(glm::vec3) == 16, "a uniform buffer of this program has gaps now");
#else
static_assert(sizeof(glm::vec3) == 12);
#endif

int main()
{
    glm::vec3 colour(0.25f, 0.5f, 1);
    colour.r = colour.g + colour.b;
#ifdef GLM_FORCE_SWIZZLE
    const glm::vec3 reordered = colour.bgr();
#else
    const glm::vec3 reordered(colour.b, colour.g, colour.r);
#endif
    const std::vector<cotan::packed::vec3> positions{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, normals(3, {0, 0, 1});
    const std::vector<cotan::packed::vec2> texcoords{{0, 0}, {-1, 0}, {0, 1}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    const std::vector<cotan::packed::vec4> tangents =
        cotan::mikktspaceTangents({positions, normals, texcoords, indices}, /*threads*/ 1);

    cotan::Differences<float> d;
    d.dpdx = cotan::Vector3f(2, 0, 0);
    d.dpdy = cotan::Vector3f(0, 2, 0);
    d.duvdx = {-1, 0};
    d.duvdy = {0, 1};
    const auto frame = makeFrame(cotan::Frame::cotangent, cotan::Covector3f(0, 0, 1), d);
    const cotan::Covector3f normal = perturb(frame, glm::vec3(0.6f, 0, 0.8f));

    const bool good = tangents.size() == 3 && tangents[0].x == -1 && tangents[2].x == -1 && normal.x < -0.5f
        && reordered.r == 1 && colour.r == 1.5f;
    std::printf("cotan %s: tangent %g %g %g, normal %g %g %g\n", COTAN_VERSION_TEXT, tangents[0].x, tangents[0].y,
                tangents[0].z, normal.x, normal.y, normal.z);
    return good ? 0 : 1;
}
