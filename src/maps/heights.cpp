// Normal maps from heights, and heights from normal maps.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cotan/maps.hpp"
#include "fft.hpp"
#include "maps/texels.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::maps {

namespace {

// Weights of a kernel across its derivative: of the neighbours on one side, the middle, the other side.
constexpr std::array<float, 3> weightsAcross(Kernel kernel)
{
    if (kernel == Kernel::sobel)
        return {0.25f, 0.5f, 0.25f};
    if (kernel == Kernel::scharr)
        return {3.0f / 16, 10.0f / 16, 3.0f / 16};
    return {0, 1, 0};
}

// ---- from heights ------------------------------------------------------------------------------

// i: from -1 to size. Mirroring repeats the edge texel there.
int wrapped(int i, int size, Wrap wrap)
{
    return wrapTexel(i, size,
                     wrap == Wrap::clamp        ? cotan::Wrap::clamp
                         : wrap == Wrap::repeat ? cotan::Wrap::repeat
                                                : cotan::Wrap::mirror);
}

// Loads a row of heights, padded by one texel at either end.
void loadHeights(const Image& image, int row, Wrap wrap, std::vector<float>& heights)
{
    const int y = wrapped(row, image.height, wrap);
    heights.resize(std::size_t(image.width) + 2);
    for (int x = 0; x < image.width; ++x)
        heights[std::size_t(x) + 1] = storedComponents(image, x, y).x;
    heights.front() = heights[std::size_t(wrapped(-1, image.width, wrap)) + 1];
    heights.back() = heights[std::size_t(wrapped(image.width, image.width, wrap)) + 1];
}

// Differences of height per texel, to the right and up the image. x indexes the padded rows.
glm::vec2 difference(const std::vector<float>& above, const std::vector<float>& here, const std::vector<float>& below,
                     std::size_t x, Kernel kernel)
{
    if (kernel == Kernel::forward)
        return {here[x + 1] - here[x], above[x] - here[x]};
    if (kernel == Kernel::central) // no weights of 0, which would let a NaN corner through
        return 0.5f * glm::vec2(here[x + 1] - here[x - 1], above[x] - below[x]);
    const std::array<float, 3> weights = weightsAcross(kernel == Kernel::sobel ? kernel : Kernel::scharr);
    const float side = weights[0], middle = weights[1];
    const float right = side * (above[x + 1] + below[x + 1]) + middle * here[x + 1];
    const float left = side * (above[x - 1] + below[x - 1]) + middle * here[x - 1];
    const float up = side * (above[x - 1] + above[x + 1]) + middle * above[x];
    const float down = side * (below[x - 1] + below[x + 1]) + middle * below[x];
    return 0.5f * glm::vec2(right - left, up - down);
}

// ---- to heights --------------------------------------------------------------------------------

// Frequencies at which the kernel keeps less than this fraction of the slope's power are not reconstructed.
constexpr double kLeast = 0.02;

// Loads the slopes of a row, per texel width, to the right and DOWN the image. Heights are in texel widths. Returns the
// number of texels without a direction.
std::size_t loadSlopes(const Image& map, int row, const ToHeightSettings& s, std::vector<glm::vec3>& normals,
                       std::vector<glm::vec2>& slopes)
{
    decodeRow(map, row, s.from, normals);
    std::size_t invalid = 0;
    for (std::size_t x = 0; x < normals.size(); ++x) {
        const glm::vec3 n = normals[x];
        invalid += n == glm::vec3(0);
        const float z = std::max({n.z, std::max(std::abs(n.x), std::abs(n.y)) / kSteepestSlope, 1e-20f});
        slopes[x] = n == glm::vec3(0) ? glm::vec2(0) : glm::vec2(-n.x / z, n.y / z * float(s.aspect));
    }
    return invalid;
}

// Frequency response of a kernel at (x, y), in radians per texel: of its x derivative and of its y derivative.
std::array<Complex, 2> response(Kernel kernel, double x, double y)
{
    const Complex i(0, 1);
    const auto spectral = [&](double w) { return std::abs(w) > std::numbers::pi - 1e-9 ? 0.0 : w; };
    const auto across = [&](double w) {
        return kernel == Kernel::sobel ? (1 + std::cos(w)) / 2
            : kernel == Kernel::scharr ? (5 + 3 * std::cos(w)) / 8
                                       : 1.0;
    };
    if (kernel == Kernel::spectral)
        return {i * spectral(x), i * spectral(y)};
    if (kernel == Kernel::forward) // in y: this row minus the one above, as in difference()
        return {std::polar(1.0, x) - 1.0, 1.0 - std::polar(1.0, -y)};
    return {i * std::sin(x) * across(y), i * std::sin(y) * across(x)};
}

double frequency(std::size_t k, std::size_t n)
{
    const double signedK = 2 * k <= n ? double(k) : double(k) - double(n);
    return 2 * std::numbers::pi * signedK / double(n);
}

using Grid = std::vector<std::complex<float>>; // stored in single precision, transformed in double

// Calls work(row) for every row of a grid, converted to Number.
template<class Number, class Stored, class Work>
void eachRow(std::vector<Stored>& grid, int width, int height, const Work& work)
{
    forRowBands(width, height, [&](int first, int last) {
        std::vector<Number> row(std::size_t(width), 0);
        for (int y = first; y < last; ++y) {
            const auto at = grid.begin() + std::ptrdiff_t(y) * width;
            std::copy_n(at, width, row.begin());
            work(std::span(row));
            std::ranges::transform(row, at, [](Number number) { return Stored(number); });
        }
    });
}

// Calls work(column) for every column; copies several columns at a time for cache locality.
template<class Number, class Stored, class Work>
void eachColumn(std::vector<Stored>& grid, int width, int height, const Work& work)
{
    forRowBands(height, width, [&](int first, int last) {
        const std::size_t count = std::size_t(last - first), rows = std::size_t(height);
        std::vector<Number> columns(count * rows);
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < count; ++x)
                columns[x * rows + y] = Number(grid[y * std::size_t(width) + std::size_t(first) + x]);
        for (std::size_t x = 0; x < count; ++x)
            work(std::span(columns).subspan(x * rows, rows));
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < count; ++x)
                grid[y * std::size_t(width) + std::size_t(first) + x] = Stored(columns[x * rows + y]);
    });
}

