#include "session.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/try.hpp"
#include "files/file_registry.hpp"
#include "files/output.hpp"
#include "input.hpp"
#include "player.hpp"
#include "requests.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

double secondsNow()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

namespace {

app::CommonOptions quiet(app::CommonOptions common)
{
    common.quiet = true; // messages are shown in the window
    return common;
}

} // namespace

Parts::Parts(State first, const SessionOptions& o)
    : state(std::move(first)), options(o), loader([this] { waker.wake(); }),
      pictures(quiet(o.common), optionsOf(state, false), [this] { waker.wake(); }), probe([this] { waker.wake(); })
{
}

Interface interfaceNow(const Parts& parts)
{
    Interface i = interfaceOf(parts.state);
    if (i.progress >= 0)
        i.progress = float(std::fmod(secondsNow(), 1.0)); // the remaining time is unknown, so the bar just moves
    return i;
}

namespace {

// What the user quit with.
const char* quitBy(const Event& event)
{
    switch (event.kind) {
    case EventKind::close: return "close button";
    case EventKind::command: return event.seconds < 0 ? "menu" : "command";
    default: return "key";
    }
}

class Session {
public:
    Session(State state, const SessionOptions& options)
        : options_(options), begun_(secondsNow()), parts_(std::move(state), options), player_(options.played)
    {
    }

    Status run()
    {
        state_.requests.push_back(request::Load{state_.picture.model}); // read while the window opens
        beginLoads(parts_);
        watchShown(parts_);
        if (const Status opened = open(); !opened)
            return withoutWindow(opened);
        COTAN_CHECK(beginRecording());
        start_ = last_ = secondsNow();
        parts_.waker.set(parts_.window.get());
        Status done = loop();
        parts_.waker.set(nullptr);
        if (const Status recorded = endRecording(); done)
            done = recorded;
        saveState();
        if (done)
            done = writeReport(options_.common, reportOfTimes());
        return done;
    }

private:
    Status open()
    {
        WindowOptions window;
        window.width = state_.size.x;
        window.height = state_.size.y;
        window.title = "cotan view";
        window.played = options_.plays;
        if (state_.picture.device != "auto" && state_.picture.device != "reference")
            window.device = state_.picture.device;
        COTAN_TRY(opened, openWindow(window));
        parts_.window = std::move(*opened);
        parts_.pictures.drawOn(parts_.window->device());
        windowSeconds_ = secondsNow() - begun_;
        if (options_.plays)
            parts_.window->resize(state_.size.x, state_.size.y);
        return Done{};
    }

    // A model that cannot be read is reported first, even if there is no window.
    Status withoutWindow(Status why)
    {
        while (parts_.loader.busy())
            if (const auto loaded = parts_.loader.take())
                return loaded->error ? Status(*loaded->error) : why; // `finish` reports a refused input instead
            else
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return why;
    }

    Status beginRecording()
    {
        if (options_.record.empty())
            return Done{};
        COTAN_TRY(file, OutputFile::begin(options_.record));
        recording_.emplace(*std::move(file));
        COTAN_TRY(events, recording_->open());
        events_ = *std::move(events);
        record(fmt::format("0.000 resize {} {}", state_.size.x, state_.size.y));
        return Done{};
    }

    // Each line is written at once, so that the events before a crash are in the unfinished file.
    void record(const std::string& line)
    {
        const std::string text = line + "\n";
        unrecorded_ = unrecorded_ || std::fwrite(text.data(), 1, text.size(), events_.get()) != text.size()
            || std::fflush(events_.get()) != 0;
    }

    // The recording appears also if the session failed.
    Status endRecording()
    {
        if (!recording_)
            return Done{};
        if (std::fclose(events_.release()) != 0 || unrecorded_)
            return recording_->failed(
                outputError(fmt::format("{}: cannot be written", recording_->destination().string())));
        return recording_->commit();
    }

    // Data flows in one direction: events, state, requests, results, window.
    Status loop()
    {
        while (!parts_.quits) {
            double passed = 0;
            COTAN_TRY(events, nextEvents(passed));
            handleEvents(*events, passed);
            adoptWindowSize();
            if (const Status done = carryOutRequests(parts_); !done && written_)
                player_.blame(done.error().message);
            while (auto loaded = parts_.loader.take()) {
                const bool first = !std::exchange(loadedFirst_, true);
                if (const auto refused = firstRefusal(); refused && (first || options_.plays))
                    return *refused;
                takeLoaded(std::move(*loaded));
            }
            if (options_.plays && !state_.model && modelError_) // there is nothing to play with
                return *modelError_;
            parts_.pictures.receive(state_, !options_.plays); // played sessions must look the same every time
            parts_.pictures.ask(state_);
            parts_.probe.follow(state_);
            state_.probe.degrees = parts_.pictures.degreesAtPointer(state_);
            COTAN_CHECK(parts_.window->show(interfaceNow(parts_), parts_.pictures.shown(state_)));
            if (firstShown_ == 0 && parts_.pictures.any())
                firstShown_ = secondsNow() - begun_;
            if (options_.plays && player_.ended() && idle())
                parts_.quits = true;
        }
        return player_.verdict();
    }

