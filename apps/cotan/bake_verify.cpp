#include "bake_options.hpp"

#include <cmath>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "cotan/scene/geometry.hpp"
#include "cotan/image/file.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/put_normal_map.hpp"
#include "painter.hpp"
#include "progress.hpp"
#include "vertex_frames.hpp"

namespace cotan::app {

namespace {

constexpr int kSide = 640; // pixels
constexpr int kViews = 4;

// The low scene with the baked map on the baked material, or on all.
Scene mappedScene(const BakeCommandOptions& o, const BakeJob& job, const Image& map)
{
    Scene scene = job.lowScene;
    putNormalMap(scene, map, job.setup.options.stored.format, o.material);
    deriveVertexFrames(scene, job.frame(), o.tangents != "stored");
    return scene;
}

Camera turned(Camera camera, double quarter)
{
    const glm::vec3 d = camera.eye - camera.target;
    const float c = float(std::cos(quarter)), s = float(std::sin(quarter));
    camera.eye = camera.target + glm::vec3(d.x * c + d.z * s, d.y, d.z * c - d.x * s);
    return camera;
}

std::string pictureName(const char* what, int view) { return fmt::format("{}-{}.png", what, view); }

} // namespace

std::vector<std::string> bakePictures()
{
    std::vector<std::string> names;
    for (int view = 0; view < kViews; ++view)
        for (const char* what : {"error", "low", "high"})
            names.push_back(pictureName(what, view));
    return names;
}

Result<nlohmann::ordered_json> verifyBake(const BakeCommandOptions& o, const BakeJob& job, const Image& map)
{
    if (Status made = makeFolder(o.verify); !made)
        return made.error();
    std::string note;
    const auto painter = openPainter(o.device, o.common.threads, note);
    if (!painter)
        return painter.error();
    if (!note.empty())
        warn(o.common, note);
    const Scene scene = mappedScene(o, job, map);
    if (Status loaded = (*painter)->load(scene); !loaded)
        return loaded.error();
    auto views = nlohmann::ordered_json::array();
    Progress progress(o.common, kViews, "drawing and comparing");
    (*painter)->progress = progress.within();
    std::vector<float> all;
    for (int i = 0; i < kViews; ++i) {
        View view;
        view.width = view.height = kSide;
        view.camera = turned(fitCamera(bounds(scene), kSide, kSide), i * 1.5707963);
        view.frame = int(job.frame());
        view.output = Output::normal;
        const auto drawn = (*painter)->draw(view);
        if (!drawn)
            return drawn.error();
        const auto expected = expectedNormals(job.setup.low, job.setup.high, job.setup.options.bake, view);
        if (!expected)
            return expected.error();
        auto degrees = anglesBetween(*drawn, *expected);
        keepInterior(degrees, kSide, kSide);
        const AngleStatistics s = angleStatistics(degrees);
        views.push_back(toJson(s));
        say(o.common, fmt::format("view {}: {}", i, toText(s)));
        for (float d : degrees)
            if (d >= 0)
                all.push_back(d);
        const std::pair<const char*, Image> pictures[] = {{"error", heatMap(degrees, kSide, kSide)},
                                                          {"low", directionsAsColor(*drawn)},
                                                          {"high", directionsAsColor(*expected)}};
        for (const auto& [name, picture] : pictures)
            if (Status w = writeImage(o.verify / pictureName(name, i), picture); !w)
                return w.error();
    }
    const AngleStatistics s = statisticsOf(std::move(all));
    say(o.common, fmt::format("drawn with {} by {}, against the high mesh: {}", name(job.frame()), (*painter)->device(),
                              toText(s)));
    return nlohmann::ordered_json{{"device", (*painter)->device()}, {"all", toJson(s)}, {"views", views}};
}

} // namespace cotan::app
