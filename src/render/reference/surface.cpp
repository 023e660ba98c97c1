#include "pixel.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "cotan/frame.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::reference {

namespace {

bool hasUv(const Draw& draw, std::size_t set) { return draw.mesh->texcoords[set].size() >= draw.positions.size(); }

// Interpolates in double and rounds once: a difference of neighbours then has only the rounding errors of its two
// values, as on a GPU at best.
template<glm::length_t N>
glm::vec<N, float> interpolated(const std::vector<glm::vec<N, float>>& values, const RasterTriangle& triangle,
                                const std::array<double, 3>& weights)
{
    glm::vec<N, double> sum(0);
    for (std::size_t i = 0; i < 3; ++i)
        sum += glm::vec<N, double>(values[triangle.vertex[i]]) * weights[i];
    return glm::vec<N, float>(sum);
}

std::size_t setOf(const Texture& texture) { return texture.texcoord == 1 ? 1 : 0; }

// Screen-space differences of a lane, along its own row or column.
template<class ValueAt> auto alongX(const ValueAt& valueAt, int lane) { return valueAt(lane | 1) - valueAt(lane & 2); }
template<class ValueAt> auto alongY(const ValueAt& valueAt, int lane) { return valueAt(lane | 2) - valueAt(lane & 1); }

// Transforms differences of texture coordinates: the linear part of the transform.
glm::vec2 transformedEdge(const Texture& texture, glm::vec2 edge)
{
    return {glm::dot(glm::vec2(texture.uRow), edge), glm::dot(glm::vec2(texture.vRow), edge)};
}

// The frame of a whole triangle, from its edges instead of screen-space differences. The edges are computed in the mesh
// and then transformed, so that they keep precision far from the eye.
f32::cotan_frame frameOfTriangle(const SurfaceInputs& in, const Texture& texture, glm::vec3 n)
{
    std::size_t set = setOf(texture);
    if (!hasUv(*in.draw, set))
        return {glm::vec3(0), glm::vec3(0), n};
    const std::array<std::uint32_t, 3>& v = in.triangle->vertex;
    const std::vector<glm::vec3>& p = in.draw->mesh->positions;
    const std::vector<glm::vec2>& uv = in.draw->mesh->texcoords[set];
    return evaluate(in.draw->frame, n, in.draw->vectors * (p[v[1]] - p[v[0]]), in.draw->vectors * (p[v[2]] - p[v[0]]),
                    transformedEdge(texture, uv[v[1]] - uv[v[0]]), transformedEdge(texture, uv[v[2]] - uv[v[0]]));
}

// The normal without a map, and the differences of position that frames are made from.
struct Smooth {
    glm::vec3 raw{0}; // as interpolated
    glm::vec3 n{0};   // unit
    glm::vec3 dpdx{0};
    glm::vec3 dpdy{0};
};

// Frames from vertex attributes. t = b = 0 if the mesh lacks them.
f32::cotan_frame frameOfVertices(const SurfaceInputs& in, const Smooth& smooth, int lane)
{
    const Frame frame = in.draw->frame;
    const std::array<double, 3>& weights = in.points->weights[std::size_t(lane)];
    const Draw& draw = *in.draw;
    const RasterTriangle& triangle = *in.triangle;
    if (readsCotangents(frame) && !draw.cotangentsU.empty() && !draw.cotangentsV.empty())
        return evaluateCotangents(frame, smooth.n, interpolated(draw.cotangentsU, triangle, weights),
                                  interpolated(draw.cotangentsV, triangle, weights));
    if (readsCotangents(frame) || draw.tangents.empty())
        return {glm::vec3(0), glm::vec3(0), smooth.n};
    glm::vec4 tangent = interpolated(draw.tangents, triangle, weights);
    const glm::vec3 n = info(frame).normal == FrameNormal::nobody ? smooth.raw : smooth.n;
    return evaluateTangents(frame, n, glm::vec3(tangent), tangent.w);
}

glm::vec3 finiteOrZero(glm::vec3 v) { return f32::cotan_sum_abs(v) <= 1e37f ? v : glm::vec3(0); }

// Texture coordinates of a map in one lane, transformed, with their differences. These are taken relative to the
// triangle's corner: near zero floats are dense, so small differences of uv far from zero are not lost to rounding.
UvDifferences uvOf(const SurfaceInputs& in, const Texture& texture, int lane)
{
    const std::size_t set = setOf(texture);
    const auto cornerUv = [&](int at) { return in.points->cornerUv[set][std::size_t(at)]; };
    return {textureUv(texture, in.points->uv[set][std::size_t(lane)]), transformedEdge(texture, alongX(cornerUv, lane)),
            transformedEdge(texture, alongY(cornerUv, lane))};
}

// Interpolates a uv set in one lane, both absolute and relative to the triangle's first corner.
void interpolateUv(QuadPoints& quad, std::size_t set, std::size_t lane, const Draw& draw,
                   const RasterTriangle& triangle)
{
    const std::vector<glm::vec2>& uv = draw.mesh->texcoords[set];
    const std::array<double, 3>& weights = quad.weights[lane];
    const glm::dvec2 corner(uv[triangle.vertex[0]]);
    const glm::dvec2 relative = (glm::dvec2(uv[triangle.vertex[1]]) - corner) * weights[1]
        + (glm::dvec2(uv[triangle.vertex[2]]) - corner) * weights[2];
    quad.cornerUv[set][lane] = glm::vec2(relative);
    quad.uv[set][lane] = glm::vec2(corner + relative);
}

Smooth smoothOf(const SurfaceInputs& in, int lane, const UvDifferences& uv)
{
    Smooth smooth;
    const auto position = [&](int at) { return in.points->position[std::size_t(at)]; };
    smooth.dpdx = alongX(position, lane);
    smooth.dpdy = alongY(position, lane);
    if (!in.draw->normals.empty())
        smooth.raw = interpolated(in.draw->normals, *in.triangle, in.points->weights[std::size_t(lane)]);
    f32::cotan_differences safe = f32::cotan_scale_differences(smooth.dpdx, smooth.dpdy, uv.dx, uv.dy);
    smooth.n = f32::cotan_safe_normal(smooth.raw, safe.dpdx, safe.dpdy);
    return smooth;
}

// Sets the differences of the interpolated normals in the pixel, if the view needs them.
void addNormalDifferences(SurfaceNormal& result, const SurfaceInputs& in, int lane)
{
    if (!in.view->specularAntialiasing)
        return;
    const auto normal = [&](int at) { return smoothOf(in, at, {}).n; };
    result.dndx = alongX(normal, lane);
    result.dndy = alongY(normal, lane);
    result.smoothVariance = result.variance = f32::cotan_variance_of_curvature(result.dndx, result.dndy);
}

// The variance that a normal map texel encodes: mips store the length of their mean in the fourth channel.
float lostVariance(const View& view, glm::vec4 texel)
{
    return view.specularAntialiasing ? f32::cotan_variance_of_length(texel.w) : 0;
}

// The view's frame for the uv of a map.
f32::cotan_frame frameOver(const SurfaceInputs& in, const Texture& map, const Smooth& smooth, const UvDifferences& uv,
                           int lane)
{
    const Frame frame = in.draw->frame;
    if (info(frame).source == FrameSource::triangle)
        return frameOfTriangle(in, map, smooth.n);
    if (readsVertices(frame))
        return frameOfVertices(in, smooth, lane);
    return evaluate(frame, smooth.n, smooth.dpdx, smooth.dpdy, uv.dx, uv.dy);
}

bool sameUv(const Texture& a, const Texture& b) { return setOf(a) == setOf(b) && a.uRow == b.uRow && a.vRow == b.vRow; }

glm::vec2 heightMapSize(const SurfaceInputs& in)
{
    const Image& image = *in.draw->maps->height->image;
    return {image.width, image.height};
}

// Reads heights in one lane.
struct HeightReader {
    const SurfaceInputs& in;
    UvDifferences footprint; // a square with the shorter side of the pixel's: longer ones would level walls

