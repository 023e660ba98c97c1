#include "loader.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "core/try.hpp"
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

using ReadModel = Result<std::shared_ptr<const Model>>; // null: nothing to show

ReadModel readModel(const PictureOptions& options, std::uint64_t number, LastRead& kept)
{
    COTAN_TRY(opened, openMovingModel(options));
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
    return kept.model;
}

// Files of a detailed model, and the options that its limits come from.
struct HighFiles {
    PictureOptions options;
    std::vector<std::string> files;
};

ReadModel readHighModel(const HighFiles& wanted, std::uint64_t number)
{
    auto model = std::make_shared<Model>();
    for (const std::string& file : wanted.files) {
        PictureOptions o;
        o.model = file;
        o.up = wanted.options.up;
        o.memory = wanted.options.memory;
        o.maxDegrees = wanted.options.maxDegrees;
        COTAN_TRY(scene, openModel(o));
        chooseFramesOfMeshes(o, *scene);
        appendScene(model->scene, std::move(*scene));
    }
    model->box = bounds(model->scene);
    model->number = number;
    return std::shared_ptr<const Model>(std::move(model));
}

ReadModel poseKept(const PictureOptions& wanted, std::uint64_t number, LastRead& kept)
{
    if (!kept.animated)
        return wanted.animation.empty() ? ReadModel(nullptr)
                                        : usageError("animation: expected a glTF model with animations; found none");
    PictureOptions options = kept.model->read; // everything except the pose is as it was read
    options.animation = wanted.animation;
    options.time = wanted.animation.empty() ? 0 : wanted.time;
    COTAN_TRY(scene, poseModel(*kept.animated, options, kept.model->scene));
    auto model = std::make_shared<Model>();
    model->scene = std::move(*scene);
    model->box = bounds(model->scene);
    model->read = std::move(options);
    model->animations = kept.model->animations;
    model->number = number;
    kept.model = model;
    return kept.model;
}

Loaded loadedOf(ReadModel read, bool posed = false)
{
    Loaded loaded;
    loaded.posed = posed;
    if (read)
        loaded.model = *std::move(read);
    else
        loaded.error = app::withOptionNames(read.error());
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
    const bool other = !state.model || loaded.model->read.model != state.picture.model
        || loaded.model->read.shape != state.picture.shape;
    if (other && state.model) {
        state.playing = false;
        closeHigh(state); // it is the detail of the previous model
    }
    state.picture.model = loaded.model->read.model;
    state.picture.shape = loaded.model->read.shape;
    state.picture.variant = loaded.model->read.variant;
    state.picture.animation = loaded.model->read.animation;
    if (!state.playing)
        state.picture.time = loaded.model->read.time;
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
    if (other && !loaded.model->read.model.empty()) {
        const std::string file = std::filesystem::absolute(loaded.model->read.model).lexically_normal().string();
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
            Loaded loaded = toRead ? guarded([&] { return loadedOf(readModel(*toRead, ++number, kept)); })
                : toHigh           ? guarded([&] { return loadedOf(readHighModel(*toHigh, ++number)); })
                : toPose ? guarded([&] { return loadedOf(poseKept(*toPose, ++number, kept), /*posed*/ true); })
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
    const std::lock_guard lock(work_->mutex);
    work_->read = options;
    work_->pose.reset();
    work_->look = nullptr;
    work_->changed.notify_all();
}

void Loader::readHigh(const PictureOptions& options, const std::vector<std::string>& files)
{
    const std::lock_guard lock(work_->mutex);
    work_->high = {options, files};
    work_->changed.notify_all();
}

void Loader::pose(const PictureOptions& options)
{
    const std::lock_guard lock(work_->mutex);
    if (work_->read || work_->reading)
        return;
    work_->pose = options;
    work_->changed.notify_all();
}

void Loader::findProblemAreas(std::shared_ptr<const Model> model)
{
    const std::lock_guard lock(work_->mutex);
    work_->look = std::move(model);
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
