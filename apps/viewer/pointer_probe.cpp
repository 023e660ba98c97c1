#include "pointer_probe.hpp"

#include <fmt/format.h>

#include "cotan/render.hpp"
#include "parse.hpp"
#include "picture/option_words.hpp"

namespace cotan::viewer {

void PointerProbe::follow(State& state)
{
    if (finding_.valid()) {
        if (finding_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        state.probe = finding_.get();
    }
    if (!state.cardShown || !state.model || !state.held.empty() || state.pointer.x < 0) {
        state.probe = {};
        key_.clear();
        return;
    }
    const bool right = state.compare == Compare::divider && state.pointer.x > state.divider * float(state.size.x);
    const bool second = (state.compare == Compare::flip && state.second) || (right && state.b.high);
    const Side side = sideOf(state, second);
    const std::shared_ptr<const Model>& shown = side.high ? state.highModel : state.model;
    const std::string key = fmt::format("{} {} {} {} {} {}", state.pointer.x, state.pointer.y,
                                        formatCamera(state.camera), shown->number, side.frame, int(side.tangents));
    if (key == key_)
        return;
    key_ = key;
    const auto look = [this, model = shown, camera = state.camera, size = state.size, pointer = state.pointer, side,
                       picture = side.high ? optionsOf(state, second) : state.picture] {
        Probe probe;
        probe.hit = pick(model->scene, camera, size, pointer + glm::vec2(0.5f));
        if (!probe.hit)
            return probe;
        const auto frame = chosenFrame(*parseFrameChoice(side.frame), picture, model->scene);
        const Mesh& mesh = model->scene.meshes[std::size_t(probe.hit->mesh)];
        probe.surface = prober_.at(model->scene, model->number, *probe.hit,
                                   frame.value_or(mesh.readWith.value_or(Frame{})), side.tangents);
        return probe;
    };
    std::promise<Probe> found;
    finding_ = found.get_future();
    running_ = std::async(std::launch::async, [this, look, found = std::move(found)]() mutable {
        try {
            found.set_value(look());
        } catch (...) {
            found.set_exception(std::current_exception());
        }
        done_(); // after the result is set, so that the woken thread finds it
    });
}

} // namespace cotan::viewer
