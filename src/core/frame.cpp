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

constexpr bool isWordWithDashes(const FrameInfo& f)
{
    return std::ranges::equal(f.name, f.word, [](char a, char b) { return (a == '-' ? '_' : a) == b; });
}
static_assert(std::ranges::all_of(kFrames, isWordWithDashes), "cotan/frames.inc: a name is its word with '-' for '_'");

// Each row of the table makes one case. The case calls the row's function if the row has one of these sources, with the
// arguments of that source and the caller's precision. Other frames return the normal with t = b = 0.
template<FrameSource... kSources, class Vec3, class... Rest> auto evaluated(Frame frame, Vec3 n, Rest... rest)
{
    using namespace f32;
    using namespace f64;
    switch (frame) {
#define COTAN_FRAME_ROW(number, enumerator, word, source, ...)                                                         \
    case Frame::enumerator:                                                                                            \
        if constexpr (((source == kSources) || ...))                                                                   \
            return cotan_frame_##word(n, rest...);                                                                     \
        break;
#include "cotan/frames.inc"
    }
    return decltype(cotan_frame_smooth(n, n, n)){Vec3(0), Vec3(0), n};
}

} // namespace

const std::array<FrameInfo, kFrameCount>& frames() { return kFrames; }

const FrameInfo& info(Frame frame) { return kFrames[static_cast<std::size_t>(frame)]; }

std::optional<Frame> frameFromName(std::string_view name)
{
    const auto found = std::ranges::find(kFrames, name, &FrameInfo::name);
    return found != kFrames.end() ? std::optional(found->frame) : std::nullopt;
}

f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx, f32::cotan_vec3 dpdy,
                          f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy)
{
    return evaluated<FrameSource::differences, FrameSource::triangle>(frame, n, dpdx, dpdy, duvdx, duvdy);
}

f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx, f64::cotan_vec3 dpdy,
                          f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy)
{
    return evaluated<FrameSource::differences, FrameSource::triangle>(frame, n, dpdx, dpdy, duvdx, duvdy);
}

f32::cotan_frame evaluateCotangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 u, f32::cotan_vec3 v)
{
    return evaluated<FrameSource::cotangents>(frame, n, u, v);
}

f64::cotan_frame evaluateCotangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 u, f64::cotan_vec3 v)
{
    return evaluated<FrameSource::cotangents>(frame, n, u, v);
}

f32::cotan_frame evaluateTangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 t, float alongV)
{
    return evaluated<FrameSource::tangents>(frame, n, t, alongV);
}

f64::cotan_frame evaluateTangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 t, double alongV)
{
    return evaluated<FrameSource::tangents>(frame, n, t, alongV);
}

} // namespace cotan
