#include "cotan/frame.hpp"

#include <algorithm>

namespace cotan {

namespace {

using enum FrameSource;

constexpr std::array<FrameInfo, kFrameCount> kFrames = {{
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary)   \
    {Frame::enumerator, name, #word, source, total, dependsOnView, FrameNormal::normal, fused, after, summary},
#include "cotan/frames.inc"
}};

constexpr bool numberedInOrder()
{
    for (std::size_t i = 0; i < kFrames.size(); ++i)
        if (kFrames[i].frame != Frame(int(i)))
            return false;
    return true;
}
static_assert(numberedInOrder(), "cotan/frames.inc: rows are numbered in their order, from 0");

constexpr bool sameButForDashes(std::string_view name, std::string_view word)
{
    return std::ranges::equal(name, word, [](char a, char b) { return (a == '-' ? '_' : a) == b; });
}
static_assert(std::ranges::all_of(kFrames, [](const FrameInfo& f) { return sameButForDashes(f.name, f.word); }),
              "cotan/frames.inc: a name is its word with '-' for '_'");

// Both precisions of the portable text are at hand in the functions below, and the arguments choose.
#define COTAN_BOTH_PRECISIONS                                                                                          \
    using namespace f32;                                                                                               \
    using namespace f64

// What there is without a frame.
template<class Vec3> auto plain(Vec3 n)
{
    COTAN_BOTH_PRECISIONS;
    decltype(cotan_frame_smooth(n, n, n)) none;
    none.t = none.b = Vec3(0);
    none.n = n;
    return none;
}

// A row of the table is one case, which calls the row's function if that takes the arguments of its source.
#define COTAN_FRAME_CASE(number, enumerator, word, source, ...)                                                        \
    case Frame::enumerator: COTAN_FROM_##source(word);

template<class Vec3, class Vec2> auto fromDifferences(Frame frame, Vec3 n, Vec3 dpdx, Vec3 dpdy, Vec2 duvdx, Vec2 duvdy)
{
    COTAN_BOTH_PRECISIONS;
    switch (frame) {
#define COTAN_FROM_differences(word) return cotan_frame_##word(n, dpdx, dpdy, duvdx, duvdy)
#define COTAN_FROM_triangle(word) return cotan_frame_##word(n, dpdx, dpdy, duvdx, duvdy)
#define COTAN_FROM_cotangents(word) break
#define COTAN_FROM_tangents(word) break
#define COTAN_FRAME_ROW COTAN_FRAME_CASE
#include "cotan/frames.inc"
#undef COTAN_FROM_differences
#undef COTAN_FROM_triangle
#undef COTAN_FROM_cotangents
    }
    return plain(n);
}

template<class Vec3> auto fromCotangents(Frame frame, Vec3 n, Vec3 u, Vec3 v)
{
    COTAN_BOTH_PRECISIONS;
    switch (frame) {
#define COTAN_FROM_differences(word) break
#define COTAN_FROM_triangle(word) break
#define COTAN_FROM_cotangents(word) return cotan_frame_##word(n, u, v)
#define COTAN_FRAME_ROW COTAN_FRAME_CASE
#include "cotan/frames.inc"
#undef COTAN_FROM_cotangents
#undef COTAN_FROM_tangents
    }
    return plain(n);
}

template<class Vec3, class Real> auto fromTangents(Frame frame, Vec3 n, Vec3 t, Real alongV)
{
    COTAN_BOTH_PRECISIONS;
    switch (frame) {
#define COTAN_FROM_cotangents(word) break
#define COTAN_FROM_tangents(word) return cotan_frame_##word(n, t, alongV)
#define COTAN_FRAME_ROW COTAN_FRAME_CASE
#include "cotan/frames.inc"
    }
    return plain(n);
}

#undef COTAN_FROM_differences
#undef COTAN_FROM_triangle
#undef COTAN_FROM_cotangents
#undef COTAN_FROM_tangents
#undef COTAN_FRAME_CASE
#undef COTAN_BOTH_PRECISIONS

} // namespace

const std::array<FrameInfo, kFrameCount>& frames() { return kFrames; }

const FrameInfo& info(Frame frame) { return kFrames[static_cast<std::size_t>(frame)]; }

std::optional<Frame> frameFromName(std::string_view name)
{
    for (const FrameInfo& f : kFrames)
        if (f.name == name)
            return f.frame;
    return std::nullopt;
}

f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx, f32::cotan_vec3 dpdy,
                          f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy)
{
    return fromDifferences(frame, n, dpdx, dpdy, duvdx, duvdy);
}

f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx, f64::cotan_vec3 dpdy,
                          f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy)
{
    return fromDifferences(frame, n, dpdx, dpdy, duvdx, duvdy);
}

f32::cotan_frame evaluateCotangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 u, f32::cotan_vec3 v)
{
    return fromCotangents(frame, n, u, v);
}

f64::cotan_frame evaluateCotangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 u, f64::cotan_vec3 v)
{
    return fromCotangents(frame, n, u, v);
}

f32::cotan_frame evaluateTangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 t, float alongV)
{
    return fromTangents(frame, n, t, alongV);
}

f64::cotan_frame evaluateTangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 t, double alongV)
{
    return fromTangents(frame, n, t, alongV);
}

} // namespace cotan
