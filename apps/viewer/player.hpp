// Hands out the events of a played session, each when what came before it is drawn where it asks for that.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "event.hpp"

namespace cotan::viewer {

class Player {
public:
    explicit Player(const std::vector<Event>& events) : events_(events) {}

    struct Step {
        std::optional<Event> event;
        double passed = 0; // seconds of the session since the step before
    };
    // idle: all that was asked for is drawn. now: seconds of any clock that goes on. Errors: ErrorKind::unavailable
    // where it was not idle for two minutes.
    Result<Step> step(bool idle, double now);

    bool waits() const { return waits_; }
    bool ended() const { return next_ == events_.size(); }
    std::size_t played() const { return next_; } // events

    // What a played command could not do: the first of them is how the session ends.
    void blame(const std::string& problem);
    Status verdict() const;

private:
    const std::vector<Event>& events_;
    std::size_t next_ = 0;
    double playedTo_ = 0;                // seconds
    std::optional<double> waitsSince_{}; // likewise
    bool waits_ = true;                  // for the first picture: what is done before it would be done to nothing
    std::string blamed_;
};

} // namespace cotan::viewer
