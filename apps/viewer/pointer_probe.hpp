// What is under the pointer, found on a thread of its own: a large mesh takes a moment.
#pragma once

#include <functional>
#include <future>
#include <string>

#include "state.hpp"

namespace cotan::viewer {

class PointerProbe {
public:
    // done: called on another thread where something was found.
    explicit PointerProbe(std::function<void()> done) : done_(std::move(done)) {}

    // Puts what was found into the state, and looks again where the pointer, the camera, the model or the frame is
    // another.
    void follow(State& state);
    bool busy() const { return finding_.valid(); }

private:
    std::function<void()> done_;
    Prober prober_;
    std::string key_;
    std::future<Probe> finding_;
    std::future<void> running_; // the thread that finds it; last: it uses the others
};

} // namespace cotan::viewer
