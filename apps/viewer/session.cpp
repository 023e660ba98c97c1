#include "session.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include <fmt/format.h>

#include "artist.hpp"
#include "commands.hpp"
#include "cotan/draw/camera_words.hpp"
#include "cotan/image/file.hpp"
#include "cotan/inspect/inspection.hpp"
#include "dialog.hpp"
#include "files.hpp"
#include "input.hpp"
#include "loader.hpp"
#include "parse.hpp"
#include "settings.hpp"
#include "window.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

constexpr double kPatience = 120; // seconds that a played session waits for one picture

double secondsNow()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What a picture depends on, but for the exposure that was found.
std::string keyOf(const State& s)
{
    State other = s;
    other.metered = 0;
    other.compare = Compare::flip;
    std::string key;
    for (const bool second : {false, true}) {
        other.second = second;
        key += commandLine(other, "", s.size) + "\n";
    }
    return key
        + fmt::format("{} {} {} {} {} {}", int(s.compare), s.second && s.compare == Compare::flip, s.show, s.moving,
                      s.statisticsShown, s.model ? s.model->number : 0);
}

// A name that is not there yet: picture-1.png and so on.
fs::path freeName(const std::string& stem, const std::string& ending)
{
    std::error_code error;
    for (int i = 1;; ++i)
        if (fs::path file = fmt::format("{}-{}{}", stem, i, ending); !fs::exists(file, error))
            return file;
}

class Session {
public:
    Session(State state, const SessionOptions& options) : state_(std::move(state)), options_(options) {}

    Status run()
    {
        WindowOptions window;
        window.width = state_.size.x;
        window.height = state_.size.y;
        window.title = "cotan view";
        window.validation = options_.validation;
        window.played = options_.plays;
        if (state_.picture.device != "auto" && state_.picture.device != "reference")
            window.device = state_.picture.device;
        begun_ = secondsNow();
        app::CommonOptions quiet = options_.common;
        quiet.quiet = true; // what is to be said is said in the window
        loader_.emplace([this] { wake(); });
        artist_.emplace(quiet, optionsOf(state_, false), [this] { wake(); });
        state_.wishes.push_back({Wish::Kind::load, state_.picture.model, {}}); // read while the window opens
        loadWished();
        auto opened = openWindow(window);
        if (!opened)
            return opened.error();
        window_ = std::move(*opened);
        windowSeconds_ = secondsNow() - begun_;
        if (options_.plays)
            window_->resize(state_.size.x, state_.size.y);
        if (!options_.record.empty()) {
            recording_.open(options_.record);
            if (!recording_)
                return outputError(fmt::format("{}: cannot be written", options_.record.string()));
            recording_ << fmt::format("0.000 resize {} {}\n", state_.size.x, state_.size.y);
        }
        start_ = last_ = secondsNow();
        Status done = loop();
        if (done && recording_.is_open() && !recording_.flush())
            done = outputError(fmt::format("{}: cannot be written", options_.record.string()));
        {
            const std::lock_guard lock(waking_);
            wakes_ = nullptr;
        }
        remember();
        if (done)
            if (const Status written = writeReport(options_.common, reportOfTimes()); !written)
                return written;
        if (done && options_.validation && !window_->messages().empty())
            return unavailableError("validation: " + window_->messages()[0]);
        return done;
    }

private:
    void wake()
    {
        const std::lock_guard lock(waking_);
        if (wakes_)
            wakes_->wake();
    }

