#include "verify.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/frame_choice.hpp"
#include "cotan/image.hpp"
#include "cotan/inspect.hpp"
#include "inspect/angles.hpp"
#include "loading.hpp"

namespace cotan::app {

namespace {

std::string imageName(const char* what, std::size_t view) { return fmt::format("{}-{}.png", what, view); }

// Writes the images of all views into an existing folder.
Status writeViews(const ComparedViews& compared, const ViewNames& names, const std::filesystem::path& folder)
{
    for (std::size_t k = 0; k < compared.views.size(); ++k) {
        const ComparedView& v = compared.views[k];
        for (const auto& [what, image] :
             {std::pair(names.expected, &v.expected), {names.drawn, &v.drawn}, {names.difference, &v.difference}})
            COTAN_CHECK(writeImage(folder / imageName(what, k), *image));
    }
    return Done{};
}

// The degrees of each view.
Json viewsOf(const ComparedViews& compared)
{
    Json views = Json::array();
    for (const ComparedView& v : compared.views) {
        Json view = toJson(v.degrees);
        if (compared.pixels > 0) {
            view["surface_known"] = v.pixels;
            view["another_surface"] = v.others;
        }
        views.push_back(std::move(view));
    }
    return views;
}

Result<DrawnSides> drawModel(Renderer& renderer, const std::filesystem::path& file, ModelInFrame model,
                             const CommonOptions& common, std::vector<Camera> cameras = {})
{
    return drawWithProgress(common, renderer, kConversionViews, fmt::format("drawing {}", file.string()),
                            [&] { return drawSides(renderer, std::move(model), std::move(cameras)); });
}

// Draws and compares. Only one model is in memory at a time, and each is read once. The converted one comes first: the
// original's maps are decoded with the expansion of its maps, as by the renderer that they are made for.
Result<ComparedViews> drawAndCompare(const VerifyOptions& o, const CommonOptions& common, std::string& device)
{
    COTAN_TRY(after, loadSceneWithin(o.memory, o.after));
    std::vector<Expansion> expansions;
    for (const Material& material : after->materials)
        expansions.push_back(material.normalFormat.expansion);
    if (!o.to)
        for (const FrameDecision& d : chooseFrames(*after)) // which obeys the names
            after->meshes[d.mesh].readWith = d.frame;
    COTAN_TRY(renderer, openDevice(o.device, common));
    device = (*renderer)->device();
    COTAN_TRY(second, drawModel(**renderer, o.after, {std::move(*after), o.to}, common));
    COTAN_TRY(before, loadSceneWithin(o.memory, o.before));
    for (std::size_t i = 0; i < std::min(before->materials.size(), expansions.size()); ++i)
        before->materials[i].normalFormat.expansion = expansions[i];
    COTAN_TRY(first,
              drawModel(**renderer, o.before, {std::move(*before), o.from, o.fromTangents}, common, second->cameras));
    return compareSides(*first, *second);
}

} // namespace

std::vector<std::string> imageNames(const ViewNames& names, std::size_t views)
{
    std::vector<std::string> all;
    for (std::size_t view = 0; view < views; ++view)
        for (const char* what : {names.expected, names.drawn, names.difference})
            all.push_back(imageName(what, view));
    return all;
}

Result<Json> verifyConversion(const VerifyOptions& o, const CommonOptions& common)
{
    COTAN_CHECK(makeFolder(o.folder));
    std::string device;
    COTAN_TRY(compared, drawAndCompare(o, common, device));
    COTAN_CHECK(writeViews(*compared, kConversionNames, o.folder));
    const AngleStatistics& s = compared->all;
    say(common, "drawn from {} sides on {}, {} against {} before: {}", kConversionViews, device,
        o.to ? fmt::format("{} without stored tangents", name(*o.to)) : std::string("the frames of the new file"),
        name(o.from), toText(s));
    if (s.count == 0)
        warn(common, "--verify compared nothing: {}",
             compared->mapped ? "no pixel shows the inside of a surface in both" : kNoNormalMap);
    say(common,
        "images in {}: before-N.png, after-N.png, difference-N.png (black 0, blue 0.5, green 2, "
        "yellow 5, red 15, white 45 degrees)",
        o.folder.string());
    return Json{{"device", device}, {"degrees", toJson(s)}, {"views", viewsOf(*compared)}};
}

Result<Json> verifyBake(const BakeToVerify& bake, const std::string& device, const std::filesystem::path& folder,
                        const CommonOptions& common)
{
    COTAN_CHECK(makeFolder(folder));
    COTAN_TRY(renderer, openDevice(device, common));
    COTAN_TRY(compared, drawWithProgress(common, **renderer, kBakeViews, "drawing and comparing", [&] {
                  return verifyBake(**renderer, bake);
              }));
    for (std::size_t k = 0; k < compared->views.size(); ++k)
        say(common, "view {}: {}", k, toText(compared->views[k].degrees));
    COTAN_CHECK(writeViews(*compared, kBakeNames, folder));
    say(common, "drawn with {} by {}, against the high mesh: {}", name(bake.options.frame), (*renderer)->device(),
        toText(compared->all));
    const std::size_t others = compared->others, pixels = compared->pixels;
    const bool lost = !showsHighSurface(*compared);
    if (lost)
        warn(common,
             "--verify: {} of {} pixels do not show the surface that the high mesh shows (magenta in error-N.png): the "
             "map is wrong{}",
             others, pixels,
             bake.options.search == BakeSearch::nearest ? "; --search first takes the surface in front"
                                                        : " (--extrusion, --max-distance, --cage)");
    else if (pixels == 0)
        warn(common, "--verify compared nothing: the camera sees no high surface where the low one is");
    Json all = toJson(compared->all);
    all["surface_known"] = pixels;
    all["another_surface"] = others;
    return Json{{"device", (*renderer)->device()},
                {"all", all},
                {"shows_the_high_surface", pixels > 0 && !lost},
                {"views", viewsOf(*compared)}};
}

} // namespace cotan::app
