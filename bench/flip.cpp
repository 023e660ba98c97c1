// FLIP of pictures against a reference, by tests/flip.hpp: flip REFERENCE PICTURE...
// Prints a line for each picture: its mean error, 0 to 1. All have 8 bits and the same size.
#include <cstdio>
#include <vector>

#include "cotan/image.hpp"
#include "flip.hpp"

int main(int count, char** arguments)
{
    if (count < 3) {
        std::fputs("usage: flip REFERENCE PICTURE...\n", stderr);
        return 1;
    }
    const auto reference = cotan::readImage(arguments[1]);
    for (int i = 2; i < count; ++i) {
        const auto picture = cotan::readImage(arguments[i]);
        if (!reference || !picture || picture->width != reference->width || picture->height != reference->height
            || picture->type != cotan::PixelType::unorm8 || reference->type != picture->type) {
            std::fprintf(stderr, "flip: %s: expected a picture of 8 bits with the size of %s\n", arguments[i],
                         arguments[1]);
            return 2;
        }
        const std::vector<bool> all(picture->pixelCount(), true);
        std::printf("%.4f  %s\n", cotan::test::flipError(*reference, *picture, all), arguments[i]);
    }
    return 0;
}
