#include "loader.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "cotan/scene/geometry.hpp"

namespace cotan::viewer {

namespace {

struct Task {
    PictureOptions options;
    std::shared_ptr<const Model> look; // for hot spots; null: read the options' model
};

Loaded readModel(const PictureOptions& options, std::uint64_t number)
{
    Loaded loaded;
    loaded.options = options;
    auto scene = openModel(options);
    if (!scene) {
        loaded.problem = app::inWords(scene.error()).message;
        return loaded;
    }
    auto model = std::make_shared<Model>();
    model->scene = std::move(*scene);
    model->box = bounds(model->scene);
    model->number = number;
    loaded.model = std::move(model);
    return loaded;
}

} // namespace

void take(State& state, const Loaded& loaded)
{
    if (loaded.hotSpots) {
        state.hotSpots = loaded.hotSpots;
        return;
    }
    if (!loaded.model) {
        ++state.failedLoads;
        state.problem = loaded.problem;
        return;
    }
    ++state.loads;
    const bool other =
        !state.model || loaded.options.model != state.picture.model || loaded.options.shape != state.picture.shape;
    state.picture.model = loaded.options.model;
    state.picture.shape = loaded.options.shape;
    state.picture.variant = loaded.options.variant;
    state.picture.animation = loaded.options.animation;
    if (!state.playing)
        state.picture.time = loaded.options.time;
    state.model = loaded.model;
    state.hotSpots.reset();
    if (state.hotSpotsShown)
        state.wishes.push_back({Wish::Kind::findHotSpots, {}, {}});
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
        state.recent.resize(std::min(state.recent.size(), kMostRecent));
    }
    if (!loaded.model->scene.warnings.empty())
        state.said = loaded.model->scene.warnings[0];
}

struct Loader::Work {
    explicit Work(std::function<void()> tell) : done(std::move(tell)), thread([this] { run(); }) {}

    void run()
    {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stop || next; });
            if (stop)
                return;
            const Task task = std::move(*next);
            next.reset();
            working = true;
            lock.unlock();
            app::Stopwatch watch;
            Loaded loaded = guarded(task);
            loaded.seconds = watch.lap();
            lock.lock();
            working = false;
            if (!next || task.look)
                ready = std::move(loaded);
            if (done)
                done();
        }
    }

    Loaded guarded(const Task& task)
    {
        Loaded failed;
        failed.options = task.options;
        try {
            if (!task.look)
                return readModel(task.options, ++number);
            failed.hotSpots = hotSpots(task.look->scene);
        } catch (const std::bad_alloc&) {
            failed.problem = "not enough memory";
        } catch (const std::exception& e) {
            failed.problem = e.what();
        }
        return failed;
    }

    std::function<void()> done;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Task> next;
    std::optional<Loaded> ready;
    std::uint64_t number = 0;
    bool working = false, stop = false;
    std::thread thread; // last: it uses all the others
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
        work_->next = Task{options, nullptr};
    }
    work_->changed.notify_all();
}

void Loader::findHotSpots(std::shared_ptr<const Model> model)
{
    {
        const std::lock_guard lock(work_->mutex);
        if (!work_->next)
            work_->next = Task{{}, std::move(model)};
    }
    work_->changed.notify_all();
}

std::optional<Loaded> Loader::take()
{
    const std::lock_guard lock(work_->mutex);
    return std::exchange(work_->ready, std::nullopt);
}

bool Loader::busy() const
{
    const std::lock_guard lock(work_->mutex);
    return work_->next || work_->working || work_->ready;
}

} // namespace cotan::viewer