// Sums over a row of slopes: their squares, and the squares of the residual that no height explains.
struct Power {
    double slope = 0, residual = 0;
    glm::dvec2 slopes{0}; // the sum of the slopes themselves
};

Power total(const std::vector<Power>& rows)
{
    Power all;
    for (const Power& row : rows)
        all.slope += row.slope, all.residual += row.residual, all.slopes += row.slopes;
    return all;
}

// Replaces, in place, the transform of p + i q by that of the height. Handles frequencies k and -k together, because
// separating P from Q needs both.
Power solve(Grid& grid, std::size_t width, std::size_t height, Kernel kernel)
{
    std::vector<Power> rows(height / 2 + 1);
    forRowBands(int(width), int(rows.size()), [&](int first, int last) {
        for (std::size_t y = std::size_t(first); y < std::size_t(last); ++y) {
            const std::size_t minusY = (height - y) % height;
            // Row y is its own mirror: the other half of it is handled together with the first.
            const std::size_t end = y == minusY ? width / 2 + 1 : width;
            for (std::size_t x = 0; x < end; ++x) {
                const std::size_t minusX = (width - x) % width;
                std::complex<float>&a = grid[y * width + x], &b = grid[minusY * width + minusX];
                const Complex za(a), zb = std::conj(Complex(b));
                const Complex p = 0.5 * (za + zb), q = Complex(0, -0.5) * (za - zb);
                const double wx = frequency(x, width), wy = frequency(y, height);
                const auto [dx, dy] = response(kernel, wx, wy);
                const double power = std::norm(dx) + std::norm(dy);
                const bool usable = power > kLeast * (wx * wx + wy * wy) && power > 0;
                const Complex h = usable ? (std::conj(dx) * p + std::conj(dy) * q) / power : Complex(0);
                const double twice = &a == &b ? 1 : 2;
                rows[y].slope += twice * (std::norm(p) + std::norm(q));
                rows[y].residual += twice * (std::norm(p - dx * h) + std::norm(q - dy * h));
                a = std::complex<float>(h);
                b = std::complex<float>(std::conj(h));
            }
        }
    });
    return total(rows);
}

