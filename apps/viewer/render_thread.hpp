// Draws what the state asks for, on a thread of its own: the interface never waits for a picture.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "state.hpp"

namespace cotan::viewer {

// What is to be drawn: copied from the state.
struct Order {
    std::uint64_t number = 0; // ascending
    PictureOptions first, second;
    Side a, b;
    std::string show = "shaded";
    Compare compare = Compare::off;
    bool flipped = false;
    std::shared_ptr<const Model> model;
    float exposure = 0;      // for "auto": what was found before; 0: find it
    std::string meteredFrom; // from this camera, in words
    bool draft = false;      // smaller, and without figures, if pictures take long
    bool figures = false;
};

struct Drawn {
    std::uint64_t number = 0;
    std::shared_ptr<const Image> picture, other; // 8 bits; other: of a divider
    View view;                                   // that the first was drawn with
    float exposure = 0;                          // that was found for "auto"; 0: it was not asked for
    std::string device, problem;                 // a problem comes without a picture
    double seconds = 0;
    bool draft = false;
    // Figures, which come later than the picture; degrees has an entry a pixel, or is empty.
    bool hasFigures = false;
    std::vector<float> degrees;
    AngleStatistics statistics;
    std::string statisticsOf;
};

// The order for a state; draft: while the camera moves.
Order orderOf(const State& state);

class RenderThread {
public:
    // first: what will be asked for; its device and environment are opened while the model is still being read.
    // validation: with Vulkan's validation layer. done: called on the render thread where something new can be taken.
    RenderThread(app::CommonOptions common, PictureOptions first, bool validation, std::function<void()> done);
    ~RenderThread();

    // Draws this next; an order that waits is dropped.
    void ask(Order order);
    // What was drawn last, once.
    std::optional<Drawn> take();
    bool busy() const; // something was asked for and is not drawn yet

    // A picture for a file, whatever is drawn meanwhile; waits for it. floats: as for a file that keeps them.
    Result<Image> drawNow(const Order& order, bool floats);

    // Ends its work. Returns what the validation layer has said.
    std::vector<std::string> finish();

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
