// What the numbers of a picture say about it as a normal map, before anyone says how it is stored.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "cotan/maps/texels.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

enum class Content {
    tangentSpace, // three channels, nearly all of blue above the middle
    objectSpace,  // three channels, directions on both sides
    twoChannel,   // x and y only
    slopes,       // two channels, many outside the unit disc: no orthographic map
    signedValues, // three channels, stored signed
    flat,         // one direction only: nothing can be told
    grey,         // red, green and blue the same: a height map, perhaps
    other,        // lengths that no normal map has: a colour picture
};
enum class Centre { exact, biased, unknown };     // the middle code, 128 of 255, or 127.5 as zero
enum class Transfer { linear, srgb, linearised }; // srgb: stored as if it were a colour

struct NormalStatistics {
    Content content = Content::other;
    Swizzle swizzle = Swizzle::rg;
    Centre centre = Centre::unknown;
    Transfer transfer = Transfer::linear;
    bool redIsZ = false;       // red points outwards nearly everywhere, and blue does not: they are exchanged
    bool eightBits = false;    // 16-bit components that are all steps of 8 bits
    bool signedStored = false; // floats that go below zero, or unit vectors as they are
    std::size_t texels = 0;
    double background = 0;        // share outside the charts: alpha 0, black, white, fields of another colour; the rest
                                  // leaves it out
    double invalid = 0;           // share: not finite, or length under 0.1
    double belowHorizon = 0;      // share with z < -0.02
    double outsideDisc = 0;       // share with x^2 + y^2 > 1.02
    double meanLength = 0;        // of the valid ones, read with the centre found (exact if unknown)
    double lengthSpread = 0;      // root mean square of (length - 1)
    double shortened = 0;         // share of length under 0.9
    std::array<double, 3> mean{}; // of x, y, z in picture space, green up
    std::array<double, 3> lowest{}, highest{}; // stored components
    double meanTilt = 0;                       // degrees from flat
    std::array<double, 9> tilt{};              // share in 0..10, 10..20, ... 80..90 degrees and beyond
    double rmsExact = 0, rmsBiased = 0;        // (length - 1) under either centre
};

// Whether a texel says by itself that it lies between the charts of a map: alpha 0, (nearly) black or white.
bool outsideCharts(const glm::vec4& texel);

// Whether a normal of three channels, filtered or compressed, can still have that length.
bool usableLength(float length);

// Reads the whole picture twice. Any size, any contents.
NormalStatistics statisticsOfMap(const Image& image);

// The same for a picture that comes in strips from the top: all of them once, then all of them again.
// Strips of 16 rows, or multiples, but for the last one.
class MapSurvey {
public:
    MapSurvey();
    ~MapSurvey();
    void first(const Image& strip);
    bool oneColour() const; // after the first pass: all texels are alike, and the second may be left out
    void second(const Image& strip);
    NormalStatistics finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// A few words, such as "tangent space" or "two channels (slopes)".
std::string describe(Content content);

} // namespace cotan::maps
