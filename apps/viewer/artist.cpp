#include "artist.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "cotan/draw/exposure.hpp"
#include "cotan/inspect/inspection.hpp"
#include "cotan/picture/light.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/geometry.hpp"
#include "cotan/verify/frames.hpp"
#include "parse.hpp"

namespace cotan::viewer {

namespace {

constexpr double kSmooth = 0.05; // seconds: a picture that takes longer is drawn smaller while the camera moves
constexpr double kDraftPixels = 160000;

// Keeps what was made for a key, until another one is asked for.
template<class T> struct Kept {
    std::string key;
    std::optional<T> value;
};

// A scene with the maps and the attributes of one side, on a device.
struct Stage {
    std::string key;
    std::shared_ptr<const Model> model; // what `scene` points to, where nothing had to be made
    Scene own;
    const Scene* scene = nullptr;
    std::unique_ptr<Painter> painter;
};

// What of the options and the side the scene depends on.
std::string sceneKey(const Model& model, const PictureOptions& o, Frame frame, const std::string& inspection)
{
    const std::string vertices = readsVertices(frame) ? std::string(name(frame)) + "/" + o.tangents : "";
    const OwnMaps& m = o.maps;
    return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}", model.number, vertices, inspection, m.normal, m.baseColor,
                       m.metallicRoughness, m.occlusion, m.convention, m.material);
}

bool plain(const PictureOptions& o, Frame frame)
{
    const OwnMaps none, &m = o.maps;
    return !readsVertices(frame) && m.normal.empty() && m.baseColor.empty() && m.metallicRoughness.empty()
        && m.occlusion.empty() && m.convention == none.convention;
}

std::string lightKey(const PictureOptions& o)
{
    return fmt::format("{}|{}|{}", o.environment, o.environmentRotation, o.environmentIntensity);
}

View smaller(View view)
{
    const double scale = std::min(1.0, std::sqrt(kDraftPixels / (double(view.width) * view.height)));
    view.width = std::max(1, int(view.width * scale));
    view.height = std::max(1, int(view.height * scale));
    view.samples = 1;
    return view;
}

// All that is only touched by the artist's thread.
class Studio {
public:
    explicit Studio(app::CommonOptions common) : common_(std::move(common)) {}

    // What can be had before there is a model. What fails fails again, and is said, when it is needed.
    void open(const PictureOptions& o)
    {
        if (auto painter = app::openDevice(deviceOf(o), common_))
            stages_[0].painter = std::move(*painter);
        if (auto opened = openSurroundings(o))
            surroundings_ = {lightKey(o), *opened};
    }

    Drawn draw(const Order& order)
    {
        Drawn drawn;
        drawn.number = order.number;
        app::Stopwatch watch;
        const Status done = drawInto(order, drawn, false);
        if (!done)
            drawn.problem = app::inWords(done.error()).message;
        drawn.seconds = watch.lap();
        if (!drawn.draft)
            seconds_ = drawn.seconds;
        return drawn;
    }

    Status drawFigures(const Order& order, Drawn& drawn)
    {
        const bool two = order.compare != Compare::off;
        auto first = stage(0, order, false, true);
        if (!first)
            return first.error();
        auto view = viewFor(order, **first, false, drawn.exposure);
        if (!view)
            return view.error();
        const auto degrees = degreesOf(order, **first, *view, two ? order.second : order.first, two);
        if (!degrees)
            return degrees.error();
        drawn.degrees = *degrees;
        drawn.statistics = angleStatistics(drawn.degrees);
        drawn.statisticsOf = two ? "first against second" : order.a.frame + " against exact";
        drawn.hasFigures = true;
        return Done{};
    }

    Result<Image> drawForFile(const Order& order, bool floats)
    {
        Drawn drawn;
        if (Status done = drawInto(order, drawn, floats); !done)
            return done.error();
        return *drawn.picture;
    }

private:
    Status drawInto(const Order& order, Drawn& drawn, bool floats)
    {
        const bool second = order.compare == Compare::flip && order.flipped;
        auto first = stage(second ? 1 : 0, order, second, order.compare == Compare::angle);
        if (!first)
            return first.error();
        drawn.device = (*first)->painter->device();
        auto view = viewFor(order, **first, second, order.exposure);
        if (!view)
            return view.error();
        drawn.draft = order.draft && seconds_ > kSmooth && !floats;
        if (drawn.draft)
            *view = smaller(*view);
        drawn.view = *view;
        drawn.exposure = meters(second ? order.second : order.first) ? view->exposure : 0;
        if (order.compare == Compare::angle) {
            const auto degrees = degreesOf(order, **first, *view, order.second, true);
            if (!degrees)
                return degrees.error();
            drawn.picture = std::make_shared<Image>(heatMap(*degrees, view->width, view->height));
            return Done{};
        }
        auto image = drawSide(order, **first, *view, order.first, floats);
        if (!image)
            return image.error();
        drawn.picture = std::make_shared<Image>(std::move(*image));
        if (order.compare != Compare::divider)
            return Done{};
        auto other = stage(1, order, true);
        if (!other)
            return other.error();
        auto otherView = viewFor(order, **other, true, drawn.exposure);
        if (!otherView)
            return otherView.error();
        if (drawn.draft)
            *otherView = smaller(*otherView);
        image = drawSide(order, **other, *otherView, order.second, floats);
        if (!image)
            return image.error();
        drawn.other = std::make_shared<Image>(std::move(*image));
        return Done{};
    }

