#include "verify.hpp"

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/verify/conversion.hpp"
#include "device.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

std::string pictureName(const char* what, std::size_t view) { return fmt::format("{}-{}.png", what, view); }

Result<DrawnSides> drawModel(Painter& painter, const std::filesystem::path& file, ModelInFrame model, const CommonOptions& common,
                             std::vector<Camera> cameras = {})
{
    Progress progress(common, kConversionViews, fmt::format("drawing {}", file.string()));
    painter.progress = progress.within();
    auto sides = drawSides(painter, std::move(model), std::move(cameras));
    painter.progress = {};
    return sides;
}

// One model at a time is in memory.
Result<ComparedViews> drawAndCompare(const VerifyOptions& o, const CommonOptions& common, std::string& device)
{
    auto before = loadSceneWithin(o.memory, o.before);
    if (!before)
        return before.error();
    const auto painter = openDevice(o.device, common);
    if (!painter)
        return painter.error();
    device = (*painter)->device();
    const auto first = drawModel(**painter, o.before, {std::move(*before), o.from, o.fromTangents}, common);
    if (!first)
        return first.error();
    auto after = loadSceneWithin(o.memory, o.after);
    if (!after)
        return after.error();
    const auto second = drawModel(**painter, o.after, {std::move(*after), o.to}, common, first->cameras);
    if (!second)
        return second.error();
    return compareSides(*first, *second);
}

} // namespace

std::vector<std::string> verifyPictures()
{
    std::vector<std::string> names;
    for (std::size_t view = 0; view < kConversionViews; ++view)
        for (const char* what : {"before", "after", "difference"})
            names.push_back(pictureName(what, view));
    return names;
}

Result<nlohmann::ordered_json> verifyConversion(const VerifyOptions& o, const CommonOptions& common)
{
    if (Status made = makeFolder(o.folder); !made)
        return made.error();
    std::string device;
    const auto compared = drawAndCompare(o, common, device);
    if (!compared)
        return compared.error();
    nlohmann::ordered_json views = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < compared->views.size(); ++k) {
        const ComparedView& v = compared->views[k];
        views.push_back(toJson(v.degrees));
        for (const auto& [what, image] : {std::pair("before", &v.expected), {"after", &v.drawn}, {"difference", &v.difference}})
            if (Status written = writeImage(o.folder / pictureName(what, k), *image); !written)
                return written.error();
    }
    const AngleStatistics& s = compared->all;
    say(common, fmt::format("drawn from {} sides on {}, {} without stored tangents against {} before: {}", kConversionViews, device,
                            name(o.to), name(o.from), toText(s)));
    if (s.count == 0)
        warn(common, compared->mapped ? "--verify compared nothing: no pixel shows the inside of a surface in both"
                                      : "--verify compared nothing: no normal map is drawn");
    say(common, fmt::format("pictures in {}: before-N.png, after-N.png, difference-N.png (black 0, blue 0.5, green 2, "
                            "yellow 5, red 15, white 45 degrees)", o.folder.string()));
    return nlohmann::ordered_json{{"device", device}, {"degrees", toJson(s)}, {"views", views}};
}

} // namespace cotan::app
