// Something that draws: a Vulkan device or the reference renderer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/progress.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

// A device that is open. Made by openPainter; for one picture there is drawView (cotan/draw/draw.hpp).
// One thread at a time.
class Painter {
public:
    virtual ~Painter() = default;

    // Takes a scene in the place of the one before. It must live until the next load, forget or the
    // painter's end. Frames from vertices read what deriveVertexFrames (cotan/surface/vertex_frames.hpp)
    // has put into it; without that draw() refuses them.
    // Errors: ErrorKind::input for a scene that does not hold together (checkScene), and over kMostTrianglesDrawn
    // (cotan/scene/bounds.hpp) of a Vulkan device; the reference renderer says that in draw. ErrorKind::unavailable
    // when the device has not enough memory.
    // sameImages: all images are those of the scene that was loaded before, in its order (another moment of an
    // animation, say); what was made of them is kept. Where that load failed, everything is made again.
    Status load(const Scene& scene, bool sameImages = false);

    // The painter has no scene from here on.
    void forget() { loaded_ = false; }

    // A picture of the loaded scene. Errors: ErrorKind::usage without a scene, for a size that cannot be
    // drawn (the reference renderer: 1 to 16384 pixels a side), an unknown frame, or one that reads what the scene
    // lacks at its vertices; ErrorKind::unavailable without the memory; those of Renderer::render and renderReference.
    Result<Image> draw(const View& view);

    // "reference", or the Vulkan device's name.
    virtual std::string device() const = 0;
    // What the last load took to copy to the device, in seconds; 0 for the reference renderer.
    virtual double uploadSeconds() const { return 0; }
    // What Vulkan's validation layer has said so far, where openPainter was asked for it.
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
Result<std::unique_ptr<Painter>> openPainter(const std::string& device = "auto", int threads = 0,
                                             bool validation = false);

} // namespace cotan
