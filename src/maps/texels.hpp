// Texels of a normal map as vectors of the picture, and back.
//
// Picture space, used by everything in this part: x to the right, y up the picture, z out of it. A
// map of any convention decodes into it; which way v runs does not matter here.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/convention.hpp"
#include "cotan/maps.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/scene.hpp"

namespace cotan::maps {

// Where slopes of normals are counted, steeper ones are taken as this: half a degree from lying down.
constexpr float kSteepestSlope = 128;

// Grey pixels with an alpha that varies: greyAlpha. Red constant with an alpha that varies, green
// varying: alphaGreen. Otherwise rg.
Swizzle swizzleOf(const Image& image);

// What swizzleOf looks at, for pictures that come in parts.
struct ChannelRange {
    glm::vec4 lowest{1e30f}, highest{-1e30f};
    bool grey = true; // red, green and blue are the same everywhere

    void add(const glm::vec4& texel);
    void add(const ChannelRange& other);
    void add(const Image& image);
    Swizzle swizzle() const;
};

// Moves x to red and y to green, blue to zero's value and alpha to 1; nothing for rg.
void unswizzle(Image& image, Swizzle from);

// The stored components of one row, as a shader samples them: unorm in [0,1], floats as they are.
// texels: image.width entries.
void loadRow(const Image& image, int row, std::span<glm::vec4> texels);

// The reverse. unorm components are rounded to the nearest step; what is not finite becomes 0.
void storeRow(Image& image, int row, std::span<const glm::vec4> texels);

// One texel as a vector of picture space, with its stored length; (0,0,0) where a component is not
// finite or the vector is shorter than 1e-3. type: of the components, which says where zero lies.
glm::vec3 decodeTexel(const glm::vec4& texel, const Convention& convention, PixelType type);

// A whole row. normals: image.width entries.
void decodeRow(const Image& image, int row, const Convention& convention, std::span<glm::vec3> normals);

// A vector of picture space as stored components; alpha 1. It is normalised first unless the
// convention has three channels and keepLength is set. (0,0,0) is stored as flat. type: as above.
glm::vec4 encodeTexel(glm::vec3 normal, const Convention& convention, PixelType type, bool keepLength = false);

// Calls work(first, last) for bands of rows, on all threads that the caller's arena allows. Results
// must depend on the rows only.
void forRowBands(int height, const std::function<void(int first, int last)>& work);

// Row by row: loaded, each texel by change(texel), and stored.
template<class Change> void changeTexels(Image& image, const Change& change)
{
    forRowBands(image.height, [&](int first, int last) {
        std::vector<glm::vec4> row(std::size_t(image.width));
        for (int y = first; y < last; ++y) {
            loadRow(image, y, row);
            for (glm::vec4& texel : row)
                change(texel);
            storeRow(image, y, row);
        }
    });
}

// Adds noise of half a step to the first three components of row y of a picture, the same on every run; those that are
// a step already (within 0.001) stay: dithering must not make noise of what is exact, such as flat. Floats stay.
void ditherRow(std::span<glm::vec4> texels, PixelType type, int y);

} // namespace cotan::maps
