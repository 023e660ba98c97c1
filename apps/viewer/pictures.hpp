// Orders images of the state from the render thread and puts the results into the state.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render_thread.hpp"
#include "state.hpp"
#include "window.hpp"

namespace cotan::viewer {

class Pictures {
public:
    // Parameters as for RenderThread.
    Pictures(app::CommonOptions common, PictureOptions first, std::function<void()> done);

    // The device of the window, which draws the images for it. Call before the first ask().
    void drawOn(std::shared_ptr<Device> device) { renderThread_.drawOn(std::move(device)); }

    // Orders an image if the state differs from that of the last order.
    void ask(const State& state);
    // Puts what was drawn since the last call into the state. If drawing failed, stores the error in state.problem and
    // reverts the state to the last one that could be drawn. timed: also store the drawing time in the state.
    void receive(State& state, bool timed);
    // Whether everything that the state shows is drawn.
    bool idle(const State& state) const;

    // The last image drawn, for the window.
    Shown shown(const State& state) const;
    // The angle of the displayed image at the pointer; negative: none.
    float degreesAtPointer(const State& state) const;
    // Draws an image for a file, independent of other orders; waits for the result.
    Result<Image> drawNow(const Order& order, bool floats) { return renderThread_.drawNow(order, floats); }

    bool any() const { return bool(drawn_.picture); }
    double firstSeconds() const { return firstSeconds_; } // drawing time of the first image

private:
    RenderThread renderThread_;
    Drawn drawn_;
    struct {
        bool any = false;
        PictureOptions picture;
        std::string show;
        Side a, b;
    } lastGood_; // state of the last image that could be drawn
    struct {
        glm::ivec2 size{0};
        std::vector<float> degrees;
    } figures_; // of the displayed image
    std::string key_;
    std::uint64_t orders_ = 0;
    double firstSeconds_ = 0;
    bool failed_ = false;
    std::size_t failedAtLoads_ = 0; // State::loads at the last failure

    void revert(State& state) const;
};

} // namespace cotan::viewer
