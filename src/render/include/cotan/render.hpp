// Draws a view of a scene, on a Vulkan device or on the processor.
//
//     auto image = cotan::drawView(scene, view); // the best device there is
//     if (!image)
//         return fail(image.error().message);
//
// Several images of one scene, or a device by its name:
//
//     auto renderer = cotan::openRenderer("reference");
//     cotan::Status loaded = (*renderer)->load(scene);
//     auto normals = (*renderer)->draw(view);
//
// The reference renderer is always available. The Vulkan renderer needs a library that was built with Vulkan.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- one image -----------------------------------------------------------------------------

// Draws a view of the scene, with the output and size that `view` states. If the scene lacks the tangents or cotangents
// that view.frame reads at vertices, they are generated; use std::move for a scene that is no longer needed.
// device: as for openRenderer. threads: of the reference renderer; 0 means all cores. To draw several images, or to
// know which device "auto" has found, open a Renderer.
// Errors: those of openRenderer, Renderer::load and Renderer::draw.
Result<Image> drawView(Scene scene, const View& view, const std::string& device = "auto", int threads = 0);

// ---- several images ------------------------------------------------------------------------

// An open device or the reference renderer, made by openRenderer. Use it from one thread at a time. drawView draws a
// single image.
class Renderer {
public:
    virtual ~Renderer() = default;

    // Replaces the loaded scene. `scene` must live until the next load, forget, or the renderer's end. Frames that read
    // vertex attributes need those that deriveVertexFrames (cotan/view.hpp) adds; without them draw() fails.
    // Errors: ErrorKind::input for an inconsistent scene (checkScene), and on a Vulkan device for more than 100 million
    // drawn triangles, which the reference renderer reports in draw; ErrorKind::unavailable if the device has not
    // enough memory.
    // sameImages: all images are those of the previous scene, in the same order (in another frame of an animation, for
    // example), and their textures are kept. If the previous load failed, all are uploaded again.
    Status load(const Scene& scene, bool sameImages = false);

    // Unloads the scene.
    void forget() { loaded_ = false; }

    // Draws the loaded scene. Errors: ErrorKind::usage without a scene, for a size that cannot be drawn (the reference
    // renderer: 1 to 16384 pixels a side), an unknown frame, or one whose vertex attributes the scene lacks;
    // ErrorKind::unavailable if memory runs out; those of renderReference; on a Vulkan device for more than 2.8 million
    // translucent fragments in one row of pixels.
    Result<Image> draw(const View& view);

    // "reference", or the Vulkan device's name.
    virtual std::string device() const = 0;
    // Seconds that the last load spent uploading to the device; 0 for the reference renderer.
    virtual double uploadSeconds() const { return 0; }
    // All messages of Vulkan's validation layer, if openRenderer enabled it.
    virtual std::vector<std::string> messages() const { return {}; }

    // Called with 0 before each image and then, by the reference renderer, with the fraction drawn so far, from several
    // threads. If it returns false, draw fails with ErrorKind::stopped.
    Progress progress;
    // Why "auto" chose the reference renderer, in one line; otherwise empty.
    std::string note;

private:
    virtual Status loadScene(const Scene& scene, bool sameImages) = 0;
    virtual Result<Image> drawLoaded(const View& view) = 0;

    bool loaded_ = false;
    bool holds_ = false; // the last load succeeded
};

// Opens a device. `device`: "reference"; "auto" for the best Vulkan device, or the reference renderer if there is none
// (`note` then says why); anything else is matched case-insensitively with part of a Vulkan device's name.
// threads: of the reference renderer; 0 means all cores; the images do not depend on it. validation: enables Vulkan's
// validation layer; if it is not installed, the first message says so.
// Errors: ErrorKind::unavailable, never for "auto" and "reference".
Result<std::unique_ptr<Renderer>> openRenderer(const std::string& device = "auto", int threads = 0,
                                               bool validation = false);

// ---- exposure ------------------------------------------------------------------------------

// The exposure for a view of the renderer's scene, metered from a small render without background. The geometric mean
// of the brightness of covered pixels moves part of the way to middle grey, so that white stays bright and black dark,
// and the brightest 2 % stay below the values that tone curves clip. The result is rounded to 1/32 of a stop, so that
// renderers which differ by rounding agree. It is 1 if nothing is visible. view.exposure, ground and background are
// ignored. The tone curve is that of the view, so that a device compiles no additional shaders.
// Errors: those of Renderer::draw.
Result<float> meterExposure(Renderer& renderer, View view);

// ---- cameras as text -----------------------------------------------------------------------

// Parses a camera:
//   "fit": the whole scene from the front, slightly from above; "front": the same, as close as its vertices permit;
//   both
//     frame the whole animation (Scene::reach);
//   "left", "right", "top", "bottom", "back": straight from that side; "orbit:AZIMUTH,ELEVATION": from any direction,
//   in
//     degrees as for orbitCamera (cotan/view.hpp), at most 360 around and 90 up or down; "0", "1", ...: a scene camera;
//   "ex,ey,ez,tx,ty,tz": from the eye e to the target t, in world units, with y up (-z for a vertical view) and a
//   vertical
//     field of view of 45 degrees. A seventh number is another field of view in degrees, or "h" and a number for an
//     orthographic camera with that height in world units. Three more numbers are the up direction.
// width, height: of the image, in pixels. Errors: ErrorKind::usage, with what was expected and found.
Result<Camera> parseCamera(const std::string& text, const Scene& scene, int width, int height);

// Formats a camera so that parseCamera returns the same camera, to the bit, except for its name.
std::string formatCamera(const Camera& camera);

// ---- the reference renderer ----------------------------------------------------------------

// Draws a scene on the CPU as a GPU would. Written to be simple, not fast, as the reference for other renderers: pixels
// in 2x2 quads whose helper lanes extrapolate the triangle, derivatives as differences inside the quad, clipping at the
// near plane, the portable text in float. The image is the same, byte for byte, for any number of threads.
// threads: 0 means all cores. progress is called from several threads. Any number of translucent layers is composed per
// sample in depth order; of equally distant ones the one drawn later is in front.
// Errors: ErrorKind::usage for an inconsistent view, or more than 16384 pixels a side; ErrorKind::input over 100
// million triangles, instances counted; ErrorKind::unavailable if memory runs out, or for more than 1024 translucent
// layers per pixel on average in a tile of 32 x 32 pixels.
Result<Image> renderReference(const Scene& scene, const View& view, int threads = 0, const Progress& progress = {});

} // namespace cotan
