// Finds the surface under the pointer on another thread, because it takes a moment for large meshes.
#pragma once

#include <functional>
#include <future>
#include <string>

#include "state.hpp"

namespace cotan::viewer {

class PointerProbe {
public:
    // done: called on another thread when a result is available.
    explicit PointerProbe(std::function<void()> done) : done_(std::move(done)) {}

    // Puts the last result into the state, and starts a new search if the pointer, the camera, the model or the frame
    // has changed.
    void follow(State& state);
    bool busy() const { return finding_.valid(); }

private:
    std::function<void()> done_;
    Prober prober_;
    std::string key_;
    std::future<Probe> finding_;
    std::future<void> running_; // the searching thread; declared last, because it uses the others
};

} // namespace cotan::viewer
