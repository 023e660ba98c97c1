// Frames by name, and their evaluation. The mathematics is the portable text (shaders/cotan/frame.h); this is its
// C++ front door.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "cotan/portable.hpp"

namespace cotan {

// All frames, from the table cotan/frames.inc. The numbers are those of the GPU's specialisation constant COTAN_FRAME.
enum class Frame {
#define COTAN_FRAME_ROW(number, enumerator, ...) enumerator = number,
#include "cotan/frames.inc"
};

inline constexpr int kFrameCount = 0
#define COTAN_FRAME_ROW(...) +1
#include "cotan/frames.inc"
    ;

// What a frame is made from, and by which function.
enum class FrameSource {
    differences, // normal and differences of position and uv along any two directions: evaluate()
    triangle,    // the same arguments, but the edges of the whole triangle: evaluate()
    cotangents,  // two covectors made per vertex and interpolated: evaluateCotangents()
    tangents,    // a tangent and a sign made per vertex and interpolated: evaluateTangents()
};

struct FrameInfo {
    Frame frame;
    std::string_view name; // as on the command line
    std::string_view word; // in the portable text: cotan_frame_WORD
    FrameSource source;
    bool total;               // no input gives NaN; otherwise degenerate input may
    bool dependsOnView;       // changes with where it is seen from, or with the way that the target's rows run
    bool fused;               // there is also cotan_perturb_WORD: frame and texel in one step
    std::string_view summary; // one line
};

// All frames, in the order of the enum.
const std::array<FrameInfo, kFrameCount>& frames();

const FrameInfo& info(Frame frame);
inline std::string_view name(Frame frame) { return info(frame).name; }

// Whether the frame at a point of a surface changes with the view: with the place of the eye, or with the way that the
// rows of the target run. No map can be made for such a frame.
inline bool dependsOnView(Frame frame) { return info(frame).dependsOnView; }

// What a frame reads at the vertices of a mesh, which has to be stored or derived before: nothing, tangents or
// cotangents.
inline bool readsTangents(Frame frame) { return info(frame).source == FrameSource::tangents; }
inline bool readsCotangents(Frame frame) { return info(frame).source == FrameSource::cotangents; }
inline bool readsVertices(Frame frame) { return readsTangents(frame) || readsCotangents(frame); }

// The frame of that name; nothing if there is none.
std::optional<Frame> frameFromName(std::string_view name);

// Whether a number is that of a frame: of one that comes from outside.
inline bool isFrame(int number) { return number >= 0 && number < kFrameCount; }

// Evaluates a frame whose source is `differences` or `triangle`. The caller must not ask for a frame that reads the
// vertices: there is nothing to evaluate, and it gives t = b = 0 and n as passed.
// Arguments and degenerate input: as for the functions cotan_frame_NAME in shaders/cotan/frame.h.
f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx, f32::cotan_vec3 dpdy,
                          f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy);
f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx, f64::cotan_vec3 dpdy,
                          f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy);

// Evaluates a frame whose source is `cotangents`, from interpolated covectors u and v; others as above.
f32::cotan_frame evaluateCotangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 u, f32::cotan_vec3 v);
f64::cotan_frame evaluateCotangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 u, f64::cotan_vec3 v);

// Evaluates a frame whose source is `tangents`, from an interpolated tangent t; others as above.
// alongV: alongV * cross(n, t) points along increasing v. For a glTF TANGENT it is -w.
f32::cotan_frame evaluateTangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 t, float alongV);
f64::cotan_frame evaluateTangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 t, double alongV);

} // namespace cotan