    Status loop()
    {
        {
            const std::lock_guard lock(waking_);
            wakes_ = window_.get();
        }
        while (!quits_) {
            std::vector<Event> events = window_->poll(pause());
            const double now = secondsNow();
            for (Event& event : events)
                event.seconds = event.seconds < 0 ? event.seconds : now - start_;
            double passed = now - last_;
            last_ = now;
            if (options_.plays) {
                passed = 0;
                if (const Status played = play(events, passed); !played)
                    return played;
            }
            for (const Event& event : events)
                if (recording_ && event.seconds >= 0) // what is chosen in the interface follows from the clicks
                    recording_ << toText(event) << '\n';
            for (const Event& event : window_->interact(interface(), events)) {
                const std::string before = state_.problem;
                apply(state_, event);
                written_ = event.kind == EventKind::command && event.seconds >= 0; // not from a menu
                if (options_.plays && written_ && firstProblem_.empty() && state_.problem != before)
                    firstProblem_ = state_.problem;
            }
            goOn(state_, passed);
            fitWindow();
            if (const Status done = fulfil(); !done)
                return done;
            receive();
            ask();
            probe();
            if (const Status shown = window_->show(interface(), shownNow()); !shown)
                return shown;
            if (firstShown_ == 0 && drawn_.picture)
                firstShown_ = secondsNow() - begun_;
            if (options_.plays && next_ == options_.played.size() && idle())
                quits_ = true;
        }
        return firstProblem_.empty() ? Status(Done{}) : Status(inputError(firstProblem_));
    }

    // Seconds to wait for events.
    double pause() const
    {
        if (options_.plays)
            return waits_ ? 0.01 : 0;
        return state_.playing || !state_.keysDown.empty() ? 0.008 : 0.25;
    }

    bool idle() const
    {
        return !loader_->busy() && !artist_->busy() && state_.wishes.empty() && (!state_.model || key_ == keyOf(state_))
            && !dialog_.open() && !probing_.valid();
    }

    // The next of the played events, unless one waits.
    Status play(std::vector<Event>& events, double& passed)
    {
        if (waits_) {
            if (!idle()) {
                if (secondsNow() - waitsSince_ > kPatience)
                    return unavailableError("view: a played session waited too long for a picture");
                return Done{};
            }
            waits_ = false;
        }
        if (next_ >= options_.played.size()) {
            waits_ = true; // for the last picture
            waitsSince_ = secondsNow();
            return Done{};
        }
        const Event& event = options_.played[next_++];
        passed = event.seconds - playedTo_;
        playedTo_ = event.seconds;
        // What is written is what is drawn by then.
        const bool writes = event.kind == EventKind::command
            && (event.word.starts_with("window") || event.word.starts_with("report") || event.word.starts_with("copy"));
        if (event.kind == EventKind::wait || writes) {
            waits_ = !idle();
            waitsSince_ = secondsNow();
            if (waits_ && writes) {
                --next_;
                passed = 0;
                return Done{};
            }
        }
        if (event.kind != EventKind::wait)
            events.push_back(event);
        return Done{};
    }

    Interface interface() const
    {
        Interface i = interfaceOf(state_);
        if (i.progress >= 0)
            i.progress = float(std::fmod(secondsNow(), 1.0)); // nobody knows how long it takes: it runs
        return i;
    }

    void fitWindow()
    {
        const glm::ivec2 now = window_->size();
        if (now.x < 1 || now.y < 1 || now == state_.size)
            return;
        state_.size = now;
        if (!state_.cameraMoved)
            resetCamera(state_);
    }

    // ---- wishes ----------------------------------------------------------------------------------

    void loadWished()
    {
        std::vector<Wish> others;
        for (Wish& w : state_.wishes)
            if (w.kind == Wish::Kind::load) {
                PictureOptions options = state_.picture;
                options.model = w.text;
                if (!w.text.empty())
                    options.shape.clear();
                if (w.text != state_.picture.model) { // another model has other animations
                    options.variant.clear();
                    options.animation.clear();
                    options.time = 0;
                }
                loader_->read(options);
                state_.loading = w.text.empty() ? "the scene" : fs::path(w.text).filename().string();
                state_.progress = 0;
            } else
                others.push_back(std::move(w));
        state_.wishes = std::move(others);
    }