    Result<Image> drawSide(const Order& order, Stage& s, const View& view, const PictureOptions& o, bool floats)
    {
        auto image = drawShow(*s.painter, *s.scene, view, order.show, floats);
        if (image)
            if (Status laid = layEdgesOn(order, s, view, o, *image); !laid)
                return laid.error();
        return image;
    }

    Status layEdgesOn(const Order& order, Stage& s, const View& view, const PictureOptions& o, Image& picture)
    {
        if (o.edges == "none")
            return Done{};
        const std::string key = fmt::format("{}", order.model->number);
        if (edges_.key != key || !edges_.value)
            edges_ = {key, surfaceEdges(order.model->scene)};
        return layEdges(*s.painter, view, o, *edges_.value, picture);
    }

    // Between the normals of the first picture and those of the second, or those of the frame `exact`.
    Result<std::vector<float>> degreesOf(const Order& order, Stage& first, const View& view,
                                         const PictureOptions& second, bool two)
    {
        View normals = view;
        normals.output = Output::normal;
        auto a = first.painter->draw(normals);
        if (!a)
            return a.error();
        Stage* other = &first;
        if (two) {
            auto staged = stage(1, order, true, true);
            if (!staged)
                return staged.error();
            other = *staged;
            normals.frame = *app::parseFrame(order.b.frame);
            normals.normalMaps = !second.noNormalMaps;
        } else {
            normals.frame = Frame::exact;
        }
        auto b = other->painter->draw(normals);
        if (!b)
            return b.error();
        if (!two && !showsNormalMaps(*first.scene, view))
            return std::vector<float>(a->pixelCount(), -1.0f);
        return anglesBetween(*a, *b);
    }

    // The scene of a side on a painter; the second has a painter of its own only where its scene is another.
    // normals: not in the colours that are shown, but as a surface.
    Result<Stage*> stage(std::size_t index, const Order& order, bool second, bool normals = false)
    {
        const PictureOptions& o = second ? order.second : order.first;
        const Side& side = second ? order.b : order.a;
        const auto frame = app::parseFrame(side.frame);
        if (!frame)
            return frame.error();
        const std::string inspection = !normals && inspectionFromName(order.show) ? order.show : "";
        const std::string key = sceneKey(*order.model, o, *frame, inspection);
        for (Stage& known : stages_)
            if (known.key == key && known.painter)
                return &known;
        Stage& s = stages_[index];
        s.key.clear();
        if (!s.painter) {
            auto painter = app::openDevice(deviceOf(o), common_);
            if (!painter)
                return painter.error();
            s.painter = std::move(*painter);
        }
        s.painter->forget();
        s.scene = nullptr;
        s.own = {};
        s.model = order.model;
        s.scene = &s.model->scene;
        if (!plain(o, *frame) || !inspection.empty()) {
            s.own = s.model->scene;
            if (Status prepared = prepareScene(o, inspection, {*frame}, s.own); !prepared)
                return prepared.error();
            s.scene = &s.own;
        }
        if (Status loaded = s.painter->load(*s.scene); !loaded)
            return loaded.error();
        s.key = key;
        return &s;
    }

