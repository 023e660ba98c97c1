#include "loader.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "cotan/inspect.hpp"
#include "cotan/maps.hpp"
#include "scene/geometry.hpp"
#include "scene/hard_edges.hpp"

namespace cotan::viewer {

// The model read last, and the data for posing it, null if the model is not animated.
struct LastRead {
    std::shared_ptr<const Model> model;
    std::unique_ptr<AnimatedGltf> animated;
};

namespace {

Loaded readModel(const PictureOptions& options, std::uint64_t number, LastRead& kept)
{
    Loaded loaded;
    loaded.options = options;
    auto opened = openMovingModel(options);
    if (!opened) {
        loaded.error = app::withOptionNames(opened.error());
        return loaded;
    }
    auto model = std::make_shared<Model>();
    model->scene = std::move(opened->scene);
    if (!options.model.empty())
        chooseFramesOfMeshes(options, model->scene);
    model->box = bounds(model->scene);
    model->read = options;
    model->number = number;
    if (opened->animated)
        model->animations = opened->animated->animations();
    kept = {model, std::move(opened->animated)};
    loaded.model = std::move(model);
    return loaded;
}

// Files of a detailed model, and the options that its limits come from.
struct HighFiles {
    PictureOptions options;
    std::vector<std::string> files;
};

Loaded readHighModel(const HighFiles& wanted, std::uint64_t number)
{
    Loaded loaded;
    auto model = std::make_shared<Model>();
    for (const std::string& file : wanted.files) {
        PictureOptions o;
        o.model = file;
        o.up = wanted.options.up;
        o.memory = wanted.options.memory;
        o.maxDegrees = wanted.options.maxDegrees;
        auto scene = openModel(o);
        if (!scene) {
            loaded.error = app::withOptionNames(scene.error());
            return loaded;
        }
        chooseFramesOfMeshes(o, *scene);
        appendScene(model->scene, std::move(*scene));
    }
    model->box = bounds(model->scene);
    model->number = number;
    loaded.model = std::move(model);
    return loaded;
}

Loaded poseKept(const PictureOptions& wanted, std::uint64_t number, LastRead& kept)
{
    Loaded loaded;
    loaded.posed = true;
    loaded.options = kept.model->read; // everything except the pose is as it was read
    loaded.options.animation = wanted.animation;
    loaded.options.time = wanted.animation.empty() ? 0 : wanted.time;
    if (!kept.animated) {
        if (!wanted.animation.empty())
            loaded.error = usageError("animation: expected a glTF model with animations; found none");
        return loaded;
    }
    auto scene = poseModel(*kept.animated, loaded.options, kept.model->scene);
    if (!scene) {
        loaded.error = app::withOptionNames(scene.error());
        return loaded;
    }
    auto model = std::make_shared<Model>();
    model->scene = std::move(*scene);
    model->box = bounds(model->scene);
    model->read = loaded.options;
    model->animations = kept.model->animations;
    model->number = number;
    kept.model = model;
    loaded.model = std::move(model);
    return loaded;
}

// Shows the detailed model that was read, beside the model if only that is shown. A file that has changed changes no
// comparison. After an error the previous one stays.
void takeHigh(State& state, const Loaded& loaded)
{
    if (loaded.error) {
        state.problem = loaded.error->message;
        return;
    }
    const bool again = state.highModel && loaded.high == state.high;
    state.high = loaded.high;
    state.highModel = loaded.model;
    state.statisticsOf.clear();
    if (!again) {
        state.a.high = false;
        state.b.high = true;
        state.compare = state.compare == Compare::off ? Compare::divider : state.compare;
    }
    if (!loaded.model->scene.warnings.empty())
        state.message = loaded.model->scene.warnings[0];
}

// Resets options that could not be satisfied to those of the current model.
void giveUp(State& state, const Loaded& loaded)
{
    state.problem = state.loadProblem = loaded.error->message;
    state.playing = false;
    if (!loaded.posed)
        ++state.failedLoads;
    if (!state.model)
        return;
    const PictureOptions& read = state.model->read;
    state.picture.shape = read.shape;
    state.picture.variant = read.variant;
    state.picture.animation = read.animation;
    state.picture.time = read.time;
}

void takePosed(State& state, const Loaded& loaded)
{
    const bool other = !state.model || state.model->read.animation != loaded.model->read.animation;
    state.model = loaded.model;
    if (other && !state.cameraMoved) // the camera frames the whole animation, and stays when the time changes
        resetCamera(state);
    if (state.playing) // the time has advanced since
        return;
    forgetProblemAreas(state);
}

} // namespace

void take(State& state, const Loaded& loaded)
{
    if (loaded.problemAreas) {
        state.problemAreas = loaded.problemAreas;
        return;
    }
    if (!loaded.faults.empty()) {
        state.message = loaded.faults[0]; // all of them are printed
        return;
    }
    if (!loaded.high.empty())
        return takeHigh(state, loaded);
    if (loaded.error)
        return giveUp(state, loaded);
    if (!loaded.model)
        return;
    if (loaded.posed)
        return takePosed(state, loaded);
    ++state.loads;
    if (state.problem == std::exchange(state.loadProblem, {})) // the file is valid again
        state.problem.clear();
    const bool other =
        !state.model || loaded.options.model != state.picture.model || loaded.options.shape != state.picture.shape;
    if (other && state.model) {
        state.playing = false;
        closeHigh(state); // it is the detail of the previous model
    }
    state.picture.model = loaded.options.model;
    state.picture.shape = loaded.options.shape;
    state.picture.variant = loaded.options.variant;
    state.picture.animation = loaded.options.animation;
    if (!state.playing)
        state.picture.time = loaded.options.time;
    state.model = loaded.model;
    forgetProblemAreas(state);
    state.statisticsOf.clear();
    if (other || !state.cameraMoved) {
        if (state.loads > 1 && other) {
            state.picture.camera.clear();
            state.meteredFrom.clear();
            state.metered = 0;
        }
        resetCamera(state);
    }
    if (other && !loaded.options.model.empty()) {
        const std::string file = std::filesystem::absolute(loaded.options.model).lexically_normal().string();
        std::erase(state.recent, file);
        state.recent.insert(state.recent.begin(), file);
        state.recent.resize(std::min(state.recent.size(), kMaxRecent));
    }
    if (!loaded.model->scene.warnings.empty())
        state.message = loaded.model->scene.warnings[0];
}

struct Loader::Work {
    explicit Work(std::function<void()> tell) : done(std::move(tell)), thread([this] { run(); }) {}