    HeightReader(const SurfaceInputs& inputs, int lane) : in(inputs)
    {
        footprint = uvOf(in, in.draw->material->heightMap.map, lane);
        const glm::vec2 size = heightMapSize(in);
        const float x = glm::length(footprint.dx * size), y = glm::length(footprint.dy * size), side = std::min(x, y);
        footprint.dx *= x > side ? side / x : 1;
        footprint.dy *= y > side ? side / y : 1;
    }
    // The stored height at uv of the height map's set.
    float at(glm::vec2 uv) const
    {
        const Texture& map = in.draw->material->heightMap.map;
        const UvDifferences here{textureUv(map, uv), footprint.dx, footprint.dy};
        return sample(*in.draw->maps->height, map.sampler, here, in.view->pointSampled).x;
    }
};

// The steps of a ray that changes uv of the height map's set by `travel`.
float heightSteps(const SurfaceInputs& in, glm::vec2 travel)
{
    const glm::vec2 texels = transformedEdge(in.draw->material->heightMap.map, travel) * heightMapSize(in);
    int steps = kMinHeightSteps;
    while (steps < kMaxHeightSteps && float(steps) < glm::length(texels))
        steps *= 2;
    return float(steps);
}

// How the material's normal map is decoded.
f32::cotan_normal_format formatOf(const SurfaceInputs& in)
{
    return toFormat<f32::cotan_normal_format>(in.draw->material->normalFormat, in.draw->maps->normal->image->type,
                                              double(in.draw->material->normalScale));
}

} // namespace

