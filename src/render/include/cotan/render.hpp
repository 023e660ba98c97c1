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
// The reference renderer is always there. What is said of Vulkan needs a library that was built with it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- one image -----------------------------------------------------------------------------

// Draws the view of the scene on the device of that name, as openRenderer takes it.
// Tangents or cotangents that view.frame reads at the vertices are made where the scene has none; pass a
// scene that is no longer needed by std::move. The picture is as view.output says, in View's size.
// threads: of the reference renderer; 0 means all cores. For several pictures, or to know which device
// "auto" has found, open a Renderer.
// Errors: those of openRenderer, Renderer::load and Renderer::draw.
Result<Image> drawView(Scene scene, const View& view, const std::string& device = "auto", int threads = 0);

// ---- several images ------------------------------------------------------------------------

// A device that is open, or the reference renderer. Made by openRenderer; for one picture there is drawView. One thread
// at a time.
class Renderer {
public:
    virtual ~Renderer() = default;

    // Takes a scene in the place of the one before. It must live until the next load, forget or the
    // renderer's end. Frames from vertices read what deriveVertexFrames (cotan/view.hpp)
    // has put into it; without that draw() refuses them.
    // Errors: ErrorKind::input for a scene that does not hold together (checkScene), and over 100 million
    // drawn triangles of a Vulkan device; the reference renderer says that in draw. ErrorKind::unavailable
    // when the device has not enough memory.
    // sameImages: all images are those of the scene that was loaded before, in its order (another moment of an
    // animation, say); what was made of them is kept. Where that load failed, everything is made again.
    Status load(const Scene& scene, bool sameImages = false);

    // The renderer has no scene from here on.
    void forget() { loaded_ = false; }

    // A picture of the loaded scene. Errors: ErrorKind::usage without a scene, for a size that cannot be drawn (the
    // reference renderer: 1 to 16384 pixels a side), an unknown frame, or one that reads what the scene lacks at its
    // vertices; ErrorKind::unavailable without the memory; those of VulkanRenderer::render and renderReference.
    Result<Image> draw(const View& view);

    // "reference", or the Vulkan device's name.
    virtual std::string device() const = 0;
    // What the last load took to copy to the device, in seconds; 0 for the reference renderer.
    virtual double uploadSeconds() const { return 0; }
    // What Vulkan's validation layer has said so far, where openRenderer was asked for it.
    virtual std::vector<std::string> messages() const { return {}; }

    // Gets 0 before each picture and then, from the reference renderer, the share of it that is drawn, up to
    // 1 and from several threads. Where it says to stop, draw returns ErrorKind::stopped.
    Progress progress;
    // Why the reference renderer draws although "auto" was asked for, one line; empty otherwise.
    std::string note;

private:
    virtual Status loadScene(const Scene& scene, bool sameImages) = 0;
    virtual Result<Image> drawLoaded(const View& view) = 0;

    bool loaded_ = false;
    bool holds_ = false; // the last load has worked
};

// Opens a device. `device`: "reference"; "auto" is the best Vulkan device, and the reference renderer where
// there is none (`note` then says why); anything else is a part of a Vulkan device's name, in any case.
// threads: of the reference renderer; 0 means all cores. No picture depends on it. validation: ask for Vulkan's
// validation layer; that it is not installed is the first of the messages then.
// Errors: ErrorKind::unavailable, never for "auto" and "reference".
Result<std::unique_ptr<Renderer>> openRenderer(const std::string& device = "auto", int threads = 0,
                                               bool validation = false);

// ---- exposure ------------------------------------------------------------------------------

// The exposure for a view of the renderer's scene, by what a small picture of it shows without what is behind: the
// logarithms' mean of the brightness of the scene's pixels goes part of the way to a middle grey, so that white stays
// bright and black dark, and the brightest fiftieth stays below what tone curves burn out. Rounded to 1/32 of a stop,
// so that renderers that differ by a rounding agree. 1 where nothing is seen. view.exposure, ground and background are
// not read; drawn with the same curve of tones, so that a device needs no other shaders. Errors: those of
// Renderer::draw.
Result<float> meterExposure(Renderer& renderer, View view);

