// Draws images of the state on its own thread, so that the interface never waits.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "state.hpp"
#include "window.hpp"

namespace cotan::viewer {

// What to draw, copied from the state.
struct Order {
    std::uint64_t number = 0; // ascending
    PictureOptions first, second;
    Side a, b;
    Compare compare = Compare::off;
    bool flipped = false;
    std::shared_ptr<const Model> model, highModel;
    float exposure = 0;      // the metered exposure for "auto"; 0: meter it
    std::string meteredFrom; // camera to meter from, as text
    bool draft = false;      // if drawing is slow, draw smaller and without figures
    bool figures = false;
};

struct Drawn {
    std::uint64_t number = 0;
    Drawing picture, other;      // other: right side of a divider
    View view;                   // of `picture`
    float exposure = 0;          // metered for "auto"; 0: not requested
    std::string device, problem; // if there is a problem, there is no image
    double seconds = 0;
    bool draft = false;
    // Figures, which arrive later than the image; degrees has one entry per pixel, or is empty.
    bool hasFigures = false;
    std::vector<float> degrees;
    AngleStatistics statistics;
    std::string statisticsOf;
};

// The order for a state; a draft while the camera moves or an animation plays.
Order orderOf(const State& state);

class RenderThread {
public:
    // first: the expected options; their environment is opened while the model is still being read. done: called on the
    // render thread when take() has a result.
    RenderThread(app::CommonOptions common, PictureOptions first, std::function<void()> done);
    ~RenderThread();

    // The device of the window, which draws the images for it. Call before the first order.
    void drawOn(std::shared_ptr<Device> device);
    // Draws this order next; replaces a waiting order.
    void ask(Order order);
    // Returns the last result, once.
    std::optional<Drawn> take();
    bool busy() const; // there are orders or results that were not taken yet

    // Draws an image for a file, independent of other orders, and waits. floats: for a file with float values.
    Result<Image> drawNow(const Order& order, bool floats);

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
