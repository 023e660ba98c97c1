// Triangles to pixels: clipping in homogeneous raster coordinates, coverage in exact integers, interpolation from the
// triangle's own planes; and the tile of the picture that they are drawn into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cotan::reference {

// A convex polygon; a triangle cut by five planes has at most eight corners.
struct Polygon {
    std::array<glm::dvec4, 8> corner;
    int count = 0;
};

// How far beyond the picture coordinates may reach, in pixels. Keeps the integers of the rasteriser
// small; what lies further out is cut.
inline constexpr double kGuardBand = 16384;

// The part of the triangle in front of the near plane (z <= w) and inside the guard band around
// a picture of width x height pixels. Two triangles that share an edge get the same corners on
// it, bit for bit. Nothing is left (count 0) of a triangle with a non-finite corner.
Polygon clip(const std::array<glm::dvec4, 3>& triangle, int width, int height);

// Corners are snapped to 1/256 pixel, as GPUs do, so that both decide alike which pixels a triangle covers.
inline constexpr int kSubPixels = 256;

// A linear function over the raster, in pixels.
struct Plane {
    double x = 0, y = 0, constant = 0;
    double at(double px, double py) const { return x * px + y * py + constant; }
};

// A triangle ready to be rasterised. The planes belong to the whole triangle of the mesh even when
// the corners are those of a piece that clipping left, and they are made from corners that are
// not snapped; so interpolation knows nothing of either.
struct RasterTriangle {
    std::array<glm::ivec2, 3> corner; // 1/256 pixel; clockwise in a raster whose y points down
    std::array<Plane, 3> weight;      // weight of each vertex, times 1/w
    Plane z;                          // reversed depth
    std::uint32_t draw = 0;           // what it belongs to: an index of the caller's
    std::array<std::uint32_t, 3> vertex{};
    bool front = true; // the side that faces the camera
};

// Where the samples of a pixel lie, in 1/256 pixel from its first corner.
struct SamplePattern {
    int count = 1;
    std::array<glm::ivec2, 4> offset{{{128, 128}, {}, {}, {}}};
};

// One sample in the middle, or the four of a standard Vulkan 4x target.
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
    std::array<unsigned, 4> covered{}; // a bit per sample, per pixel; 0: helper lane
};

// An edge as a function of a raster position in 1/256 pixel: at least zero for what it keeps. A position exactly on an
// edge belongs to the triangle whose top or left edge it is, which is worked into the constant.
struct Edge {
    std::int64_t x = 0, y = 0, constant = 0;
    std::int64_t at(std::int64_t px, std::int64_t py) const { return x * px + y * py + constant; }
};

std::array<Edge, 3> edgesOf(const RasterTriangle& triangle);

// The pixels whose samples the triangle may cover, inside the area.
Rectangle boundsOf(const RasterTriangle& triangle, Rectangle area);

// Whether the edges may keep a sample of the area: false for most tiles in the box of a sliver.
bool mayCover(const std::array<Edge, 3>& edges, Rectangle area);

// Narrows x0 and x1 of the bounds to the columns that the edges can keep in the rows y and y + 1,
// give or take a pixel: a sliver costs what it covers, not what its bounds cover.
Rectangle narrowed(const std::array<Edge, 3>& edges, Rectangle bounds, int y);

// Which samples of the pixel the edges keep.
unsigned coverage(const std::array<Edge, 3>& edges, int x, int y, const SamplePattern& pattern);

// Calls visit(quad) for every quad of the area with a covered sample, rows first. Samples outside
// the area are not covered.
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

// Of a tile: 1024 for each pixel, 48 MiB.
inline constexpr std::size_t kMaxLayers = std::size_t(1) << 20;

struct TooManyLayers {};

// Colour and reversed depth of every sample of an area. Values are linear; alpha is coverage, and
// colours are premultiplied by it, as they are in a render target after blending.
class Tile {
public:
    Tile(Rectangle area, const SamplePattern& pattern);

    // Says that an opaque surface will be drawn there: what lies behind it does not pass from now on.
    void expect(int x, int y, unsigned covered, const Plane& z);

    // The samples of `covered` for which z passes: nearer than what is there, and not behind what is expected.
    unsigned nearer(int x, int y, unsigned covered, const Plane& z) const;

    // Replaces the samples and their reversed depth.
    void write(int x, int y, unsigned samples, glm::vec4 value, const Plane& z);

    // Adds a translucent layer to the samples: nothing that is written later may be behind it. Layers are composed in
    // `resolve`, by reversed depth; of equally near ones the later is in front. through: factors of what is behind, by
    // colour. Throws TooManyLayers over kMaxLayers.
    void blend(int x, int y, unsigned samples, glm::vec4 value, glm::vec3 through, const Plane& z);

    // How many pixels were written, each as often as it was.
    std::size_t written() const { return written_; }

    // Fills all samples of a pixel, behind everything.
    void clear(int x, int y, glm::vec4 value);

    // The mean of a pixel's samples, each with its layers over what was written.
    glm::vec4 resolve(int x, int y) const;

private:
    struct Layer {
        glm::vec3 light{0}; // times what it covers
        glm::vec3 through{0};
        std::array<float, 4> reversedDepth{}; // of each sample
        unsigned samples = 0;
        std::uint32_t before = 0; // the pixel's layer that was added before, kNone if none
    };
    static constexpr std::uint32_t kNone = 0xffffffff;

    std::size_t at(int x, int y) const;
    float reversedDepthAt(const Plane& z, int x, int y, std::size_t sample) const;

    Rectangle area_;
    SamplePattern pattern_;
    std::size_t samples_; // of a pixel
    std::vector<glm::vec4> value_;
    std::vector<float> reversedDepth_;
    std::vector<float> expected_; // reversed depth of the nearest surface that will be drawn; empty before the first
    std::size_t written_ = 0;
    std::vector<Layer> layers_;
    std::vector<std::uint32_t> newest_; // of each pixel; empty before the first layer
};

} // namespace cotan::reference