QuadPoints interpolate(const Draw& draw, const RasterTriangle& triangle, int x, int y)
{
    QuadPoints quad;
    for (std::size_t lane = 0; lane < 4; ++lane) {
        double px = x + int(lane & 1) + 0.5, py = y + int(lane >> 1) + 0.5;
        double w0 = triangle.weight[0].at(px, py), w1 = triangle.weight[1].at(px, py);
        double w2 = triangle.weight[2].at(px, py), w = 1 / (w0 + w1 + w2);
        std::array<double, 3>& weights = quad.weights[lane];
        weights = {w0 * w, w1 * w, w2 * w};
        quad.position[lane] = interpolated(draw.positions, triangle, weights);
    }
    for (std::size_t set = 0; set < 2; ++set)
        if (hasUv(draw, set))
            for (std::size_t lane = 0; lane < 4; ++lane)
                interpolateUv(quad, set, lane, draw, triangle);
    return quad;
}

glm::vec3 toEye(const Projection& projection, glm::vec3 position)
{
    const glm::vec3 backwards = -glm::vec3(projection.forward);
    return projection.orthographic ? backwards : f32::cotan_normalize_or(-position, backwards);
}

void moveToRelief(const Projection& projection, const SurfaceInputs& in, QuadPoints& points)
{
    const HeightMap& heights = in.draw->material->heightMap;
    const std::size_t set = setOf(heights.map);
    if (!in.draw->maps->height || !hasUv(*in.draw, set))
        return;
    for (std::size_t lane = 0; lane < 4; ++lane) {
        const HeightReader height(in, int(lane));
        const Smooth smooth = smoothOf(in, int(lane), height.footprint);
        const glm::vec3 v = toEye(projection, points.position[lane]);
        std::array<glm::vec2, 2> travel;
        for (std::size_t s = 0; s < 2; ++s) {
            const auto uv = [&](int at) { return points.cornerUv[s][std::size_t(at)]; };
            const f32::cotan_frame frame = f32::cotan_frame_gradient(smooth.n, smooth.dpdx, smooth.dpdy,
                                                                     alongX(uv, int(lane)), alongY(uv, int(lane)));
            travel[s] = f32::cotan_relief_start(frame, v, glm::vec2(0), heights.depth, 1).travel;
            if (s == set)
                points.relief[lane].frame = frame;
        }
        const float steps = heightSteps(in, travel[set]);
        f32::cotan_relief r =
            f32::cotan_relief_start(points.relief[lane].frame, v, points.uv[set][lane], heights.depth, steps);
        for (int i = 0; i < int(steps) && r.found < 0.5f; ++i)
            r = f32::cotan_relief_next(r, height.at(r.uv));
        for (int i = 0; i < kHeightHalvings; ++i)
            r = f32::cotan_relief_next(r, height.at(r.uv));
        points.relief[lane].height = 1 - r.at;
        for (std::size_t s = 0; s < 2; ++s) // both sets move by the same way through space
            points.uv[s][lane] += travel[s] * r.at;
    }
}