void solvePeriodic(const Image& map, const ToHeightSettings& s, Heights& result)
{
    const int width = map.width, height = map.height;
    Grid grid(map.pixelCount());
    std::atomic<std::size_t> invalid = 0;
    forRowBands(width, height, [&](int first, int last) {
        std::vector<glm::vec3> normals(std::size_t(width), glm::vec3(0));
        std::vector<glm::vec2> slopes(normals.size());
        for (int y = first; y < last; ++y) {
            invalid += loadSlopes(map, y, s, normals, slopes);
            for (std::size_t x = 0; x < slopes.size(); ++x)
                grid[std::size_t(y) * slopes.size() + x] = {slopes[x].x, slopes[x].y};
        }
    });
    result.invalid = invalid;
    const Fft across{std::size_t(width)}, down{std::size_t(height)};
    eachRow<Complex>(grid, width, height, [&](std::span<Complex> row) { across.forward(row); });
    eachColumn<Complex>(grid, width, height, [&](std::span<Complex> column) { down.forward(column); });
    const double n = double(map.pixelCount());
    result.meanTilt = std::atan(double(std::abs(grid[0])) / n) * 180 / std::numbers::pi;
    const Power power = solve(grid, std::size_t(width), std::size_t(height), s.kernel);
    result.slope = std::sqrt(power.slope) / n; // Parseval: sum |x|^2 = sum |X|^2 / N
    result.residual = std::sqrt(power.residual) / n;
    eachColumn<Complex>(grid, width, height, [&](std::span<Complex> column) { down.inverse(column); });
    eachRow<Complex>(grid, width, height, [&](std::span<Complex> row) { across.inverse(row); });
    result.texels.resize(grid.size());
    std::ranges::transform(grid, result.texels.begin(), [](std::complex<float> c) { return c.real(); });
}

// Calls work(x, y, slopes of the row above, of this row, of the row below). Bands of rows run concurrently: work may
// only write data of row y. Returns the number of texels without a direction.
template<class Work> std::size_t eachSlope(const Image& map, const ToHeightSettings& s, Work work)
{
    std::atomic<std::size_t> invalid = 0;
    forRowBands(map.width, map.height, [&](int first, int last) {
        const std::size_t width = std::size_t(map.width);
        std::vector<glm::vec3> normals(width);
        std::vector<glm::vec2> above(width), here(width), below(width);
        if (first > 0)
            loadSlopes(map, first - 1, s, normals, above);
        invalid += loadSlopes(map, first, s, normals, here);
        for (int y = first; y < last; ++y) {
            if (y + 1 < map.height) {
                const std::size_t bad = loadSlopes(map, y + 1, s, normals, below);
                invalid += y + 1 < last ? bad : 0;
            }
            for (std::size_t x = 0; x < width; ++x)
                work(x, y, above, here, below);
            above.swap(here);
            here.swap(below);
        }
    });
    return invalid;
}

using Row = std::vector<glm::vec2>;

// The adjoint of the slope operator: the kernel's negative divergence.
float transposed(Kernel kernel, const Row* const rows[3], int x, int width, bool top, bool bottom)
{
    // Slopes beyond the border, where heights repeat the border's own. The slope component across the border is
    // mirrored with opposite sign.
    const auto at = [&](int dx, int dy) -> glm::vec2 {
        const bool outsideY = (dy < 0 && top) || (dy > 0 && bottom), outsideX = x + dx < 0 || x + dx >= width;
        const glm::vec2 s = (*rows[outsideY ? 1 : 1 + dy])[std::size_t(std::clamp(x + dx, 0, width - 1))];
        return {outsideX ? -s.x : s.x, outsideY ? -s.y : s.y};
    };
    if (kernel == Kernel::forward) { // the last column and the first row have no slope
        const float right = x + 1 < width ? at(0, 0).x : 0, left = x > 0 ? at(-1, 0).x : 0;
        return left - right + (top ? 0 : at(0, 0).y) - (bottom ? 0 : at(0, 1).y);
    }
    const auto weights = weightsAcross(kernel);
    float sum = 0;
    for (int k = -1; k <= 1; ++k)
        sum += 0.5f * weights[std::size_t(k + 1)] * (at(-1, k).x - at(1, k).x + at(k, -1).y - at(k, 1).y);
    return sum;
}

