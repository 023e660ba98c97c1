// Hands out the events of a played session, waiting for drawing to finish where necessary.
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
        double passed = 0; // seconds of session time since the previous step
    };
    // idle: everything requested is drawn. now: seconds of any clock that never goes back. Errors:
    // ErrorKind::unavailable if `idle` was false for two minutes.
    Result<Step> step(bool idle, double now);

    bool waits() const { return waits_; }
    bool ended() const { return next_ == events_.size(); }
    std::size_t played() const { return next_; } // number of events

    // Records the error of a played command. The first one is the result of the session.
    void blame(const std::string& problem);
    Status verdict() const;

private:
    const std::vector<Event>& events_;
    std::size_t next_ = 0;
    double playedTo_ = 0;                // seconds
    std::optional<double> waitsSince_{}; // seconds
    bool waits_ = true;                  // starts by waiting for the first image; earlier commands would do nothing
    std::string blamed_;
};

} // namespace cotan::viewer
