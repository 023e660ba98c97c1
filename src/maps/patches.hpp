// Patches of a picture, spread evenly: figures that need not look at every texel are taken from them.
#pragma once

#include <vector>

#include "cotan/scene.hpp"

namespace cotan::maps {

struct Patch {
    int x = 0, y = 0; // its first texel in the picture
    Image texels;
};

// Takes the strips of a picture, which follow one another from the top, and keeps its patches: one for each square of a
// grid of at most 16 x 16 over the picture. Up to 2048 texels a side they are whole squares and hold the whole picture;
// above, each is the middle of its square, 128 x 128 texels. Each patch has the row below and the column to the right
// of it too, where the picture has them. The result does not depend on how the picture was cut into strips.
class PatchSampler {
public:
    PatchSampler(int width, int height, PixelType type);
    void add(const Image& strip, int firstRow);

    int width() const { return width_; }
    int height() const { return height_; }
    PixelType type() const { return type_; }
    const std::vector<Patch>& patches() const { return patches_; }
    double share() const; // of the picture's texels that are in the patches, (0,1]

private:
    int width_, height_;
    PixelType type_;
    int square_, side_; // of the grid and of the patches
    std::vector<Patch> patches_;
};

} // namespace cotan::maps
