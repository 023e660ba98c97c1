// What asks the renderer: one picture after another of what the state shows, and what comes back.
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
    // As for RenderThread.
    Pictures(app::CommonOptions common, PictureOptions first, bool validation, std::function<void()> done);

    // Orders a picture where the state shows something else than the last order.
    void ask(const State& state);
    // Puts what was drawn since the last call into the state. What cannot be drawn becomes state.problem, and the state
    // goes back to what could be. timed: how long it took goes into the state, too.
    void receive(State& state, bool timed);
    // All that the state shows was drawn.
    bool idle(const State& state) const;

    // What was drawn last, for the window; until the next receive().
    Shown shown(const State& state) const;
    // Of the picture that is shown, at the pointer; below 0: none.
    float degreesAtPointer(const State& state) const;
    // A picture for a file, whatever is drawn meanwhile; waits for it.
    Result<Image> drawNow(const Order& order, bool floats) { return renderThread_.drawNow(order, floats); }

    std::vector<std::string> finish() { return renderThread_.finish(); }

    bool any() const { return drawn_.picture != nullptr; }
    double firstSeconds() const { return firstSeconds_; } // that the first picture took

private:
    RenderThread renderThread_;
    Drawn drawn_;
    struct {
        bool any = false;
        PictureOptions picture;
        Side a, b;
    } good_; // of the last picture that could be drawn
    struct {
        glm::ivec2 size{0};
        std::vector<float> degrees;
    } figures_; // of the picture that is shown
    std::string key_;
    std::uint64_t serial_ = 0, orders_ = 0;
    double firstSeconds_ = 0;
    bool failed_ = false;
    std::size_t failedAtLoads_ = 0; // State::loads when it last failed

    void goBack(State& state) const;
};

} // namespace cotan::viewer