// ---- cameras as text -----------------------------------------------------------------------

// "fit": the whole scene from the front, a little from above; "front": the same, as near as its vertices allow; both
// frame all of an animation (Scene::reach);
// "left", "right", "top", "bottom", "back": the same from that side, straight on; "orbit:AZIMUTH,ELEVATION": from
// any, in degrees as orbitCamera (cotan/view.hpp) has them, at most 360 around and 90 up or down;
// "0", "1", ...: a camera of the scene; or
// "ex,ey,ez,tx,ty,tz": from the eye e to the target t, in world units, y up (-z where it looks straight up or down),
// with a lens of 45 degrees from bottom to top; a seventh number is another lens in degrees, "h" and a number an
// orthographic camera that is so many world units high; three more are the direction up.
// width, height: of the picture, pixels.
// Errors: ErrorKind::usage, with what was expected and found.
Result<Camera> parseCamera(const std::string& text, const Scene& scene, int width, int height);

// The words of a camera: parseCamera makes the same camera of them, to the bit, but for its name.
std::string formatCamera(const Camera& camera);

// ---- the reference renderer ----------------------------------------------------------------

// Slow and obvious, the judge: draws the scene on the CPU as a GPU would, pixels in 2x2 quads whose helper lanes
// extrapolate the triangle, derivatives as differences inside the quad, clipping against the near plane, the portable
// text in float. The picture is the same, byte for byte, for any number of threads.
// threads: 0 means all cores. progress is called from several threads.
// Translucent materials are composed per sample in the order of their distance, whatever their number
// of layers; of equally far ones the one drawn later is in front.
// Errors: ErrorKind::usage for a view that does not hold together, and for a size over 16384 a side;
// ErrorKind::input over 100 million triangles, instances counted; ErrorKind::unavailable without the memory, or
// where more than 1024 translucent layers a pixel meet in a tile of 32 x 32 pixels.
Result<Image> renderReference(const Scene& scene, const View& view, int threads = 0, const Progress& progress = {});

// ---- the Vulkan renderer -------------------------------------------------------------------

// The Vulkan renderer. Needs the Vulkan loader and GLM, nothing else at run time.

struct VulkanRendererOptions {
    std::string device;      // part of the device's name, any case; empty: the fastest kind found
    bool validation = false; // ask for the validation layer; its messages land in messages()
};

struct RenderTimings { // seconds
    double upload = 0; // of the last load()
    double draw = 0;   // of the last render(): submit to idle
    double readBack = 0;
};

// The names of all devices that can run the renderer, in order of preference.
// Errors: ErrorKind::unavailable says why there is none.
Result<std::vector<std::string>> renderDevices();

class VulkanRenderer {
public:
    // Opens a device. Errors: ErrorKind::unavailable, with the reason (no loader, no driver, no
    // device of that name, a missing feature).
    static Result<VulkanRenderer> create(const VulkanRendererOptions& options = {});

    VulkanRenderer(VulkanRenderer&&) noexcept;
    VulkanRenderer& operator=(VulkanRenderer&&) noexcept;
    ~VulkanRenderer();

    // Uploads a scene; it replaces the one before. Errors: ErrorKind::unavailable when the device
    // has not enough memory; ErrorKind::input over 100 million triangles, instances counted.
    // sameImages: all images are those of the scene before, in its order; their textures stay on the device.
    Status load(const Scene& scene, bool sameImages = false);

    // Draws the loaded scene. Translucent materials are composed per sample in the order of their distance,
    // whatever their number of layers; of equally far ones the one later in the scene is in front. Lists of
    // their fragments take 144 MiB of device memory.
    // Errors: ErrorKind::usage for a size the device cannot draw; ErrorKind::unavailable without the memory,
    // or for more than 2.8 million translucent fragments in one row of pixels.
    Result<Image> render(const View& view);

    const std::string& deviceName() const;
    const std::string& driver() const; // name and version
    const RenderTimings& timings() const;
    const std::vector<std::string>& messages() const; // from the validation layer

private:
    struct State;
    explicit VulkanRenderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace cotan