    // As `cotan render` makes it. exposure: for "auto"; 0: found by metering.
    Result<View> viewFor(const Order& order, Stage& s, bool second, float exposure)
    {
        const PictureOptions& o = second ? order.second : order.first;
        auto view = viewOf(o, *s.scene);
        if (!view)
            return view;
        view->frame = *app::parseFrame((second ? order.b : order.a).frame);
        view->output = outputOf(order.show);
        view->lights = lightsOf(o, *s.scene);
        const bool dark = o.use == PictureUse::data; // nothing is lit then
        if (!dark && (surroundings_.key != lightKey(o) || !surroundings_.value)) {
            auto opened = openSurroundings(o);
            if (!opened)
                return opened.error();
            surroundings_ = {lightKey(o), *opened};
        }
        view->environmentMap = dark ? nullptr : *surroundings_.value;
        const std::string under =
            fmt::format("{}|{}|{}|{}|{}", s.key, lightKey(o), o.ground, o.noShadows, o.shadowSoftness);
        if (under != ground_.key || !ground_.value)
            ground_ = {under, groundOf(o, *s.scene, *view)};
        view->ground = *ground_.value;
        if (meters(o) && exposure <= 0) {
            View looked = *view;
            PictureOptions from = o;
            from.camera = order.meteredFrom;
            if (const auto there = viewOf(from, *s.scene))
                looked.camera = there->camera;
            const auto found = meterExposure(*s.painter, looked);
            if (!found)
                return found.error();
            exposure = *found;
        }
        if (meters(o))
            view->exposure = exposure;
        return view;
    }

    app::CommonOptions common_;
    std::array<Stage, 2> stages_;
    Kept<std::shared_ptr<const EnvironmentMap>> surroundings_;
    Kept<std::shared_ptr<const GroundMap>> ground_;
    Kept<std::vector<SurfaceEdge>> edges_;
    double seconds_ = 0; // of the last whole picture
};

} // namespace

struct Artist::Work {
    Work(app::CommonOptions common, PictureOptions first, std::function<void()> tell)
        : studio(std::move(common)), done(std::move(tell)), thread([this, first = std::move(first)] { run(first); })
    {
    }

    void run(const PictureOptions& first)
    {
        guarded(
            [&] {
                studio.open(first);
                return Drawn{};
            },
            0);
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return stop || next || file; });
            if (stop)
                return;
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
            Drawn drawn = guarded([&] { return studio.draw(order); }, order.number);
            lock.lock();
            const bool whole = order.figures && drawn.problem.empty() && !drawn.draft;
            const auto figureless = drawn;
            publish(std::move(drawn), whole && !next);
            if (whole && !next && !stop) { // figures can wait for a moment without orders
                lock.unlock();
                Drawn more = figureless;
                more = guarded(
                    [&] {
                        if (const Status made = studio.drawFigures(order, more); !made)
                            more.problem = app::inWords(made.error()).message;
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
        try {
            return make();
        } catch (const std::bad_alloc&) {
            Drawn failed;
            failed.number = number;
            failed.problem = "not enough memory";
            return failed;
        } catch (const std::exception& e) {
            Drawn failed;
            failed.number = number;
            failed.problem = e.what();
            return failed;
        }
    }

    void publish(Drawn drawn, bool more)
    {
        ready = std::move(drawn);
        working = more;
        if (done)
            done();
    }

    Studio studio;
    std::function<void()> done;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Order> next;
    std::optional<Drawn> ready;
    const std::function<void()>* file = nullptr;
    bool working = false, stop = false;
    std::thread thread; // last: it uses all the others
};

Artist::Artist(app::CommonOptions common, PictureOptions first, std::function<void()> done)
    : work_(std::make_unique<Work>(std::move(common), std::move(first), std::move(done)))
{
}

Artist::~Artist()
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->stop = true;
        work_->done = nullptr;
    }
    work_->changed.notify_all();
    work_->thread.join();
}

void Artist::ask(Order order)
{
    {
        const std::lock_guard lock(work_->mutex);
        work_->next = std::move(order);
    }
    work_->changed.notify_all();
}

std::optional<Drawn> Artist::take()
{
    const std::lock_guard lock(work_->mutex);
    return std::exchange(work_->ready, std::nullopt);
}

bool Artist::busy() const
{
    const std::lock_guard lock(work_->mutex);
    return work_->next || work_->working || work_->ready;
}

Result<Image> Artist::drawNow(const Order& order, bool floats)
{
    Result<Image> image = unavailableError("not drawn");
    std::condition_variable finished;
    bool ended = false;
    const std::function<void()> task = [&] {
        Result<Image> made = unavailableError("not drawn");
        try {
            made = work_->studio.drawForFile(order, floats);
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
    order.a = state.a;
    order.b = state.b;
    order.show = state.show;
    order.compare = state.compare;
    order.flipped = state.second;
    order.model = state.model;
    order.exposure = state.metered;
    order.meteredFrom = state.meteredFrom.empty() ? state.picture.camera : state.meteredFrom;
    order.draft = state.moving;
    order.figures = state.statisticsShown && !state.moving && !inspectionFromName(state.show);
    return order;
}

} // namespace cotan::viewer