// The kernel's slope of the heights, to the right and down the image; clamped at the borders.
glm::vec2 slopeOf(Kernel kernel, const std::vector<float>& heights, int x, int y, int width, int height)
{
    const auto at = [&](int dx, int dy) {
        return heights[std::size_t(std::clamp(y + dy, 0, height - 1)) * std::size_t(width)
                       + std::size_t(std::clamp(x + dx, 0, width - 1))];
    };
    if (kernel == Kernel::forward)
        return {at(1, 0) - at(0, 0), at(0, 0) - at(0, -1)};
    const auto weights = weightsAcross(kernel);
    glm::vec2 sum(0);
    for (int k = -1; k <= 1; ++k)
        sum += 0.5f * weights[std::size_t(k + 1)] * glm::vec2(at(1, k) - at(-1, k), at(k, 1) - at(k, -1));
    return sum;
}

// Replaces, in place, the right-hand side of the normal equations by the heights. power(x, y): squared response of the
// slopes to a cosine of that frequency; if it is not positive, the frequency is set to 0.
template<class PowerOf> void divide(std::vector<float>& h, int width, int height, PowerOf power)
{
    const Fft across{std::size_t(width)}, down{std::size_t(height)};
    eachRow<double>(h, width, height, [&](std::span<double> row) { cosineForward(across, row); });
    eachColumn<double>(h, width, height, [&](std::span<double> column) { cosineForward(down, column); });
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double p = power(std::numbers::pi * x / width, std::numbers::pi * y / height);
            float& v = h[std::size_t(y) * std::size_t(width) + std::size_t(x)];
            v = p > 0 ? float(double(v) / p) : 0.0f;
        }
    eachRow<double>(h, width, height, [&](std::span<double> row) { cosineInverse(across, row); });
    eachColumn<double>(h, width, height, [&](std::span<double> column) { cosineInverse(down, column); });
}

// The target difference between neighbours is the mean of their slopes; there is none across the border. Solves
// Poisson's equation with the negative divergence of these differences.
void solveFreeSpectral(const Image& map, const ToHeightSettings& s, Heights& result)
{
    const std::size_t width = std::size_t(map.width), height = std::size_t(map.height);
    std::vector<float>& h = result.texels;
    result.invalid = eachSlope(map, s, [&](std::size_t x, int y, const Row& above, const Row& here, const Row& below) {
        float d = 0;
        d -= x + 1 < width ? 0.5f * (here[x].x + here[x + 1].x) : 0;
        d += x > 0 ? 0.5f * (here[x - 1].x + here[x].x) : 0;
        d -= std::size_t(y) + 1 < height ? 0.5f * (here[x].y + below[x].y) : 0;
        d += y > 0 ? 0.5f * (above[x].y + here[x].y) : 0;
        h[std::size_t(y) * width + x] = d;
    });
    divide(h, map.width, map.height, [](double x, double y) { return 4 - 2 * std::cos(x) - 2 * std::cos(y); });
}

// Least squares over the kernel's slopes of heights that are clamped at the borders.
void solveFreeKernel(const Image& map, const ToHeightSettings& s, Heights& result)
{
    const int width = map.width, height = map.height;
    result.invalid = eachSlope(map, s, [&](std::size_t x, int y, const Row& above, const Row& here, const Row& below) {
        const Row* const rows[3] = {&above, &here, &below};
        result.texels[std::size_t(y) * std::size_t(width) + x] =
            transposed(s.kernel, rows, int(x), width, y == 0, y == height - 1);
    });
    divide(result.texels, width, height, [&](double x, double y) {
        const auto [dx, dy] = response(s.kernel, x, y);
        const double power = std::norm(dx) + std::norm(dy);
        return power > kLeast * (x * x + y * y) ? power : 0;
    });
}

