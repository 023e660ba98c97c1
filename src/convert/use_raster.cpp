#include "use_raster.hpp"

namespace cotan::convert {

UseRaster::UseRaster(const MapUse& use, int width, int height)
    : use_(&use), foldU_(use.wrapU == Wrap::mirror ? 2 : 1), foldV_(use.wrapV == Wrap::mirror ? 2 : 1), width_(width),
      height_(height), raster_(repeatedRaster(use.surface, width, height, {foldU_, foldV_}))
{
}

void UseRaster::addRow(int y, std::uint32_t number, std::vector<std::vector<Place>>& texels) const
{
    UvRow row;
    for (int j = 0; j < foldV_; ++j) {
        raster_.row(j == 0 ? y : 2 * height_ - 1 - y, UvReach::touching, row);
        for (int x = 0; x < width_ * foldU_; ++x) {
            const int column = x < width_ ? x : 2 * width_ - 1 - x;
            for (std::uint32_t i = row.first[std::size_t(x)]; i < row.first[std::size_t(x) + 1]; ++i) {
                const UvPlace& p = row.places[i];
                const Place place{number, p.triangle, {1 - double(p.b1) - double(p.b2), p.b1, p.b2}, p.covers};
                if (!clampedAway(place))
                    texels[std::size_t(column)].push_back(place);
            }
        }
    }
}

bool UseRaster::clampedAway(const Place& p) const
{
    if (use_->wrapU != Wrap::clamp && use_->wrapV != Wrap::clamp)
        return false;
    const glm::dvec2 uv = uvAt(use_->surface, p.triangle, p.barycentric);
    const bool u = use_->wrapU == Wrap::clamp && (uv.x < 0 || uv.x > 1);
    return u || (use_->wrapV == Wrap::clamp && (uv.y < 0 || uv.y > 1));
}

} // namespace cotan::convert
