// Something that draws: a Vulkan device or the reference renderer.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cotan/result.hpp"
#include "cotan/scene/view.hpp"

namespace cotan::app {

class Painter {
public:
    virtual ~Painter() = default;
    virtual Status load(const Scene& scene) = 0; // the scene must outlive the painter
    Result<Image> draw(const View& view)
    {
        if (progress)
            progress(0);
        return drawView(view);
    }
    virtual std::string device() const = 0;
    virtual double uploadSeconds() const { return 0; }

    std::function<void(double)> progress; // gets 0 before each picture, and its share as far as that is known

private:
    virtual Result<Image> drawView(const View& view) = 0;
};

// `device`: "reference", a part of a Vulkan device's name, or "auto": the best Vulkan device, and
// the reference renderer where there is none (`note` then says why).
// Errors: ErrorKind::unavailable.
Result<std::unique_ptr<Painter>> openPainter(const std::string& device, int threads, std::string& note);

} // namespace cotan::app
