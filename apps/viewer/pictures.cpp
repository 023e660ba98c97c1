#include "pictures.hpp"

#include <utility>

#include <fmt/format.h>

#include "cotan/inspect.hpp"
#include "inspect/angles.hpp"

namespace cotan::viewer {

namespace {

// Everything that an image depends on, except the metered exposure.
std::string keyOf(const State& s)
{
    State other = s;
    other.metered = 0;
    other.compare = Compare::flip;
    other.picture.animation.clear(); // the model that is drawn already has its pose
    other.picture.time = 0;
    std::string key;
    for (const bool second : {false, true}) {
        other.second = second;
        key += commandLine(other, "", s.size) + "\n";
    }
    return key
        + fmt::format("{} {} {} {} {} {} {}", int(s.compare), s.second && s.compare == Compare::flip, s.show,
                      inMotion(s), s.statisticsShown, s.model ? s.model->number : 0,
                      s.highModel ? s.highModel->number : 0);
}

} // namespace

Pictures::Pictures(app::CommonOptions common, PictureOptions first, std::function<void()> done)
    : renderThread_(std::move(common), std::move(first), std::move(done))
{
}

void Pictures::ask(const State& state)
{
    if (!state.model || state.size.x < 1 || state.size.y < 1)
        return;
    const std::string key = keyOf(state);
    const bool meter = state.metered == 0 && showsLight(state.show) && meters(optionsOf(state, false))
        && !renderThread_.busy() && !failed_; // a failed order would fail again
    if (key == key_ && !meter)
        return;
    key_ = key;
    Order order = orderOf(state);
    order.number = ++orders_;
    renderThread_.ask(std::move(order));
}

void Pictures::receive(State& state, bool timed)
{
    auto drawn = renderThread_.take();
    if (!drawn)
        return;
    state.device = drawn->device.empty() ? state.device : drawn->device;
    failed_ = !drawn->problem.empty();
    if (failed_) {
        state.problem = state.drawProblem = drawn->problem;
        failedAtLoads_ = state.loads;
        revert(state);
    } else if (drawn->picture) {
        // Redrawing the last valid state must not clear the error; a reload of the file may.
        if (state.loads != failedAtLoads_ && state.problem == std::exchange(state.drawProblem, {}))
            state.problem.clear();
        lastGood_ = {true, state.picture, state.show, state.a, state.b};
    }
    if (drawn->picture && !(drawn->picture == drawn_.picture)) {
        firstSeconds_ = firstSeconds_ > 0 ? firstSeconds_ : drawn->seconds;
        ++state.pictures;
        state.drawSeconds = timed ? drawn->seconds : 0;
        state.metered = drawn->exposure > 0 ? drawn->exposure : state.metered;
    }
    if (!drawn->hasFigures && !drawn->draft && !state.statisticsOf.empty() && drawn->degrees.empty()
        && replacesMaterials(state.show))
        state.statisticsOf.clear();
    if (drawn->hasFigures) {
        state.statistics = drawn->statistics;
        state.statisticsOf = drawn->statisticsOf;
        figures_ = {{drawn->view.width, drawn->view.height}, std::move(drawn->degrees)};
    } else if (drawn->picture && !drawn->draft) {
        figures_ = {};
    }
    if (drawn->picture)
        drawn_ = std::move(*drawn);
}

// Reverts what could not be drawn: an unreadable environment or map, or a convention that does not fit.
void Pictures::revert(State& state) const
{
    if (!lastGood_.any)
        return;
    const PictureOptions now = std::exchange(state.picture, lastGood_.picture);
    state.picture.model = now.model;
    state.picture.shape = now.shape;
    state.picture.variant = now.variant;
    state.picture.animation = now.animation;
    state.picture.time = now.time;
    state.picture.camera = now.camera;
    state.show = lastGood_.show;
    state.a = lastGood_.a;
    state.b = lastGood_.b;
}

bool Pictures::idle(const State& state) const
{
    return !renderThread_.busy() && (!state.model || key_ == keyOf(state));
}

Shown Pictures::shown(const State& state) const
{
    return {drawn_.picture, state.compare == Compare::divider ? drawn_.other : Drawing(),
            state.divider * float(state.size.x)};
}

float Pictures::degreesAtPointer(const State& state) const
{
    const glm::ivec2 at(state.pointer), size = figures_.size;
    const bool inside = at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y;
    return inside && size == state.size ? figures_.degrees[std::size_t(at.y) * std::size_t(size.x) + std::size_t(at.x)]
                                        : -1.0f;
}

} // namespace cotan::viewer