void solveFree(const Image& map, const ToHeightSettings& s, Heights& result)
{
    const std::size_t width = std::size_t(map.width), height = std::size_t(map.height);
    std::vector<float>& h = result.texels;
    h.resize(map.pixelCount());
    const bool spectral = s.kernel == Kernel::spectral;
    spectral ? solveFreeSpectral(map, s, result) : solveFreeKernel(map, s, result);

    std::vector<Power> rows(height);
    eachSlope(map, s, [&](std::size_t x, int y, const Row&, const Row& here, const Row& below) {
        Power& power = rows[std::size_t(y)];
        if (spectral) {
            const float* at = h.data() + std::size_t(y) * width + x;
            double off = 0;
            if (x + 1 < width)
                off += std::pow(double(at[1] - at[0] - 0.5f * (here[x].x + here[x + 1].x)), 2);
            if (std::size_t(y) + 1 < height)
                off += std::pow(double(at[width] - at[0] - 0.5f * (here[x].y + below[x].y)), 2);
            power.residual += off;
        } else {
            const glm::dvec2 off = here[x] - slopeOf(s.kernel, h, int(x), y, map.width, map.height);
            const bool forward = s.kernel == Kernel::forward; // has no slope in the last column and first row
            power.residual += forward && x + 1 == width ? 0 : off.x * off.x;
            power.residual += forward && y == 0 ? 0 : off.y * off.y;
        }
        power.slope += double(glm::dot(here[x], here[x]));
        power.slopes += glm::dvec2(here[x]);
    });
    const Power all = total(rows);
    const double n = double(map.pixelCount());
    result.slope = std::sqrt(all.slope / n);
    result.residual = std::sqrt(all.residual / n);
    result.meanTilt = std::atan(glm::length(all.slopes) / n) * 180 / std::numbers::pi;
}

} // namespace

Image normalsFromHeight(const Image& height, const FromHeightSettings& s, std::size_t& invalid)
{
    const int border = s.bordered ? 1 : 0;
    Image out = makeImage(height.width, height.height - 2 * border, s.type, height.name);
    const std::size_t width = std::size_t(height.width);
    const glm::vec2 scale(float(s.scaleX), float(s.scaleY));
    std::atomic<std::size_t> bad = 0;
    forRowBands(out.width, out.height, [&](int first, int last) {
        std::vector<float> above, here, below;
        std::vector<glm::vec4> texels(width);
        std::size_t badHere = 0;
        loadHeights(height, first - 1 + border, s.wrap, above);
        loadHeights(height, first + border, s.wrap, here);
        for (int y = first; y < last; ++y) {
            loadHeights(height, y + 1 + border, s.wrap, below);
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec2 slope = difference(above, here, below, x + 1, s.kernel) * scale;
                const bool finite = std::isfinite(slope.x) && std::isfinite(slope.y);
                badHere += !finite;
                const glm::vec3 normal = finite ? glm::normalize(glm::vec3(-slope, 1)) : glm::vec3(0, 0, 1);
                texels[x] = encodeTexel(normal, s.to, s.type);
            }
            if (s.dither)
                ditherRow(texels, s.type, s.firstRow + y);
            storeRow(out, y, texels);
            above.swap(here);
            here.swap(below);
        }
        bad += badHere;
    });
    invalid = bad;
    return out;
}

Heights heightFromNormals(const Image& map, const ToHeightSettings& settings)
{
    Heights result;
    if (settings.boundary == Boundary::periodic)
        solvePeriodic(map, settings, result);
    else
        solveFree(map, settings, result);
    const auto [lowest, highest] = std::ranges::minmax(result.texels);
    result.lowest = lowest;
    result.highest = highest;
    return result;
}

std::size_t heightWorkBytes(int width, int height) { return std::size_t(width) * std::size_t(height) * 12; }

} // namespace cotan::maps
