#include "verify.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cotan/scene/geometry.hpp"
#include "cotan/image/file.hpp"
#include "cotan/report/angles.hpp"
#include "painter.hpp"
#include "picture.hpp"
#include "progress.hpp"
#include "vertex_frames.hpp"

namespace cotan::app {

namespace {

constexpr int kSide = 768; // pixels
constexpr int kViews = 5;

// From the front, turned by quarters, and from above.
std::array<Camera, kViews> camerasAround(const Scene& scene)
{
    const Camera fit = fitCamera(bounds(scene), kSide, kSide);
    const glm::vec3 outwards = fit.eye - fit.target;
    std::array<Camera, kViews> cameras;
    cameras.fill(fit);
    for (int k = 1; k < 4; ++k) {
        const float angle = float(std::numbers::pi) / 2 * float(k), c = std::cos(angle), s = std::sin(angle);
        cameras[std::size_t(k)].eye =
            fit.target + glm::vec3(c * outwards.x + s * outwards.z, outwards.y, c * outwards.z - s * outwards.x);
    }
    cameras[4].eye = fit.target + glm::vec3(0, glm::length(outwards), 0);
    cameras[4].up = {0, 0, -1};
    return cameras;
}

struct Side {
    std::filesystem::path file;
    Frame frame;
    bool regenerate;
};

Result<std::vector<Image>> drawNormals(const Side& side, const std::array<Camera, kViews>* cameras,
                                       std::array<Camera, kViews>& used, const VerifyOptions& o, const CommonOptions& common,
                                       std::string& device, bool& mapped)
{
    auto scene = loadSceneWithin(o.memory, side.file);
    if (!scene)
        return scene.error();
    mapped = mapped || drawsNormalMaps(*scene);
    used = cameras ? *cameras : camerasAround(*scene);
    deriveVertexFrames(*scene, side.frame, side.regenerate);
    std::string note;
    auto painter = openPainter(o.device, common.threads, note);
    if (!painter)
        return painter.error();
    if (!note.empty() && !cameras)
        warn(common, note);
    if (Status loaded = (*painter)->load(*scene); !loaded)
        return loaded.error();
    device = (*painter)->device();
    Progress progress(common, kViews, fmt::format("drawing {}", side.file.string()));
    (*painter)->progress = progress.within();
    std::vector<Image> images;
    for (const Camera& camera : used) {
        View view;
        view.width = view.height = kSide;
        view.camera = camera;
        view.frame = int(side.frame);
        view.output = Output::normal;
        auto image = (*painter)->draw(view);
        if (!image)
            return image.error();
        images.push_back(std::move(*image));
    }
    return images;
}

std::string pictureName(const std::string& what, std::size_t view) { return fmt::format("{}-{}.png", what, view); }

} // namespace

std::vector<std::string> verifyPictures()
{
    std::vector<std::string> names;
    for (std::size_t view = 0; view < kViews; ++view)
        for (const char* what : {"before", "after", "difference"})
            names.push_back(pictureName(what, view));
    return names;
}

Result<nlohmann::ordered_json> verifyConversion(const VerifyOptions& o, const CommonOptions& common)
{
    if (Status made = makeFolder(o.folder); !made)
        return made.error();
    std::array<Camera, kViews> cameras;
    std::string device;
    bool mapped = false;
    const auto before = drawNormals({o.before, o.from, o.fromGenerated}, nullptr, cameras, o, common, device, mapped);
    if (!before)
        return before.error();
    const auto after = drawNormals({o.after, o.to, false}, &cameras, cameras, o, common, device, mapped);
    if (!after)
        return after.error();
    nlohmann::ordered_json views = nlohmann::ordered_json::array();
    std::vector<float> all;
    for (std::size_t k = 0; k < kViews; ++k) {
        auto degrees = anglesBetween((*before)[k], (*after)[k]);
        keepInterior(degrees, kSide, kSide);
        if (!mapped)
            degrees.assign(degrees.size(), -1.0f); // no frame has a part in these normals
        views.push_back(toJson(angleStatistics(degrees)));
        const std::pair<std::string, Image> files[] = {{"before", directionsAsColor((*before)[k])},
                                                       {"after", directionsAsColor((*after)[k])},
                                                       {"difference", heatMap(degrees, kSide, kSide)}};
        for (const auto& [name, image] : files)
            if (Status written = writeImage(o.folder / pictureName(name, k), image); !written)
                return written.error();
        all.insert(all.end(), degrees.begin(), degrees.end());
    }
    const AngleStatistics s = angleStatistics(all);
    say(common, fmt::format("drawn from {} sides on {}, {} without stored tangents against {} before: {}", kViews, device,
                            name(o.to), name(o.from), toText(s)));
    if (s.count == 0)
        warn(common, mapped ? "--verify compared nothing: no pixel shows the inside of a surface in both"
                            : "--verify compared nothing: no normal map is drawn");
    say(common, fmt::format("pictures in {}: before-N.png, after-N.png, difference-N.png (black 0, blue 0.5, green 2, "
                            "yellow 5, red 15, white 45 degrees)", o.folder.string()));
    return nlohmann::ordered_json{{"device", device}, {"degrees", toJson(s)}, {"views", views}};
}

} // namespace cotan::app