    Status fulfil()
    {
        loadWished();
        for (Wish& w : std::exchange(state_.wishes, {})) {
            const Status done = fulfilOne(w);
            if (!done) {
                state_.problem = done.error().message;
                if (options_.plays && written_ && firstProblem_.empty())
                    firstProblem_ = state_.problem;
            }
        }
        if (const std::string chosen = dialog_.take(); !chosen.empty())
            apply(state_, {0, EventKind::drop, 0, 0, chosen});
        if (watch_.changed(secondsNow()) && !state_.picture.model.empty())
            state_.wishes.push_back({Wish::Kind::load, state_.picture.model, {}});
        return Done{};
    }

    Status fulfilOne(const Wish& w)
    {
        switch (w.kind) {
        case Wish::Kind::writeFile: return writePicture(w);
        case Wish::Kind::writeWindow: {
            if (const Status shown = window_->show(interface(), shownNow()); !shown)
                return shown;
            const auto picture = window_->read();
            return picture ? writeImage(w.text, *picture) : Status(picture.error());
        }
        case Wish::Kind::writeReport: {
            std::ofstream file(w.text, std::ios::binary);
            file << reportOf(state_);
            return file.flush() ? Status(Done{}) : Status(outputError(w.text + ": cannot be written"));
        }
        case Wish::Kind::copy:
            window_->setClipboard(w.text);
            state_.said = "copied: " + w.text;
            if (options_.plays)
                app::say(options_.common, w.text);
            break;
        case Wish::Kind::paste: {
            const std::string path = pathOf(window_->clipboard());
            return path.empty()
                ? Status(usageError("paste: expected the path of a file to have been copied; found none"))
                : perform(state_, "drop " + path);
        }
        case Wish::Kind::chooseFile: return dialog_.ask(state_.picture.model);
        case Wish::Kind::resize: window_->resize(w.size.x, w.size.y); break;
        case Wish::Kind::loseSurface: window_->loseSurface(); break;
        case Wish::Kind::findHotSpots:
            if (state_.model)
                loader_->findHotSpots(state_.model);
            break;
        case Wish::Kind::quit: quits_ = true; break;
        case Wish::Kind::load: break;
        }
        return Done{};
    }

    Status writePicture(const Wish& w)
    {
        if (!state_.model)
            return usageError("picture: expected a model; found none");
        const bool named = !w.text.empty() && w.text != "-" && w.text != ".exr";
        const fs::path file = named ? fs::path(w.text) : freeName("cotan-picture", w.text == ".exr" ? ".exr" : ".png");
        State wanted = state_;
        wanted.size = w.size.x > 0 ? w.size : state_.size;
        wanted.moving = false;
        if (wanted.compare == Compare::divider)
            wanted.compare = Compare::off;
        const bool floats = keepsFloats(file);
        Order order = orderOf(wanted);
        if (floats && wanted.show == "shaded")
            order.first.use = order.second.use = PictureUse::radiance;
        const auto image = artist_->drawNow(order, floats);
        if (!image)
            return app::inWords(image.error());
        if (Status done = writeImage(file, *image); !done)
            return done;
        const std::string command = commandLine(wanted, file.string(), wanted.size);
        state_.said = command;
        app::say(options_.common, command);
        return Done{};
    }

    // ---- what comes back -------------------------------------------------------------------------