    void run()
    {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stop || read || high || pose || look; });
            if (stop)
                return;
            const auto toRead = std::exchange(read, std::nullopt);
            const auto toHigh = toRead ? std::nullopt : std::exchange(high, std::nullopt);
            const bool reads = toRead || toHigh;
            const auto toPose = reads ? std::nullopt : std::exchange(pose, std::nullopt);
            const auto toLook = reads || toPose ? nullptr : std::exchange(look, nullptr);
            working = true;
            reading = toRead.has_value();
            readingHigh = toHigh.has_value();
            lock.unlock();
            app::Stopwatch watch;
            Loaded loaded = toRead ? guarded([&] { return readModel(*toRead, ++number, kept); })
                : toHigh           ? guarded([&] { return readHighModel(*toHigh, ++number); })
                : toPose           ? guarded([&] { return poseKept(*toPose, ++number, kept); })
                                   : guarded([&] { return lookAt(*toLook); });
            if (toHigh) // also after an exception
                loaded.high = toHigh->files;
            loaded.seconds = watch.lap();
            const std::shared_ptr<const Model> fresh = toRead ? loaded.model : nullptr;
            give(lock, std::move(loaded));
            if (!fresh || read || stop)
                continue;
            working = true;
            lock.unlock();
            give(lock, guarded([&] { return faultsIn(*fresh); }));
        }
    }

    void give(std::unique_lock<std::mutex>& lock, Loaded loaded)
    {
        lock.lock();
        working = reading = readingHigh = false;
        if (!read || !loaded.high.empty()) // otherwise this result is out of date
            ready.push_back(std::move(loaded));
        if (done)
            done();
    }

    static Loaded faultsIn(const Model& model)
    {
        Loaded loaded;
        loaded.faults = maps::mapFaults(model.scene, /*judgeGreen*/ true);
        for (std::string& hint : hardEdgeHints(model.scene))
            loaded.faults.push_back(std::move(hint));
        return loaded;
    }

    static Loaded lookAt(const Model& model)
    {
        Loaded loaded;
        loaded.problemAreas = problemAreas(model.scene);
        return loaded;
    }

    template<class Make> static Loaded guarded(const Make& make)
    {
        Loaded failed;
        try {
            return make();
        } catch (const std::bad_alloc&) {
            failed.error = inputError("not enough memory");
        } catch (const std::exception& e) {
            failed.error = inputError(e.what());
        }
        return failed;
    }

    std::function<void()> done;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<PictureOptions> read, pose;
    std::optional<HighFiles> high;
    std::shared_ptr<const Model> look;
    std::deque<Loaded> ready;
    LastRead kept;            // used only by the thread
    std::uint64_t number = 0; // used only by the thread
    bool working = false, reading = false, readingHigh = false, stop = false;
    std::thread thread; // declared last, because it uses all other members
};

Loader::Loader(std::function<void()> done) : work_(std::make_unique<Work>(std::move(done))) {}

Loader::~Loader()
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->stop = true;
        work_->done = nullptr;
    }
    work_->changed.notify_all();
    work_->thread.join();
}

void Loader::read(const PictureOptions& options)
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->read = options;
        work_->pose.reset();
        work_->look = nullptr;
    }
    work_->changed.notify_all();
}

void Loader::readHigh(const PictureOptions& options, const std::vector<std::string>& files)
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->high = {options, files};
    }
    work_->changed.notify_all();
}

void Loader::pose(const PictureOptions& options)
{
    {
        const std::lock_guard lock(work_->mutex);
        if (work_->read || work_->reading)
            return;
        work_->pose = options;
    }
    work_->changed.notify_all();
}

void Loader::findProblemAreas(std::shared_ptr<const Model> model)
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->look = std::move(model);
    }
    work_->changed.notify_all();
}

std::optional<Loaded> Loader::take()
{
    const std::lock_guard lock(work_->mutex);
    if (work_->ready.empty())
        return std::nullopt;
    Loaded first = std::move(work_->ready.front());
    work_->ready.pop_front();
    return first;
}

bool Loader::busy() const
{
    const std::lock_guard lock(work_->mutex);
    return work_->read || work_->high || work_->pose || work_->look || work_->working || !work_->ready.empty();
}

bool Loader::reading() const
{
    const std::lock_guard lock(work_->mutex);
    return work_->read || work_->high || work_->reading || work_->readingHigh;
}

} // namespace cotan::viewer