    bool idle() const
    {
        return !parts_.loader.busy() && state_.requests.empty() && parts_.pictures.idle(state_) && !parts_.dialog.open()
            && !parts_.probe.busy() && !parts_.tool.running();
    }

    // Maximum seconds to wait for events.
    double pause() const
    {
        if (options_.plays)
            return player_.waits() ? 0.01 : 0;
        if (state_.playing || state_.turning || !state_.keysDown.empty())
            return 0.008;
        return parts_.tool.running() ? 0.05 : 0.25;
    }

    Result<std::vector<Event>> nextEvents(double& passed)
    {
        std::vector<Event> events = parts_.window->poll(pause());
        const double now = secondsNow();
        for (Event& event : events)
            event.seconds = event.seconds < 0 ? event.seconds : now - start_;
        passed = now - last_;
        last_ = now;
        if (options_.plays) {
            COTAN_TRY(step, player_.step(idle(), now));
            passed = step->passed;
            if (step->event)
                events.push_back(std::move(*step->event));
        }
        for (const Event& event : events)
            if (recording_ && event.seconds >= 0) // commands chosen in the interface follow from the clicks
                record(toText(event));
        return events;
    }

    void handleEvents(const std::vector<Event>& events, double passed)
    {
        written_ = false;
        for (const Event& event : parts_.window->interact(interfaceNow(parts_), events)) {
            const std::string before = state_.problem;
            apply(state_, event);
            written_ = event.kind == EventKind::command && event.seconds >= 0; // not from a menu
            if (written_ && state_.problem != before)
                player_.blame(state_.problem);
            if (ended_.empty() && std::ranges::any_of(state_.requests, [](const Request& r) {
                    return std::holds_alternative<request::Quit>(r);
                }))
                ended_ = quitBy(event);
        }
        advance(state_, passed);
    }

    void adoptWindowSize()
    {
        const glm::ivec2 now = parts_.window->size();
        if (now.x < 1 || now.y < 1 || now == state_.size)
            return;
        state_.size = now;
        if (!state_.cameraMoved)
            resetCamera(state_);
    }

    void takeLoaded(Loaded loaded)
    {
        loadSeconds_ = loadSeconds_ > 0 ? loadSeconds_ : loaded.seconds;
        if (!parts_.loader.reading()) {
            state_.loading.clear();
            state_.progress = -1;
        }
        take(state_, loaded);
        if (loaded.error && options_.plays && !state_.model)
            modelError_ = loaded.error;
        else if (loaded.error)
            app::warn(options_.common, loaded.error->message);
        for (const std::string& fault : loaded.faults)
            app::warn(options_.common, fault);
        if (!loaded.model || loaded.posed)
            return;
        const std::string& file = state_.picture.model;
        parts_.window->setTitle(fmt::format("{} - cotan view", file.empty() ? std::string("cotan") : fileName(file)));
        for (const std::string& line : loaded.model->scene.warnings)
            app::warn(options_.common, line);
    }

    Json reportOfTimes() const
    {
        return {{"command", "view"},
                {"device", state_.device},
                {"images_drawn", state_.pictures},
                {"images_read", parts_.window->imagesRead()}, // from the device
                {"loads", state_.loads},
                {"failed_loads", state_.failedLoads},
                {"ended", ended_.empty() ? "last event" : ended_},
                {"events_played", player_.played()},
                {"seconds",
                 {{"window", windowSeconds_},
                  {"load", loadSeconds_},
                  {"first_image", parts_.pictures.firstSeconds()},
                  {"first_shown", firstShown_}}}};
    }

    void saveState() const
    {
        if (options_.memory.empty())
            return;
        std::error_code error;
        fs::create_directories(options_.memory.parent_path(), error);
        (void)writeFileWhole(options_.memory, memoryOf(state_)); // the next start then has the defaults
    }

    const SessionOptions& options_;
    double begun_ = 0;
    Parts parts_;
    State& state_ = parts_.state;
    Player player_;
    std::optional<OutputFile> recording_;
    OpenFile events_;         // the recording, open
    bool unrecorded_ = false; // events_ could not be written
    bool loadedFirst_ = false;
    double start_ = 0, last_ = 0, windowSeconds_ = 0, loadSeconds_ = 0, firstShown_ = 0;
    std::optional<Error> modelError_; // error of the first model
    bool written_ = false;            // the current event is a written command
    std::string ended_;               // what ended the session; empty: nothing yet
};

} // namespace

Status runSession(State state, const SessionOptions& options) { return Session(std::move(state), options).run(); }

} // namespace cotan::viewer