    void receive()
    {
        if (auto loaded = loader_->take()) {
            if (loaded->hotSpots)
                state_.hotSpots = std::move(loaded->hotSpots);
            else
                takeModel(*loaded);
        }
        if (auto drawn = artist_->take()) {
            state_.device = drawn->device.empty() ? state_.device : drawn->device;
            if (!drawn->problem.empty()) {
                state_.problem = drawn->problem;
                goBack();
            } else if (drawn->picture) {
                good_ = {true, state_.picture, state_.a, state_.b};
            }
            failed_ = !drawn->problem.empty();
            if (drawn->picture && drawn->picture != drawn_.picture) {
                ++serial_;
                firstPicture_ = firstPicture_ > 0 ? firstPicture_ : drawn->seconds;
                ++state_.pictures;
                state_.drawSeconds = options_.plays ? 0 : drawn->seconds; // played sessions look the same every time
                state_.metered = drawn->exposure > 0 ? drawn->exposure : state_.metered;
            }
            if (!drawn->hasFigures && !drawn->draft && !state_.statisticsOf.empty() && drawn->degrees.empty()
                && inspectionFromName(state_.show))
                state_.statisticsOf.clear();
            if (drawn->hasFigures) {
                state_.statistics = drawn->statistics;
                state_.statisticsOf = drawn->statisticsOf;
                figures_ = {{drawn->view.width, drawn->view.height}, std::move(drawn->degrees)};
            } else if (drawn->picture && !drawn->draft) {
                figures_ = {};
            }
            if (drawn->picture)
                drawn_ = std::move(*drawn);
        }
    }

    // What could not be drawn is left: a light or a map that cannot be read, a convention that does not fit.
    void goBack()
    {
        if (!good_.any)
            return;
        const PictureOptions now = std::exchange(state_.picture, good_.picture);
        state_.picture.model = now.model;
        state_.picture.shape = now.shape;
        state_.picture.variant = now.variant;
        state_.picture.animation = now.animation;
        state_.picture.time = now.time;
        state_.picture.camera = now.camera;
        state_.a = good_.a;
        state_.b = good_.b;
    }

    void takeModel(Loaded& loaded)
    {
        if (!loader_->busy()) {
            state_.loading.clear();
            state_.progress = -1;
        }
        if (!loaded.model) { // the last one stays
            ++state_.failedLoads;
            state_.problem = loaded.problem;
            if (!options_.common.quiet)
                app::warn(options_.common, loaded.problem);
            return;
        }
        ++state_.loads;
        loadSeconds_ = loadSeconds_ > 0 ? loadSeconds_ : loaded.seconds;
        const bool other = !state_.model || loaded.options.model != state_.picture.model
            || loaded.options.shape != state_.picture.shape;
        state_.picture.model = loaded.options.model;
        state_.picture.shape = loaded.options.shape;
        state_.picture.variant = loaded.options.variant;
        state_.picture.animation = loaded.options.animation;
        if (!state_.playing)
            state_.picture.time = loaded.options.time;
        state_.model = loaded.model;
        state_.hotSpots.reset();
        if (state_.hotSpotsShown)
            state_.wishes.push_back({Wish::Kind::findHotSpots, {}, {}});
        state_.statisticsOf.clear();
        if (other || !state_.cameraMoved) {
            if (state_.loads > 1 && other) {
                state_.picture.camera.clear();
                state_.meteredFrom.clear();
                state_.metered = 0;
            }
            resetCamera(state_);
        }
        if (other && !loaded.options.model.empty()) {
            const std::string file = fs::absolute(loaded.options.model).lexically_normal().string();
            std::erase(state_.recent, file);
            state_.recent.insert(state_.recent.begin(), file);
            state_.recent.resize(std::min(state_.recent.size(), kMostRecent));
        }
        if (other)
            watch_.on(loaded.options.model);
        window_->setTitle(fmt::format(
            "{} - cotan view",
            loaded.options.model.empty() ? std::string("cotan") : fs::path(loaded.options.model).filename().string()));
        for (const std::string& line : loaded.model->scene.warnings)
            app::warn(options_.common, line);
        if (!loaded.model->scene.warnings.empty())
            state_.said = loaded.model->scene.warnings[0];
    }

    void ask()
    {
        if (!state_.model || state_.size.x < 1 || state_.size.y < 1)
            return;
        const std::string key = keyOf(state_);
        const bool meter = state_.metered == 0 && state_.show == "shaded" && meters(optionsOf(state_, false))
            && !artist_->busy() && !failed_; // what failed would fail again
        if (key == key_ && !meter)
            return;
        key_ = key;
        Order order = orderOf(state_);
        order.number = ++orders_;
        artist_->ask(std::move(order));
    }

