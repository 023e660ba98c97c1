#include "tangent_space.hpp"

#include <glm/geometric.hpp>

namespace cotan::figures {

namespace {

using namespace reference;

// Interpolates the vectors of `vectorAt` at the corners, transformed by the transpose of the corners' frames as in a
// vertex shader. The transpose is the inverse only for orthonormal frames. Not normalised at the corners, which makes
// the interpolation exact on a flat triangle.
template<class VectorAt> glm::vec3 interpolated(const SurfaceInputs& in, int lane, VectorAt vectorAt)
{
    const Draw& draw = *in.draw;
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t corner = in.triangle->vertex[i];
        const glm::vec3 n = draw.normals[corner], t(draw.tangents[corner]);
        const glm::vec3 b = glm::cross(n, t) * draw.tangents[corner].w, v = vectorAt(draw.positions[corner]);
        sum += glm::dvec3(glm::dot(t, v), glm::dot(b, v), glm::dot(n, v)) * in.points->weights[std::size_t(lane)][i];
    }
    return f32::cotan_normalize_or(glm::vec3(sum), glm::vec3(0, 0, 1));
}

bool invertible(const f32::cotan_frame& f)
{
    const float determinant = glm::dot(f.t, glm::cross(f.b, f.n));
    return determinant != 0 && f32::cotan_sum_abs(f.t) + f32::cotan_sum_abs(f.b) <= 1e37f;
}

} // namespace

LightSpace tangentSpaceOfVertices()
{
    return [](const SurfaceInputs& in, int lane, const SurfaceNormal& normal, const PreparedLight& light,
              f32::cotan_surface& surface, glm::vec3& toLight) {
        if (!normal.mapped || in.draw->tangents.empty() || in.draw->normals.empty())
            return;
        const bool directional = light.kind == LightKind::directional;
        surface.n = normal.texel;
        surface.v = interpolated(in, lane, [](glm::vec3 p) { return -p; });
        toLight = interpolated(in, lane, [&](glm::vec3 p) { return directional ? toLight : light.position - p; });
    };
}

LightSpace tangentSpaceOfPixels()
{
    return [](const SurfaceInputs&, int, const SurfaceNormal& normal, const PreparedLight&, f32::cotan_surface& surface,
              glm::vec3& toLight) {
        if (!normal.mapped || !invertible(normal.frame))
            return;
        surface.n = normal.texel;
        surface.v = f32::cotan_encode(normal.frame, surface.v);
        toLight = f32::cotan_encode(normal.frame, toLight);
    };
}

} // namespace cotan::figures
