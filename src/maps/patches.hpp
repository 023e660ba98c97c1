// Evenly spaced patches of an image, for statistics that do not need every texel.
#pragma once

#include <vector>

#include "cotan/scene.hpp"

namespace cotan::maps {

struct Patch {
    int x = 0, y = 0; // its first texel in the image
    Image texels;
};

// Takes the strips of an image from the top and keeps its patches, one for each square of a grid of at most 16 x 16
// squares over the image. Each is the central `largest` x `largest` texels of its square, or the whole of a smaller
// one: up to 16 * largest texels a side they cover the image. Each patch also has the row below and the column to its
// right, if the image has them. The result does not depend on the heights of the strips.
class PatchSampler {
public:
    static constexpr int kQuickSide = 64; // `largest` for verdicts that must take less time than other work on a map

    PatchSampler(int width, int height, PixelType type, int largest = 128);
    void add(const Image& strip, int firstRow); // several threads may add different rows

    int width() const { return width_; }
    int height() const { return height_; }
    PixelType type() const { return type_; }
    const std::vector<Patch>& patches() const { return patches_; }
    double coveredFraction() const; // fraction of the image's texels that are in the patches, (0,1]

private:
    int width_, height_;
    PixelType type_;
    int square_, side_; // sides in texels: of a grid square, of a patch
    std::vector<Patch> patches_;
};

} // namespace cotan::maps