float reliefLight(const SurfaceInputs& in, int lane, glm::vec3 toLight)
{
    const HeightMap& heights = in.draw->material->heightMap;
    const std::size_t set = setOf(heights.map);
    if (!in.draw->maps->height || !hasUv(*in.draw, set))
        return 1;
    const ReliefPoint& point = in.points->relief[std::size_t(lane)];
    const HeightReader height(in, lane);
    const auto search = [&](float steps) {
        return f32::cotan_relief_shadow(point.frame, toLight, in.points->uv[set][std::size_t(lane)], point.height,
                                        heights.depth, steps);
    };
    const float steps = heightSteps(in, search(1).travel);
    f32::cotan_relief r = search(steps);
    for (int i = 0; i < int(steps) && r.found < 0.5f; ++i)
        r = f32::cotan_relief_next(r, height.at(r.uv));
    return 1 - r.found;
}

glm::vec4 mapTexel(const SurfaceInputs& in, const MipChain* chain, const Texture& texture, int lane)
{
    return chain ? sample(*chain, texture.sampler, uvOf(in, texture, lane), in.view->pointSampled) : glm::vec4(1);
}

glm::vec4 baseColorOf(const SurfaceInputs& in, int lane)
{
    const Material& m = *in.draw->material;
    glm::vec4 base = m.baseColor * mapTexel(in, in.draw->maps->baseColor, m.baseColorMap, lane);
    const std::vector<glm::vec4>& colors = in.draw->mesh->colors;
    if (colors.size() >= in.draw->positions.size())
        base *= interpolated(colors, *in.triangle, in.points->weights[std::size_t(lane)]);
    return base;
}

unsigned samplesOfMask(const std::array<float, 4>& alphas, int lane, float cutoff, const SamplePattern& pattern)
{
    const float alpha = alphas[std::size_t(lane)];
    const float slopeX = alphas[std::size_t(lane | 1)] - alphas[std::size_t(lane & 2)];
    const float slopeY = alphas[std::size_t(lane | 2)] - alphas[std::size_t(lane & 1)];
    unsigned samples = 0;
    for (int s = 0; s < pattern.count; ++s) {
        const glm::vec2 offset = glm::vec2(pattern.offset[std::size_t(s)]) / float(kSubPixels) - 0.5f;
        if (!(alpha + slopeX * offset.x + slopeY * offset.y < cutoff))
            samples |= 1u << s;
    }
    return samples;
}

SurfaceNormal normalOf(const SurfaceInputs& in, int lane)
{
    const View& view = *in.view;
    const Material& material = *in.draw->material;
    const Texture& map = frameTexture(material);
    UvDifferences uv = uvOf(in, map, lane);
    const Smooth smooth = smoothOf(in, lane, uv);
    const glm::vec3 n = smooth.n;
    const f32::cotan_frame frame = frameOver(in, map, smooth, uv, lane);

    SurfaceNormal result;
    result.interpolated = result.perturbed = n;
    result.t = finiteOrZero(frame.t);
    result.b = finiteOrZero(frame.b);
    result.uv = uv.uv;
    result.frame = frame;
    addNormalDifferences(result, in, lane);
    result.mapped = in.draw->maps->normal && view.normalMaps && hasUv(*in.draw, setOf(material.normalMap));
    if (result.mapped) {
        glm::vec4 texel = sample(*in.draw->maps->normal, material.normalMap.sampler, uv, view.pointSampled);
        const glm::vec3 m = f32::cotan_decode(glm::vec3(texel), formatOf(in));
        result.variance += lostVariance(view, texel);
        // `mikktspace` returns its interpolated normal, not unit, if the texel is empty.
        result.perturbed = f32::cotan_normalize_or(f32::cotan_apply(frame, m), n);
    }
    // The back of a two-sided material is the other side of the same thin sheet: a bump seen from behind is a dent, so
    // the perturbed normal is negated. t and b stay.
    if (!in.triangle->front)
        result.perturbed = -result.perturbed;
    return result;
}

