#include "bake_options.hpp"

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/verify/bake.hpp"
#include "device.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

std::string bakePictureName(const char* what, std::size_t view) { return fmt::format("{}-{}.png", what, view); }

} // namespace

std::vector<std::string> bakePictures()
{
    std::vector<std::string> names;
    for (std::size_t view = 0; view < kBakeViews; ++view)
        for (const char* what : {"error", "low", "high"})
            names.push_back(bakePictureName(what, view));
    return names;
}

Result<nlohmann::ordered_json> verifyBake(const BakeCommandOptions& o, const BakeJob& job, const Image& map)
{
    if (Status made = makeFolder(o.verify); !made)
        return made.error();
    const auto painter = openDevice(o.device, o.common);
    if (!painter)
        return painter.error();
    Progress progress(o.common, kBakeViews, "drawing and comparing");
    (*painter)->progress = progress.within();
    const auto compared = cotan::verifyBake(**painter, {job.lowScene, job.setup.low, job.setup.high, job.setup.options.bake, map,
                                                        job.setup.options.stored.format, o.material, job.setup.options.tangents});
    if (!compared)
        return compared.error();
    auto views = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < compared->views.size(); ++k) {
        const ComparedView& v = compared->views[k];
        views.push_back(toJson(v.degrees));
        say(o.common, fmt::format("view {}: {}", k, toText(v.degrees)));
        for (const auto& [what, image] : {std::pair("error", &v.difference), {"low", &v.drawn}, {"high", &v.expected}})
            if (Status w = writeImage(o.verify / bakePictureName(what, k), *image); !w)
                return w.error();
    }
    say(o.common, fmt::format("drawn with {} by {}, against the high mesh: {}", name(job.frame()), (*painter)->device(),
                              toText(compared->all)));
    return nlohmann::ordered_json{{"device", (*painter)->device()}, {"all", toJson(compared->all)}, {"views", views}};
}

} // namespace cotan::app
