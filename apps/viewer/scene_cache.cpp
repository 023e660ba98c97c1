#include "scene_cache.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "inspect/angles.hpp"
#include "parse.hpp"
#include "render/shared_device.hpp"
#include "scene/geometry.hpp"

namespace cotan::viewer {

namespace {

constexpr double kSmooth = 0.05; // seconds: slower images are drawn smaller while the camera moves
constexpr double kDraftPixels = 160000;

// Everything that the scene of a side depends on.
std::string sceneKey(const Model& model, const PictureOptions& o, std::optional<Frame> frame,
                     const std::string& inspection)
{
    const std::string vertices = !frame || readsVertices(*frame)
        ? std::string(frame ? name(*frame) : kAutoFrame) + "/" + wordOf(kTangentOrigins, o.tangents)
        : "";
    const OwnMaps& m = o.maps;
    return fmt::format("{}|{}|{}|{}|{}|{}|{}", model.number, vertices, inspection, fmt::join(m.files(), "|"),
                       m.heightDepth.value_or(-1), m.convention, m.material);
}

// Whether the scene is drawn as it is loaded, also with the frame that its maps are for.
bool plain(const PictureOptions& o, std::optional<Frame> frame, const Scene& scene)
{
    const OwnMaps none;
    return frame && !readsVertices(*frame) && o.maps.files() == none.files() && o.maps.convention == none.convention
        && !lacksMeantFrame(o, scene);
}

// The model of a side.
const std::shared_ptr<const Model>& modelOf(const Order& order, bool second)
{
    return (second ? order.b : order.a).high ? order.highModel : order.model;
}

// The frame of a side; none: each mesh's own. The frame's name must be valid.
std::optional<Frame> frameOf(const Order& order, bool second, const Scene& scene)
{
    return chosenFrame(*parseFrameChoice((second ? order.b : order.a).frame), second ? order.second : order.first,
                       scene);
}

std::string lightKey(const PictureOptions& o)
{
    std::error_code none; // names of built-in environments are no files
    const auto written = std::filesystem::last_write_time(o.environment, none).time_since_epoch().count();
    return fmt::format("{}|{}|{}|{}", o.environment, none ? 0 : written, o.environmentRotation, o.environmentIntensity);
}

// Compares the pixels. Keys would not do: a map's file may have changed, or be unchanged in a model that was reloaded.
bool sameImages(const std::vector<Image>& a, const std::vector<Image>& b)
{
    return std::ranges::equal(a, b, [](const Image& x, const Image& y) {
        return x.width == y.width && x.height == y.height && x.type == y.type && x.data.size() == y.data.size()
            && std::memcmp(x.data.data(), y.data.data(), x.data.size()) == 0;
    });
}

View smaller(View view)
{
    const double scale = std::min(1.0, std::sqrt(kDraftPixels / (double(view.width) * view.height)));
    view.width = std::max(1, int(view.width * scale));
    view.height = std::max(1, int(view.height * scale));
    view.samples = 1;
    return view;
}

} // namespace

void SceneCache::openEnvironment(const PictureOptions& o)
{
    if (auto opened = openEnvironmentMap(o))
        environment_ = {lightKey(o), *opened};
}

Drawn SceneCache::draw(const Order& order)
{
    Drawn drawn;
    drawn.number = order.number;
    app::Stopwatch watch;
    const Status done = drawInto(order, drawn, Aim::window);
    if (!done)
        drawn.problem = app::withOptionNames(done.error()).message;
    drawn.seconds = watch.lap();
    if (!drawn.draft)
        seconds_ = drawn.seconds;
    return drawn;
}

Status SceneCache::drawFigures(const Order& order, Drawn& drawn)
{
    const bool two = order.compare != Compare::off;
    COTAN_TRY(first, cachedScene(0, order, false, true));
    COTAN_TRY(view, viewFor(order, **first, false, drawn.exposure));
    const Scene& scene = *(*first)->scene;
    const std::optional<Frame> frame = frameOf(order, false, scene);
    const std::optional<Frame> meant = two ? std::nullopt : std::optional(meantFrame(order.first, scene, frame));
    COTAN_TRY(degrees, degreesOf(order, **first, *view, meant));
    drawn.degrees = *degrees;
    drawn.statistics = angleStatistics(drawn.degrees);
    drawn.statisticsOf =
        meant ? fmt::format("{} against {}", nameOfFrames(frame, scene), name(*meant)) : "first against second";
    drawn.hasFigures = true;
    return Done{};
}

Result<Image> SceneCache::drawForFile(const Order& order, bool floats)
{
    Drawn drawn;
    COTAN_CHECK(drawInto(order, drawn, floats ? Aim::floatFile : Aim::file));
    return *drawn.picture.onHost;
}

Status SceneCache::drawInto(const Order& order, Drawn& drawn, Aim aim)
{
    const bool second = order.compare == Compare::flip && order.flipped;
    COTAN_TRY(first, cachedScene(second ? 1 : 0, order, second, order.compare == Compare::angle));
    drawn.device = (*first)->renderer->device();
    COTAN_TRY(view, viewFor(order, **first, second, order.exposure));
    drawn.draft = order.draft && seconds_ > kSmooth && aim != Aim::floatFile;
    if (drawn.draft)
        *view = smaller(*view);
    drawn.view = *view;
    drawn.exposure = meters(second ? order.second : order.first) ? view->exposure : 0;
    if (order.compare == Compare::angle) {
        COTAN_TRY(degrees, degreesOf(order, **first, *view, std::nullopt));
        drawn.picture.onHost = std::make_shared<Image>(heatMap(*degrees, view->width, view->height));
        return Done{};
    }
    COTAN_TRY(drawing, drawSide(**first, *view, second ? order.second : order.first, aim));
    drawn.picture = std::move(*drawing);
    if (order.compare != Compare::divider)
        return Done{};
    COTAN_TRY(other, cachedScene(1, order, true));
    const bool alone = !meters(order.first) && meters(order.second); // detail beside a mask, which has no light
    COTAN_TRY(otherView, viewFor(order, **other, true, alone ? order.exposure : drawn.exposure));
    if (alone)
        drawn.exposure = otherView->exposure;
    if (drawn.draft)
        *otherView = smaller(*otherView);
    drawing = drawSide(**other, *otherView, order.second, aim);
    if (!drawing)
        return drawing.error();
    drawn.other = std::move(*drawing);
    return Done{};
}

Result<Drawing> SceneCache::drawSide(CachedScene& s, const View& view, const PictureOptions& o, Aim aim)
{
    const bool inspects = inspectionFromName(o.show).has_value();
    if (aim == Aim::window && outputOf(o.show) == Output::shaded && o.edges == Edges::none) {
        auto drawn = drawOnDevice(*s.renderer, inspects ? inspectionView(view) : view);
        if (!drawn || *drawn)
            return drawn ? Result<Drawing>({std::move(*drawn), nullptr}) : drawn.error();
    }
    const auto frame = view.framesOfMeshes ? std::nullopt : std::optional(view.frame);
    const Frame meant = o.show == "error" ? meantFrame(o, *s.scene, frame) : Frame::exact; // else not read
    COTAN_TRY(image, drawShow(*s.renderer, *s.scene, view, o.show, aim == Aim::floatFile, meant));
    COTAN_CHECK(layEdgesOn(s, view, o, *image));
    return Drawing{nullptr, std::make_shared<Image>(std::move(*image))};
}

Result<std::unique_ptr<Renderer>> SceneCache::openRenderer(const PictureOptions& o) const
{
    if (device_ && o.device != "reference")
        if (auto shared = openRendererOn(device_))
            return shared;
    return app::openDevice(o.device, common_);
}

Status SceneCache::layEdgesOn(CachedScene& s, const View& view, const PictureOptions& o, Image& image)
{
    if (o.edges == Edges::none)
        return Done{};
    const std::string key = fmt::format("{}", s.model->number);
    if (s.edges.key != key || !s.edges.value)
        s.edges = {key, surfaceEdges(s.model->scene)};
    return layEdges(*s.renderer, view, o, *s.edges.value, image);
}

Result<std::vector<float>> SceneCache::degreesOf(const Order& order, CachedScene& first, const View& view,
                                                 const std::optional<Frame>& meant)
{
    View normals = view;
    normals.output = Output::normal;
    COTAN_TRY(a, first.renderer->draw(normals));
    CachedScene* other = &first;
    if (meant) {
        normals.setFrame(meant);
    } else {
        COTAN_TRY(secondScene, cachedScene(1, order, true, true));
        other = *secondScene;
        normals.setFrame(frameOf(order, true, *other->scene));
        normals.normalMaps = !order.second.noNormalMaps;
    }
    COTAN_TRY(b, other->renderer->draw(normals));
    if (meant && !showsNormalMaps(*first.scene, view))
        return std::vector<float>(a->pixelCount(), -1.0f);
    return anglesBetween(*a, *b);
}

Result<CachedScene*> SceneCache::cachedScene(std::size_t index, const Order& order, bool second, bool normals)
{
    const PictureOptions& o = second ? order.second : order.first;
    const Side& side = second ? order.b : order.a;
    const std::shared_ptr<const Model>& model = modelOf(order, second);
    COTAN_TRY(choice, parseFrameChoice(side.frame));
    const std::string inspection = !normals && replacesMaterials(o.show) ? o.show : "";
    const std::optional<Frame> frame =
        chosenFrame(*choice, o, model->scene); // of the model's own maps; others are not applied yet
    const std::string key = sceneKey(*model, o, frame, inspection);
    for (CachedScene& known : cachedScenes_)
        if (known.key == key && known.renderer)
            return &known;
    CachedScene& s = cachedScenes_[index];
    const bool loaded = !std::exchange(s.key, {}).empty();
    if (!s.renderer) {
        COTAN_TRY(renderer, openRenderer(o));
        s.renderer = std::move(*renderer);
    }
    s.renderer->forget();
    const auto modelBefore = std::exchange(s.model, model);
    const Scene ownBefore = std::exchange(s.own, {});
    const Scene* before = !loaded ? nullptr : s.scene == &s.own ? &ownBefore : s.scene;
    s.scene = &s.model->scene;
    if (!plain(o, frame, s.model->scene) || !inspection.empty()) {
        s.own = s.model->scene;
        COTAN_CHECK(prepareScene(o, inspection.empty() ? "error" : inspection, {*choice}, s.own));
        s.scene = &s.own;
    }
    const bool same = before && sameImages(before->images, s.scene->images);
    COTAN_CHECK(s.renderer->load(*s.scene, same));
    s.key = key;
    return &s;
}

Result<View> SceneCache::viewFor(const Order& order, CachedScene& s, bool second, float exposure)
{
    const PictureOptions& o = second ? order.second : order.first;
    auto view = viewOf(o, *s.scene);
    if (!view)
        return view;
    view->setFrame(frameOf(order, second, *s.scene));
    view->output = outputOf(o.show);
    view->lights = lightsOf(o, order.model->scene); // also on the detailed model
    const bool unlit = o.use == PictureUse::data;   // data is drawn without lighting
    if (!unlit && (environment_.key != lightKey(o) || !environment_.value)) {
        COTAN_TRY(opened, openEnvironmentMap(o));
        environment_ = {lightKey(o), *opened};
    }
    view->environmentMap = unlit ? nullptr : *environment_.value;
    const std::string under =
        fmt::format("{}|{}|{}|{}|{}", s.key, lightKey(o), o.ground, o.noShadows, o.shadowSoftness.value_or(-1));
    if (under != s.ground.key || !s.ground.value)
        s.ground = {under, groundOf(o, *s.scene, *view)};
    view->ground = *s.ground.value;
    if (meters(o) && exposure <= 0) {
        View meteringView = *view;
        PictureOptions from = o;
        from.camera = order.meteredFrom;
        if (const auto there = viewOf(from, *s.scene))
            meteringView.camera = there->camera;
        COTAN_TRY(found, meterExposure(*s.renderer, meteringView));
        exposure = *found;
    }
    if (meters(o))
        view->exposure = exposure;
    return view;
}

} // namespace cotan::viewer