std::vector<LitTap> tapsOf(const SurfaceInputs& in, int lane, const SurfaceNormal& normal, float roughness)
{
    const Texture& map = in.draw->material->normalMap;
    const UvDifferences uv = uvOf(in, map, lane);
    const int perSide = int(f32::cotan_samples_of_roughness(roughness));
    std::vector<LitTap> taps(std::size_t(perSide * perSide));
    const float fraction = 1 / float(perSide), base = normal.smoothVariance * fraction * fraction;
    const f32::cotan_normal_format format = formatOf(in);
    for (int i = 0; i < perSide * perSide; ++i) {
        // Offset from the pixel's centre, in pixels.
        const glm::vec2 at = (glm::vec2(float(i % perSide), float(i / perSide)) + 0.5f) / float(perSide) - 0.5f;
        const UvDifferences tapUv{uv.uv + uv.dx * at.x + uv.dy * at.y, uv.dx * fraction, uv.dy * fraction};
        const glm::vec4 texel = sample(*in.draw->maps->normal, map.sampler, tapUv, in.view->pointSampled);
        const glm::vec3 m = f32::cotan_decode(glm::vec3(texel), format);
        glm::vec3 n = f32::cotan_normalize_or(f32::cotan_apply(normal.frame, m), normal.interpolated);
        n = f32::cotan_normalize_or(n + normal.dndx * at.x + normal.dndy * at.y, n);
        taps[std::size_t(i)] = {in.triangle->front ? n : -n,
                                f32::cotan_roughness_of_variance(roughness, base + lostVariance(*in.view, texel))};
    }
    return taps;
}

CoatNormal coatNormalOf(const SurfaceInputs& in, int lane, const SurfaceNormal& base)
{
    const Texture& map = in.draw->material->coat.normalMap;
    const MipChain* const chain = in.draw->maps->coatNormal;
    CoatNormal coat{base.interpolated, base.smoothVariance};
    if (chain && hasUv(*in.draw, setOf(map))) {
        const UvDifferences uv = uvOf(in, map, lane);
        f32::cotan_frame frame = base.frame;
        if (!sameUv(map, frameTexture(*in.draw->material))) {
            const Smooth smooth = smoothOf(in, lane, uv);
            // Vertex attributes are made for the uv of the surface below. Without them, these frames come nearest.
            const Frame own = readsCotangents(in.draw->frame) ? Frame::cotangent : Frame::orthonormal;
            frame = readsVertices(in.draw->frame) ? evaluate(own, smooth.n, smooth.dpdx, smooth.dpdy, uv.dx, uv.dy)
                                                  : frameOver(in, map, smooth, uv, lane);
        }
        const glm::vec4 texel = sample(*chain, map.sampler, uv, in.view->pointSampled);
        const auto format = toFormat<f32::cotan_normal_format>(in.draw->material->coat.normalFormat, chain->image->type,
                                                               double(in.draw->material->coat.normalScale));
        coat.n = f32::cotan_normalize_or(f32::cotan_apply(frame, f32::cotan_decode(glm::vec3(texel), format)), coat.n);
        coat.variance += lostVariance(*in.view, texel);
    }
    if (!in.triangle->front)
        coat.n = -coat.n;
    return coat;
}

} // namespace cotan::reference
