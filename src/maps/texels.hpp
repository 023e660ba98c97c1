// Texels of a normal map as vectors in image space, and back.
//
// Image space, used throughout src/maps: x points right, y up the image, z out of it. Maps of every convention decode
// into it; the direction of v does not matter here.
#pragma once

#include <cmath>
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

// Steeper slopes are clamped to this when slopes of normals are averaged: half a degree from the surface plane.
constexpr float kSteepestSlope = 128;

// greyAlpha for grey pixels with varying alpha; alphaGreen for constant red with varying green and alpha; else rg.
Swizzle swizzleOf(const Image& image);

// The state of swizzleOf, for images that arrive in parts.
struct ChannelRange {
    glm::vec4 lowest{1e30f}, highest{-1e30f};
    bool grey = true; // red, green and blue are equal everywhere

    void add(const glm::vec4& texel);
    void add(const ChannelRange& other);
    void add(const Image& image);
    Swizzle swizzle() const;
};

// Whether blue is the middle code and alpha 1 everywhere, as readers of two-channel formats leave them. Not in grey.
bool lacksZ(const Image& image);

// Moves x to red and y to green; sets blue to 0.5 and alpha to 1. Does nothing for rg.
void unswizzle(Image& image, Swizzle from);

// Moves x from red and y from green to where `to` has them. Does nothing for rg; alphaGreen has red and blue of 1.
void swizzle(Image& image, Swizzle to);

// Loads the stored components of one row as a shader samples them: unorm in [0,1], floats unchanged. texels:
// image.width entries.
void loadRow(const Image& image, int row, std::span<glm::vec4> texels);

// Stores one row. unorm components are clamped, NaN to 0, and rounded to the nearest step; floats not finite become 0.
void storeRow(Image& image, int row, std::span<const glm::vec4> texels);

// Decodes a texel to a vector in image space, with its stored length; (0,0,0) if a component is not finite or the
// vector is shorter than 1e-3. type: of the components, which determines where zero is.
glm::vec3 decodeTexel(const glm::vec4& texel, const Convention& convention, PixelType type);

// Decodes a row. normals: image.width entries.
void decodeRow(const Image& image, int row, const Convention& convention, std::span<glm::vec3> normals);

// Returns a component that is stored as an integer. One that rounding of floats moved off 0.5, the zero of 2c - 1, is
// put back: flat texels would flicker between the two codes beside it.
inline float settled(float c) { return std::abs(c - 0.5f) < 1e-6f ? 0.5f : c; }

// Encodes a vector of image space as stored components, with alpha 1. Normalises first unless the convention has three
// channels and keepLength is set. (0,0,0) is stored as flat. type: as for decodeTexel.
glm::vec4 encodeTexel(glm::vec3 normal, const Convention& convention, PixelType type, bool keepLength = false);

// Calls work(first, last) for bands of rows, on all threads that the caller may use; on this one if there are few
// texels. Results must depend only on rows.
void forRowBands(int width, int height, const std::function<void(int first, int last)>& work);

// Copies `count` rows of an image, from row `first` on.
Image rowsOf(const Image& image, int first, int count);

// Replaces every texel: loads each row, calls change(texel) on its texels, and stores the row.
template<class Change> void changeTexels(Image& image, const Change& change)
{
    forRowBands(image.width, image.height, [&](int first, int last) {
        std::vector<glm::vec4> row(std::size_t(image.width));
        for (int y = first; y < last; ++y) {
            loadRow(image, y, row);
            for (glm::vec4& texel : row)
                change(texel);
            storeRow(image, y, row);
        }
    });
}

// Adds noise of half a step to the first three components of row y of an image, the same in every run. Components
// within 0.001 of a step are exact, such as flat, and stay. Floats stay.
void ditherRow(std::span<glm::vec4> texels, PixelType type, int y);

} // namespace cotan::maps
