#include "bake/low_points.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace cotan {

namespace {

using FrameInputs = LowPoints::FrameInputs;

struct Run { // lanes on one triangle
    std::size_t from, to;
};

template<class Vec> void blend(const Vec& a, const Vec& b, const Vec& c, const FrameInputs& in, Run run, Lanes3& out)
{
    const glm::vec3 p(a), q(b), r(c);
    for (std::size_t i = run.from; i < run.to; ++i) {
        const float b1 = in.b1[i], b2 = in.b2[i];
        out.set(i, p * (1 - b1 - b2) + q * b1 + r * b2);
    }
}

void gather(const LowSurface& s, std::uint32_t triangle, Run run, FrameInputs& in, LowPoints& points)
{
    const std::size_t first = 3 * std::size_t(triangle);
    const std::uint32_t *v = &s.indices[first], a = v[0], b = v[1], c = v[2];
    blend(s.positions[a], s.positions[b], s.positions[c], in, run, points.position);
    blend(s.normals[a], s.normals[b], s.normals[c], in, run, in.raw);
    if (readsCotangents(s.frame)) {
        blend(s.cotangentsU[a], s.cotangentsU[b], s.cotangentsU[c], in, run, in.u);
        blend(s.cotangentsV[a], s.cotangentsV[b], s.cotangentsV[c], in, run, in.v);
    } else if (readsTangents(s.frame)) {
        blend(s.tangents[first], s.tangents[first + 1], s.tangents[first + 2], in, run, in.u);
        for (std::size_t i = run.from; i < run.to; ++i)
            in.handedness[i] = s.tangents[first].w;
    } else {
        const Differences<double> d = differencesOf(s, triangle);
        const glm::vec3 dpdx(d.dpdx.raw()), dpdy(d.dpdy.raw());
        const glm::vec2 duvdx(d.duvdx), duvdy(d.duvdy);
        for (std::size_t i = run.from; i < run.to; ++i) {
            in.dpdx.set(i, dpdx);
            in.dpdy.set(i, dpdy);
            in.ux[i] = duvdx.x;
            in.uy[i] = duvdy.x;
            in.vx[i] = duvdx.y;
            in.vy[i] = duvdy.y;
        }
    }
}

template<class Make> void makeEach(LowPoints& points, const Make& make)
{
    for (std::size_t i = 0; i < kLanes; ++i) {
        const f32::cotan_frame f = make(i);
        points.t.set(i, f.t);
        points.b.set(i, f.b);
        points.n.set(i, f.n);
    }
}

template<class Make> void makeFromDifferences(const FrameInputs& in, LowPoints& points, const Make& make)
{
    makeEach(points, [&](std::size_t i) {
        return make(points.normal.at(i), in.dpdx.at(i), in.dpdy.at(i), glm::vec2(in.ux[i], in.vx[i]),
                    glm::vec2(in.uy[i], in.vy[i]));
    });
}

// One loop for each row of the table of frames, with the portable text inlined.
void makeFrames(Frame frame, const FrameInputs& in, LowPoints& points)
{
    switch (frame) {
#define COTAN_MAKE_differences(word)                                                                                   \
    makeFromDifferences(in, points, [](const auto&... arguments) { return f32::cotan_frame_##word(arguments...); })
#define COTAN_MAKE_triangle(word) COTAN_MAKE_differences(word)
#define COTAN_MAKE_cotangents(word)                                                                                    \
    makeEach(points, [&](std::size_t i) { return f32::cotan_frame_##word(in.raw.at(i), in.u.at(i), in.v.at(i)); })
#define COTAN_MAKE_tangents(word)                                                                                      \
    makeEach(points, [&](std::size_t i) { return f32::cotan_frame_##word(in.raw.at(i), in.u.at(i), in.handedness[i]); })
#define COTAN_FRAME_ROW(number, enumerator, word, source, ...)                                                         \
    case Frame::enumerator:                                                                                            \
        return COTAN_MAKE_##source(word);
#include "cotan/frames.inc"
#undef COTAN_MAKE_differences
#undef COTAN_MAKE_triangle
#undef COTAN_MAKE_cotangents
#undef COTAN_MAKE_tangents
    }
}

// Normalises each vector; zero stays zero.
void normalise(const Lanes3& raw, Lanes3& unit)
{
    for (std::size_t i = 0; i < kLanes; ++i) {
        const glm::vec3 n = raw.at(i);
        const float length = std::sqrt(glm::dot(n, n));
        unit.set(i, length > 0 ? n / length : n);
    }
}

} // namespace

void pointsOf(const LowSurface& surface, std::span<const UvSample> samples, LowPoints& points)
{
    FrameInputs& in = points.from;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        in.b1[i] = samples[i].b1;
        in.b2[i] = samples[i].b2;
    }
    for (Run run{0, 0}; run.from < samples.size(); run.from = run.to) {
        const std::uint32_t triangle = samples[run.from].triangle;
        while (run.to < samples.size() && samples[run.to].triangle == triangle)
            ++run.to;
        gather(surface, triangle, run, in, points);
    }
    runLanes([&] {
        normalise(in.raw, points.normal);
        makeFrames(surface.frame, in, points);
    });
}

void encode(const LowPoints& points, const Lanes3& targets, Lanes3& texels)
{
    runLanes([&] {
        for (std::size_t i = 0; i < kLanes; ++i) {
            f32::cotan_frame f;
            f.t = points.t.at(i);
            f.b = points.b.at(i);
            f.n = points.n.at(i);
            texels.set(i, f32::cotan_encode(f, targets.at(i)));
        }
    });
}

} // namespace cotan
