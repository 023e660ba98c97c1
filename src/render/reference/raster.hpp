// Triangles to pixels: clipping in homogeneous raster coordinates, exact coverage in integers, interpolation by the
// triangle's planes, and the tile of the image to draw into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cotan::reference {

// A convex polygon. A triangle cut by five planes has at most eight corners.
struct Polygon {
    std::array<glm::dvec4, 8> corner;
    int count = 0;
};

// Maximum distance of coordinates from the image, in pixels. Clipping to it keeps the rasteriser's integers small.
inline constexpr double kGuardBand = 16384;

// The part of the triangle in front of the near plane (z <= w) and inside the guard band around an image of width x
// height pixels. Triangles that share an edge get identical corners on it, bit for bit. Returns an empty polygon for a
// triangle with a non-finite corner.
Polygon clip(const std::array<glm::dvec4, 3>& triangle, int width, int height);

// Corners are snapped to 1/256 pixel, as on GPUs, so that coverage agrees with theirs.
inline constexpr int kSubPixels = 256;

// A linear function over the raster, in pixels.
struct Plane {
    double x = 0, y = 0, constant = 0;
    double at(double px, double py) const { return x * px + y * py + constant; }
};

// A triangle ready to be rasterised. The planes are those of the whole mesh triangle, from unsnapped corners, even if
// the corners are those of a clipped piece: neither clipping nor snapping changes interpolation.
struct RasterTriangle {
    std::array<glm::ivec2, 3> corner; // 1/256 pixel; clockwise in a raster whose y points down
    std::array<Plane, 3> weight;      // weight of each vertex, times 1/w
    Plane z;                          // reversed depth
    std::uint32_t draw = 0;           // index of the caller's draw
    std::array<std::uint32_t, 3> vertex{};
    bool front = true; // the front side faces the camera
};

// Sample positions in 1/256 pixel from the pixel's first corner.
struct SamplePattern {
    int count = 1;
    std::array<glm::ivec2, 4> offset{{{128, 128}, {}, {}, {}}};
};

// One sample in the centre, or the four standard samples of Vulkan.
inline SamplePattern samplePattern(int samples)
{
    if (samples < 4)
        return {};
    return {4, {{{96, 32}, {224, 96}, {32, 160}, {160, 224}}}};
}

// Pixels [x0, x1) x [y0, y1); x0 and y0 even.
struct Rectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Four pixels that share differences: (x, y), (x+1, y), (x, y+1), (x+1, y+1); x and y even.
struct Quad {
    int x = 0, y = 0;
    std::array<unsigned, 4> covered{}; // a bit per sample for each pixel; 0: helper lane
};

// An edge as a function of a raster position in 1/256 pixel: at least zero inside. A position exactly on an edge
// belongs to the triangle whose top or left edge it is; the constant accounts for it.
struct Edge {
    std::int64_t x = 0, y = 0, constant = 0;
    std::int64_t at(std::int64_t px, std::int64_t py) const { return x * px + y * py + constant; }
};

std::array<Edge, 3> edgesOf(const RasterTriangle& triangle);

// The pixels inside the area whose samples the triangle may cover.
Rectangle boundsOf(const RasterTriangle& triangle, Rectangle area);

// Whether the edges may cover a sample in the area: false for most tiles in the bounding box of a sliver.
bool mayCover(const std::array<Edge, 3>& edges, Rectangle area);

// Narrows x0 and x1 of the bounds to the columns that the edges can cover in rows y and y + 1, within a pixel. The cost
// of a sliver is then proportional to the pixels it covers, not to its bounds.
Rectangle narrowed(const std::array<Edge, 3>& edges, Rectangle bounds, int y);

// The samples of a pixel inside all edges.
unsigned coverage(const std::array<Edge, 3>& edges, int x, int y, const SamplePattern& pattern);

// Calls visit(quad) for every quad with a covered sample in the area, row by row. Samples outside the area are not
// covered.
template<class Visit>
void forEachQuad(const RasterTriangle& triangle, Rectangle area, const SamplePattern& pattern, Visit visit)
{
    Rectangle bounds = boundsOf(triangle, area);
    std::array<Edge, 3> edges = edgesOf(triangle);
    for (int y = bounds.y0 & ~1; y < bounds.y1; y += 2) {
        const Rectangle row = narrowed(edges, bounds, y);
        for (int x = row.x0 & ~1; x < row.x1; x += 2) {
            Quad quad{x, y, {}};
            unsigned any = 0;
            for (int lane = 0; lane < 4; ++lane) {
                int px = x + (lane & 1), py = y + (lane >> 1);
                if (px < area.x1 && py < area.y1)
                    quad.covered[std::size_t(lane)] = coverage(edges, px, py, pattern);
                any |= quad.covered[std::size_t(lane)];
            }
            if (any)
                visit(quad);
        }
    }
}

// Per tile: 1024 for each pixel, 48 MiB in total.
inline constexpr std::size_t kMaxLayers = std::size_t(1) << 20;

struct TooManyLayers {};

// Colour and reversed depth of every sample of an area. Colours are linear and premultiplied; alpha is coverage, as in
// a render target after blending.
class Tile {
public:
    Tile(Rectangle area, const SamplePattern& pattern);

    // Announces an opaque surface that will be drawn. From now on samples behind it fail the depth test.
    void announce(int x, int y, unsigned covered, const Plane& z);

    // The samples of `covered` that pass the depth test: nearer than the stored depth, and not behind an announced
    // surface.
    unsigned nearer(int x, int y, unsigned covered, const Plane& z) const;

    // Replaces the values and reversed depths of samples.
    void write(int x, int y, unsigned samples, glm::vec4 value, const Plane& z);

    // Adds a translucent layer to samples; nothing that is written later may be behind it. `resolve` composes layers by
    // reversed depth; of equally near ones the later one is in front. transmittance: per colour. Throws
    // TooManyLayers over kMaxLayers.
    void blend(int x, int y, unsigned samples, glm::vec4 value, glm::vec3 transmittance, const Plane& z);

    // Number of pixel writes, counting repeated ones.
    std::size_t written() const { return written_; }

    // Sets all samples of a pixel to a background.
    void clear(int x, int y, glm::vec4 value);

    // The mean of a pixel's samples, each with its layers composed over the written value.
    glm::vec4 resolve(int x, int y) const;

private:
    struct Layer {
        glm::vec3 light{0}; // premultiplied
        glm::vec3 transmittance{0};
        std::array<float, 4> reversedDepth{}; // per sample
        unsigned samples = 0;
        std::uint32_t previous = 0; // the pixel's previously added layer, or kNone
    };
    static constexpr std::uint32_t kNone = 0xffffffff;

    std::size_t at(int x, int y) const;
    float reversedDepthAt(const Plane& z, int x, int y, std::size_t sample) const;

    Rectangle area_;
    SamplePattern pattern_;
    std::size_t samples_; // per pixel
    std::vector<glm::vec4> value_;
    std::vector<float> reversedDepth_;
    std::vector<float> announced_; // reversed depth of the nearest announced surface; empty before the first
    std::size_t written_ = 0;
    std::vector<Layer> layers_;
    std::vector<std::uint32_t> newest_; // per pixel; empty before the first layer
};

} // namespace cotan::reference
