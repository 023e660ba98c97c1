#include "inspect/verify/view_files.hpp"

#include <utility>

#include <fmt/format.h>

#include "cotan/image.hpp"

namespace cotan {

namespace {

std::string pictureName(const char* what, std::size_t view) { return fmt::format("{}-{}.png", what, view); }

} // namespace

std::vector<std::string> picturesOf(const ViewNames& names, std::size_t views)
{
    std::vector<std::string> all;
    for (std::size_t view = 0; view < views; ++view)
        for (const char* what : {names.expected, names.drawn, names.difference})
            all.push_back(pictureName(what, view));
    return all;
}

Status writeViews(const ComparedViews& compared, const ViewNames& names, const std::filesystem::path& folder)
{
    for (std::size_t k = 0; k < compared.views.size(); ++k) {
        const ComparedView& v = compared.views[k];
        for (const auto& [what, image] :
             {std::pair(names.expected, &v.expected), {names.drawn, &v.drawn}, {names.difference, &v.difference}})
            if (Status written = writeImage(folder / pictureName(what, k), *image); !written)
                return written;
    }
    return Done{};
}

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

} // namespace cotan