    Shown shownNow() const
    {
        Shown shown;
        shown.picture = drawn_.picture.get();
        if (state_.compare == Compare::divider)
            shown.other = drawn_.other.get();
        shown.divider = state_.divider * float(state_.size.x);
        shown.serial = serial_;
        return shown;
    }

    // Looks at what is under the pointer, on a thread of its own: a large mesh takes a moment.
    void probe()
    {
        if (probing_.valid()) {
            if (probing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
                return;
            state_.probe = probing_.get();
        }
        const bool wanted = state_.cardShown && state_.model && state_.held.empty() && state_.pointer.x >= 0;
        if (!wanted) {
            state_.probe = {};
            probeKey_.clear();
            return;
        }
        const Side& side = sideOf(state_, state_.compare == Compare::flip && state_.second);
        const std::string key =
            fmt::format("{} {} {} {} {} {}", state_.pointer.x, state_.pointer.y, cameraWords(state_.camera),
                        state_.model->number, side.frame, side.tangents);
        if (key != probeKey_) {
            probeKey_ = key;
            probing_ =
                std::async(std::launch::async,
                           [this, model = state_.model, camera = state_.camera, size = state_.size,
                            pointer = state_.pointer, side] {
                               Probe probe;
                               probe.hit = pick(model->scene, camera, size, pointer + glm::vec2(0.5f));
                               if (probe.hit)
                                   probe.surface = prober_.at(
                                       model->scene, model->number, *probe.hit, *app::parseFrame(side.frame),
                                       side.tangents == "generated" ? TangentOrigin::generated : TangentOrigin::stored);
                               wake();
                               return probe;
                           });
        }
        const glm::ivec2 at(state_.pointer);
        const bool inside = at.x >= 0 && at.y >= 0 && at.x < figures_.size.x && at.y < figures_.size.y;
        state_.probe.degrees = inside && figures_.size == state_.size
            ? figures_.degrees[std::size_t(at.y) * std::size_t(figures_.size.x) + std::size_t(at.x)]
            : -1.0f;
    }

    Json reportOfTimes() const
    {
        return {{"command", "view"},
                {"device", state_.device},
                {"pictures", state_.pictures},
                {"loads", state_.loads},
                {"failed_loads", state_.failedLoads},
                {"seconds",
                 {{"window", windowSeconds_},
                  {"load", loadSeconds_},
                  {"first_picture", firstPicture_},
                  {"first_shown", firstShown_}}}};
    }

    void remember() const
    {
        if (options_.memory.empty())
            return;
        std::error_code error;
        fs::create_directories(options_.memory.parent_path(), error);
        std::ofstream(options_.memory, std::ios::binary) << memoryOf(state_); // nothing depends on it
    }

    State state_;
    const SessionOptions& options_;
    std::optional<Loader> loader_;
    std::optional<Artist> artist_;
    std::unique_ptr<Window> window_;
    std::mutex waking_;
    Window* wakes_ = nullptr;
    Dialog dialog_;
    Watch watch_;
    std::ofstream recording_;
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
    Prober prober_;
    std::future<Probe> probing_;
    std::string probeKey_;
    std::string key_, firstProblem_;
    std::uint64_t serial_ = 0, orders_ = 0;
    std::size_t next_ = 0; // of the played events
    double start_ = 0, last_ = 0, playedTo_ = 0, waitsSince_ = 0;
    double begun_ = 0, windowSeconds_ = 0, loadSeconds_ = 0, firstPicture_ = 0, firstShown_ = 0; // of a report
    bool waits_ = false, quits_ = false, failed_ = false;
    bool written_ = false; // what happens now was written as a command
};

} // namespace

Status runSession(State state, const SessionOptions& options) { return Session(std::move(state), options).run(); }

} // namespace cotan::viewer
