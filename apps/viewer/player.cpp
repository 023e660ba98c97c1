#include "player.hpp"

namespace cotan::viewer {

namespace {

constexpr double kPatience = 120; // maximum seconds that a session waits for one image

// Whether the event writes something, which must wait until everything is drawn.
bool writes(const Event& event)
{
    return event.kind == EventKind::command
        && (event.word.starts_with("window") || event.word.starts_with("report") || event.word.starts_with("copy"));
}

} // namespace

Result<Player::Step> Player::step(bool idle, double now)
{
    if (waits_) {
        waitsSince_ = waitsSince_.value_or(now);
        if (!idle)
            return now - *waitsSince_ > kPatience
                ? Result<Step>(unavailableError("view: the replay waited too long for an image"))
                : Step{};
        waits_ = false;
    }
    const bool last = ended(); // wait for the last image
    if (last || events_[next_].kind == EventKind::wait || writes(events_[next_])) {
        waits_ = last || !idle;
        waitsSince_ = now;
        if (last || (waits_ && writes(events_[next_])))
            return Step{};
    }
    const Event& event = events_[next_++];
    Step step{event, event.seconds - playedTo_};
    playedTo_ = event.seconds;
    if (event.kind == EventKind::wait)
        step.event.reset();
    return step;
}

void Player::blame(const std::string& problem)
{
    if (blamed_.empty())
        blamed_ = problem;
}

Status Player::verdict() const { return blamed_.empty() ? Status(Done{}) : Status(inputError(blamed_)); }

} // namespace cotan::viewer
