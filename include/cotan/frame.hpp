// Frames by name, and their evaluation from differences. The mathematics is the portable text
// (shaders/cotan/frame.h); this is its C++ front door.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "cotan/portable.hpp"

namespace cotan {

// The numbers are those of the GPU's specialisation constant COTAN_FRAME.
enum class Frame {
    cotangent = 0,
    cotangent2013 = 1,
    nonperspective = 2,
    paperFull = 3,
    paperNodet = 4,
    paperTranspose = 5,
    paperOrthogonal = 6,
    unit = 7,
    orthonormal = 8,
    gradient = 9,
    exact = 10,
    smooth = 11,
    vertex = 12,
    mikktspace = 13,
};

inline constexpr int kFrameCount = 14;

// What a frame is made from.
enum class FrameSource {
    differences, // normal and differences of position and uv along any two directions
    triangle,    // the same function arguments, but the edges of the whole triangle
    vertices,    // attributes that were made per vertex and interpolated
};

struct FrameInfo {
    Frame frame;
    std::string_view name;    // as on the command line
    FrameSource source;
    bool total;               // no input gives NaN; otherwise degenerate input may
    bool dependsOnView;       // changes with where it is seen from, or with the way that the target's rows run
    std::string_view summary; // one line
};

// All frames, in the order of the enum.
const std::array<FrameInfo, kFrameCount>& frames();

const FrameInfo& info(Frame frame);
inline std::string_view name(Frame frame) { return info(frame).name; }

// Whether the frame at a point of a surface changes with the view: with the place of the eye, or with the way that the
// rows of the target run. No map can be made for such a frame.
inline bool dependsOnView(Frame frame) { return info(frame).dependsOnView; }

// The frame of that name; nothing if there is none.
std::optional<Frame> frameFromName(std::string_view name);

// Evaluates a frame whose source is `differences` or `triangle`. For a frame from vertices there
// is nothing to evaluate here: it gives t = b = 0 and n as passed.
// Arguments and degenerate input: as for the functions cotan_frame_NAME in shaders/cotan/frame.h.
f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx,
                          f32::cotan_vec3 dpdy, f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy);
f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx,
                          f64::cotan_vec3 dpdy, f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy);

} // namespace cotan
