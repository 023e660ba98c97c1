#include "render_thread.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>

#include "cotan/inspect.hpp"
#include "scene_cache.hpp"

namespace cotan::viewer {

struct RenderThread::Work {
    Work(app::CommonOptions common, PictureOptions first, std::function<void()> tell)
        : sceneCache(std::move(common)), done(std::move(tell)), thread([this, first = std::move(first)] { run(first); })
    {
    }

    void run(const PictureOptions& first)
    {
        guarded(
            [&] {
                sceneCache.openEnvironment(first);
                return Drawn{};
            },
            0);
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stop || next || file; });
            if (stop)
                return;
            sceneCache.drawOn(device);
            if (file) {
                const auto* task = std::exchange(file, nullptr);
                lock.unlock();
                (*task)();
                lock.lock();
                continue;
            }
            const Order order = std::move(*next);
            next.reset();
            working = true;
            lock.unlock();
            Drawn drawn = guarded([&] { return sceneCache.draw(order); }, order.number);
            lock.lock();
            const bool whole = order.figures && drawn.problem.empty() && !drawn.draft;
            const auto figureless = drawn;
            publish(std::move(drawn), whole && !next);
            if (whole && !next && !stop) { // compute figures only while no order is waiting
                lock.unlock();
                Drawn more = figureless;
                more = guarded(
                    [&] {
                        if (const Status made = sceneCache.drawFigures(order, more); !made)
                            more.problem = app::withOptionNames(made.error()).message;
                        return more;
                    },
                    order.number);
                lock.lock();
                publish(std::move(more), false);
            }
        }
    }

    template<class Make> static Drawn guarded(const Make& make, std::uint64_t number)
    {
        Drawn failed;
        failed.number = number;
        try {
            return make();
        } catch (const std::bad_alloc&) {
            failed.problem = "not enough memory";
        } catch (const std::exception& e) {
            failed.problem = e.what();
        }
        return failed;
    }

    void publish(Drawn drawn, bool more)
    {
        ready = std::move(drawn);
        working = more;
        if (done)
            done();
    }

    SceneCache sceneCache;
    std::function<void()> done;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Order> next;
    std::optional<Drawn> ready;
    const std::function<void()>* file = nullptr;
    std::shared_ptr<Device> device;
    bool working = false, stop = false;
    std::thread thread; // declared last, because it uses all other members
};

RenderThread::RenderThread(app::CommonOptions common, PictureOptions first, std::function<void()> done)
    : work_(std::make_unique<Work>(std::move(common), std::move(first), std::move(done)))
{
}

RenderThread::~RenderThread()
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->stop = true;
        work_->done = nullptr;
    }
    work_->changed.notify_all();
    work_->thread.join();
}

void RenderThread::drawOn(std::shared_ptr<Device> device)
{
    const std::lock_guard lock(work_->mutex);
    work_->device = std::move(device);
}

void RenderThread::ask(Order order)
{
    const std::lock_guard lock(work_->mutex);
    work_->next = std::move(order);
    work_->changed.notify_all();
}

std::optional<Drawn> RenderThread::take()
{
    const std::lock_guard lock(work_->mutex);
    return std::exchange(work_->ready, std::nullopt);
}

bool RenderThread::busy() const
{
    const std::lock_guard lock(work_->mutex);
    return work_->next || work_->working || work_->ready;
}

Result<Image> RenderThread::drawNow(const Order& order, bool floats)
{
    Result<Image> image = unavailableError("not drawn");
    std::condition_variable finished;
    bool ended = false;
    const std::function<void()> task = [&] {
        Result<Image> made = unavailableError("not drawn");
        try {
            made = work_->sceneCache.drawForFile(order, floats);
        } catch (const std::exception& e) {
            made = unavailableError(e.what());
        }
        const std::lock_guard lock(work_->mutex);
        image = std::move(made);
        ended = true;
        finished.notify_all();
    };
    std::unique_lock lock(work_->mutex);
    work_->file = &task;
    work_->changed.notify_all();
    finished.wait(lock, [&] { return ended; });
    return image;
}

Order orderOf(const State& state)
{
    Order order;
    order.first = optionsOf(state, false);
    order.second = optionsOf(state, true);
    order.a = sideOf(state, false);
    order.b = sideOf(state, true);
    order.compare = state.compare;
    order.flipped = state.second;
    order.model = state.model;
    order.highModel = state.highModel;
    order.exposure = state.metered;
    order.meteredFrom = state.meteredFrom.empty() ? state.picture.camera : state.meteredFrom;
    order.draft = inMotion(state);
    order.figures = state.statisticsShown && !order.draft && !replacesMaterials(state.show);
    return order;
}

} // namespace cotan::viewer
