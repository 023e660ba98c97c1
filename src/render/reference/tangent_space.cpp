#include "tangent_space.hpp"

#include <glm/geometric.hpp>

namespace cotan::reference {

namespace {

const glm::vec3 kOutwards(0, 0, 1);

// The transpose of the frame times v, as at a vertex: the inverse only if the frame is orthonormal.
glm::dvec3 byTranspose(const f32::cotan_frame& f, glm::vec3 v)
{
    return {glm::dot(f.t, v), glm::dot(f.b, v), glm::dot(f.n, v)};
}

// Interpolates what `vectorAt` gives at the corners, carried by their frames.
template<class VectorAt> glm::vec3 interpolated(const TangentSpace& space, VectorAt vectorAt)
{
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 3; ++i)
        sum += byTranspose(space.corners[i], vectorAt(space.positions[i])) * space.weights[i];
    return f32::cotan_normalize_or(glm::vec3(sum), kOutwards);
}

bool invertible(const f32::cotan_frame& f)
{
    const float determinant = glm::dot(f.t, glm::cross(f.b, f.n));
    return determinant != 0 && f32::cotan_sum_abs(f.t) + f32::cotan_sum_abs(f.b) <= 1e37f;
}

// The frames of the triangle's corners from stored tangents.
void setCorners(TangentSpace& space, const Draw& draw, const RasterTriangle& triangle)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = triangle.vertex[i];
        const glm::vec3 n = draw.normals[v], t(draw.tangents[v]);
        space.corners[i].t = t;
        space.corners[i].b = glm::cross(n, t) * draw.tangents[v].w;
        space.corners[i].n = n;
        space.positions[i] = draw.positions[v];
    }
}

} // namespace

std::optional<TangentSpace> tangentSpaceOf(const SurfaceInputs& in, const SurfaceNormal& normal,
                                           const f32::cotan_surface& surface, const std::array<double, 3>& weights,
                                           bool orthographic)
{
    const Draw& draw = *in.draw;
    const Lighting lighting = in.view->lighting;
    if (lighting == Lighting::world || !normal.mapped)
        return std::nullopt;
    TangentSpace space{surface};
    space.pixel = normal.frame;
    space.weights = weights;
    space.surface.n = normal.texel;
    space.perVertex = lighting == Lighting::tangentVertex;
    if (space.perVertex) {
        if (draw.tangents.empty() || draw.normals.empty())
            return std::nullopt;
        setCorners(space, draw, *in.triangle);
        // Not normalised at the corners: then it is exact on a flat triangle.
        space.surface.v = interpolated(space, [&](glm::vec3 p) { return orthographic ? surface.v : -p; });
        return space;
    }
    if (!invertible(normal.frame))
        return std::nullopt;
    space.surface.v = f32::cotan_encode(normal.frame, surface.v);
    return space;
}

glm::vec3 carried(const TangentSpace& space, const PreparedLight& light, glm::vec3 toLight)
{
    if (!space.perVertex)
        return f32::cotan_encode(space.pixel, toLight);
    const bool directional = light.kind == LightKind::directional;
    return interpolated(space, [&](glm::vec3 p) { return directional ? toLight : light.position - p; });
}

} // namespace cotan::reference
