#include "maps/patches.hpp"

#include <algorithm>
#include <cstring>

namespace cotan::maps {

namespace {

constexpr int kMaxASide = 16;
constexpr int kMinSide = 3, kLargestSide = 128;  // texels
constexpr int kWhole = kMaxASide * kLargestSide; // pictures of that side and below are looked at whole

} // namespace

PatchSampler::PatchSampler(int width, int height, PixelType type) : width_(width), height_(height), type_(type)
{
    const int longer = std::max(width, height);
    square_ = std::max(kMinSide, (longer + kMaxASide - 1) / kMaxASide);
    side_ = longer <= kWhole ? square_ : kLargestSide;
    const int margin = (square_ - side_) / 2;
    for (int y = 0; y < height; y += square_)
        for (int x = 0; x < width; x += square_) {
            Patch patch{std::min(x + margin, width - 1), std::min(y + margin, height - 1), {}};
            patch.texels = makeImage(std::min(side_ + 1, width - patch.x), std::min(side_ + 1, height - patch.y), type);
            patches_.push_back(std::move(patch));
        }
}

void PatchSampler::add(const Image& strip, int firstRow)
{
    const std::size_t pixel = strip.bytesPerPixel();
    for (Patch& patch : patches_) {
        const int first = std::max(patch.y, firstRow),
                  last = std::min(patch.y + patch.texels.height, firstRow + strip.height);
        const std::size_t bytes = std::size_t(patch.texels.width) * pixel;
        for (int y = first; y < last; ++y)
            std::memcpy(patch.texels.data.data() + std::size_t(y - patch.y) * bytes,
                        strip.data.data()
                            + (std::size_t(y - firstRow) * std::size_t(width_) + std::size_t(patch.x)) * pixel,
                        bytes);
    }
}

double PatchSampler::share() const
{
    double texels = 0;
    for (const Patch& patch : patches_)
        texels += double(std::min(patch.texels.width, side_)) * double(std::min(patch.texels.height, side_));
    return std::min(1.0, texels / (double(width_) * double(height_)));
}

} // namespace cotan::maps
