// Turning spheres with highlights smaller than a pixel: the error and the flicker of one sample a pixel, with the
// roughness of each form of specular antialiasing, against 256 samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/loops.hpp"
#include "cotan/maps.hpp"
#include "cotan/portable.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "plot.hpp"
#include "scene/texture_sample.hpp"
#include "truth/grain.hpp"

namespace cotan::figures {

namespace {

constexpr int kImageSide = 64; // of the measured image, whatever the size of the panels
constexpr int kFrames = 6;     // each turned by kStep
constexpr int kTruthSide = 16; // of the truth
constexpr double kBallPixel = 2.0 / kImageSide, kStep = 0.4 * kBallPixel;
constexpr double kRim = 0.9; // outside of it nothing is measured
constexpr int kMeridians = 24, kRings = kMeridians / 2;

struct Ball {
    const char* name;
    const char* text;
    double bumps;    // slope of bumps of the surface itself; their waves are about ten pixels long
    double grain;    // as for makeGrain
    double perPixel; // texels a pixel in the middle
    double tilt;     // slope of all texels
    bool isFaceted;  // a mesh with interpolated normals
};
constexpr std::array kBalls = {
    Ball{"bumpy", "bumps, and fine grain", 0.2, 0.05, 4, 0, false},
    Ball{"grainy", "coarse grain, 4 texels a pixel", 0.1, 0.1, 4, 0, false},
    Ball{"close", "coarse grain, 1 texel a pixel", 0.1, 0.1, 1, 0, false},
    Ball{"faceted", "a mesh of 24 by 12 segments, all texels tilted", 0, 0, 1, 0.5, true},
    Ball{"smooth", "a smooth ball", 0, 0, 1, 0, false},
};
constexpr double kRoughness = 0.15;

enum class Form { nothing, curvature, filtered, length, toksvig, lean, both, shaded, twice, three };
constexpr std::array<const char*, 10> kForms = {"nothing",
                                                "curvature",
                                                "length of the filtered texel",
                                                "stored length",
                                                "Toksvig",
                                                "LEAN",
                                                "curvature and stored length",
                                                "shaded normals",
                                                "shaded normals and stored length",
                                                "three.js"};

// ---- the map and its mips ---------------------------------------------------------------------

// Means over a texel, and what mips store: the length of the mean normal, and roughness by two models.
struct Texel {
    glm::dvec3 normal{0};
    glm::dvec2 slope{0};
    double squares = 0; // of the slopes, their sum
    double length = 1, toksvig = kRoughness, lean = kRoughness;

    Texel operator+(const Texel& o) const
    {
        return {normal + o.normal, slope + o.slope,     squares + o.squares,
                length + o.length, toksvig + o.toksvig, lean + o.lean};
    }
    Texel operator*(double k) const { return {normal * k, slope * k, squares * k, length * k, toksvig * k, lean * k}; }
};

struct Level {
    int side = 0;
    std::vector<Texel> texels;

    const Texel& at(int x, int y) const
    {
        return texels[std::size_t((y % side + side) % side * side + (x % side + side) % side)];
    }
    Texel sample(glm::dvec2 uv) const
    {
        const glm::dvec2 p = uv * double(side) - 0.5, corner = glm::floor(p), w = p - corner;
        const int x = int(corner.x), y = int(corner.y);
        return (at(x, y) * (1 - w.x) + at(x + 1, y) * w.x) * (1 - w.y)
            + (at(x, y + 1) * (1 - w.x) + at(x + 1, y + 1) * w.x) * w.y;
    }
};

std::vector<Level> mipsOf(const Ball& ball)
{
    const Image grain = makeGrain(ball.grain);
    std::vector<Level> levels{{grain.width, {}}};
    for (int i = 0; i < grain.width * grain.height; ++i) {
        const glm::dvec4 c = glm::dvec4(storedComponents(grain, i % grain.width, i / grain.width)) * 255.0 - 128.0;
        const glm::dvec2 slope = ball.grain > 0 ? -glm::dvec2(c.x, c.y) / c.z : glm::dvec2(ball.tilt, 0);
        Texel texel{glm::normalize(glm::dvec3(-slope, 1))};
        texel.slope = slope, texel.squares = glm::dot(slope, slope);
        levels[0].texels.push_back(texel);
    }
    while (levels.back().side > 1) {
        Level next{levels.back().side / 2, {}};
        for (int i = 0; i < next.side * next.side; ++i) {
            const int x = i % next.side * 2, y = i / next.side * 2;
            const Level& last = levels.back();
            Texel mean = (last.at(x, y) + last.at(x + 1, y) + last.at(x, y + 1) + last.at(x + 1, y + 1)) * 0.25;
            mean.length = glm::length(mean.normal);
            mean.toksvig = maps::roughnessFromLength(kRoughness, mean.length, maps::VarianceModel::toksvig);
            mean.lean =
                maps::roughnessFromVariance(kRoughness, std::max(mean.squares - glm::dot(mean.slope, mean.slope), 0.0));
            next.texels.push_back(mean);
        }
        levels.push_back(std::move(next));
    }
    return levels;
}

Texel sampled(const std::vector<Level>& levels, glm::dvec2 uv, double lod)
{
    const double at = std::clamp(lod, 0.0, double(levels.size() - 1) - 1e-9);
    const auto lower = std::size_t(at);
    return levels[lower].sample(uv) * (double(lower) + 1 - at) + levels[lower + 1].sample(uv) * (at - double(lower));
}

// ---- the surface ------------------------------------------------------------------------------

// What a rasteriser knows at a point: two edges or derivatives, and the normal without the map.
struct Point {
    glm::dvec3 face, normal, edge1, edge2;
    glm::dvec2 uv, duv1, duv2;
};

class Turned {
public:
    Turned(const Ball& ball, double angle) : ball_(&ball)
    {
        const double c = std::cos(angle), s = std::sin(angle), tc = std::cos(0.5), ts = std::sin(0.5);
        toView_ = glm::dmat3({1, 0, 0}, {0, tc, ts}, {0, -ts, tc}) * glm::dmat3({c, 0, -s}, {0, 1, 0}, {s, 0, c});
        // Whole repeats around the equator, with `perPixel` texels in the middle.
        perRadian_ =
            std::max(1.0, std::round(2 * std::numbers::pi * ball.perPixel / kBallPixel / 256)) / 2 / std::numbers::pi;
        for (int ring = 0; ring <= kRings; ++ring)
            for (int i = 0; i <= kMeridians; ++i)
                corners_.push_back(toView_ * onSphere(anglesOf(i, ring)));
    }

    // The point that an orthographic camera sees at a point of the image, inside the rim.
    Point at(glm::dvec2 image) const
    {
        const glm::dvec3 p(image, std::sqrt(std::max(1 - glm::dot(image, image), 0.0)));
        const glm::dvec3 object = glm::transpose(toView_) * p;
        const glm::dvec2 angles(std::atan2(object.x, object.z), std::asin(std::clamp(object.y, -1.0, 1.0)));
        if (ball_->isFaceted)
            return onMesh(image, angles);
        const glm::dvec3 east(object.z, 0, -object.x); // per radian of longitude
        const double cosine = std::max(glm::length(east), 1e-6);
        return {p,
                toView_ * bumped(object),
                toView_ * east,
                toView_ * glm::cross(object, east / cosine),
                angles * perRadian_,
                {perRadian_, 0},
                {0, perRadian_}};
    }

private:
    static glm::dvec2 anglesOf(int i, int ring)
    {
        return {(double(i) / kMeridians * 2 - 1) * std::numbers::pi, (double(ring) / kRings - 0.5) * std::numbers::pi};
    }
    static glm::dvec3 onSphere(glm::dvec2 a)
    {
        return {std::sin(a.x) * std::cos(a.y), std::sin(a.y), std::cos(a.x) * std::cos(a.y)};
    }
    const glm::dvec3& corner(int i, int ring) const { return corners_[std::size_t(ring * (kMeridians + 1) + i)]; }

    glm::dvec3 bumped(glm::dvec3 p) const
    {
        constexpr double kFrequency = 0.6 / kBallPixel; // a wave of 2 pi / 0.6 pixels
        double phase = 0;
        glm::dvec3 g(0);
        for (const glm::dvec3& k : {glm::dvec3(0.9, 0.2, 0.3), glm::dvec3(-0.3, 0.8, 0.5), glm::dvec3(0.2, -0.6, 0.8),
                                    glm::dvec3(0.5, 0.5, -0.7)})
            g += k * (ball_->bumps * std::cos(glm::dot(k, p) * kFrequency + phase++));
        return f64::cotan_resolve_gradient(p, f64::cotan_gradient_of_volume(p, g));
    }

    // The triangle of the mesh at a point of the image: near the same point of the sphere.
    Point onMesh(glm::dvec2 image, glm::dvec2 angles) const
    {
        const int column = int((angles.x / std::numbers::pi + 1) / 2 * kMeridians);
        const int row = int((angles.y / std::numbers::pi + 0.5) * kRings);
        for (const int dr : {0, 1, -1})
            for (const int dc : {0, 1, -1})
                for (int half = 0; half < 2; ++half) {
                    const int c = (column + dc + kMeridians) % kMeridians, r = std::clamp(row + dr, 0, kRings - 1);
                    const int ci[3] = {c, c + 1, half ? c : c + 1}, ri[3] = {r, r + half, r + 1};
                    const glm::dvec3 p0 = corner(ci[0], ri[0]), e1 = corner(ci[1], ri[1]) - p0,
                                     e2 = corner(ci[2], ri[2]) - p0, face = glm::cross(e1, e2);
                    const glm::dvec2 d = image - glm::dvec2(p0);
                    const double b1 = (d.x * e2.y - d.y * e2.x) / face.z, b2 = (e1.x * d.y - e1.y * d.x) / face.z;
                    if (!(face.z > 1e-9) || b1 < -1e-9 || b2 < -1e-9 || b1 + b2 > 1 + 1e-9)
                        continue;
                    const glm::dvec2 uv0 = anglesOf(ci[0], ri[0]) * perRadian_,
                                     d1 = anglesOf(ci[1], ri[1]) * perRadian_ - uv0,
                                     d2 = anglesOf(ci[2], ri[2]) * perRadian_ - uv0;
                    return {glm::normalize(face),
                            glm::normalize(p0 + e1 * b1 + e2 * b2),
                            e1,
                            e2,
                            uv0 + d1 * b1 + d2 * b2,
                            d1,
                            d2};
                }
        return {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0}, {1, 0}, {0, 1}}; // beyond the silhouette
    }

    const Ball* ball_;
    glm::dmat3 toView_{1};
    double perRadian_ = 1;
    std::vector<glm::dvec3> corners_;
};

// ---- shading ----------------------------------------------------------------------------------

double luminance(glm::dvec3 n, double roughness)
{
    const glm::dvec3 l = glm::normalize(glm::dvec3(-0.5, 0.45, 0.75));
    return std::max(glm::dot(n, l), 0.0) * (0.05 + 0.3 * f64::cotan_ggx(n, {0, 0, 1}, l, roughness));
}

glm::dvec3 perturbed(const Point& p, glm::dvec3 texel)
{
    return f64::cotan_apply(f64::cotan_frame_cotangent(p.normal, p.edge1, p.edge2, p.duv1, p.duv2), texel);
}

struct Pixel {
    glm::dvec3 smooth, shaded;
    Texel map;
};

Pixel pixelAt(const Turned& surface, const std::vector<Level>& mips, glm::dvec2 image)
{
    const Point p = surface.at(image);
    const f64::cotan_frame g = f64::cotan_frame_gradient(p.face, p.edge1, p.edge2, p.duv1, p.duv2);
    const auto moved = [&](glm::dvec2 d) { // along the surface, by one pixel
        const glm::dvec3 step(d, -glm::dot(d, glm::dvec2(p.face)) / p.face.z);
        return glm::length(glm::dvec2(glm::dot(g.t, step), glm::dot(g.b, step))) * mips[0].side;
    };
    const double lod = std::log2(std::max({moved({kBallPixel, 0}), moved({0, kBallPixel}), 1e-6}));
    const Texel map = sampled(mips, p.uv, lod);
    return {p.normal, perturbed(p, map.normal), map};
}

double roughnessOf(Form form, const Pixel& at, const Pixel& right, const Pixel& below)
{
    const auto with = [](double variance) { return f64::cotan_roughness_of_variance(kRoughness, variance); };
    const double curvature = f64::cotan_variance_of_curvature(right.smooth - at.smooth, below.smooth - at.smooth);
    const double shaded = f64::cotan_variance_of_curvature(right.shaded - at.shaded, below.shaded - at.shaded);
    const double stored = f64::cotan_variance_of_length(at.map.length);
    switch (form) {
    case Form::nothing: break;
    case Form::curvature: return with(curvature);
    case Form::filtered: return with(f64::cotan_variance_of_length(glm::length(at.map.normal)));
    case Form::length: return with(stored);
    case Form::toksvig: return at.map.toksvig;
    case Form::lean: return at.map.lean;
    case Form::both: return with(curvature + stored);
    case Form::shaded: return with(shaded);
    case Form::twice: return with(shaded + stored);
    case Form::three: { // lights_physical_fragment of r187: the largest difference is added to the roughness
        const glm::dvec3 d = glm::max(glm::abs(right.smooth - at.smooth), glm::abs(below.smooth - at.smooth));
        return std::min(std::max(kRoughness, 0.0525) + std::max({d.x, d.y, d.z}), 1.0);
    }
    }
    return kRoughness;
}

glm::dvec2 onImage(double x, double y) { return {x * kBallPixel - 1, 1 - y * kBallPixel}; }

double trueLuminance(const Turned& surface, const std::vector<Level>& mips, int x, int y)
{
    double sum = 0;
    for (int i = 0; i < kTruthSide * kTruthSide; ++i) {
        const Point p =
            surface.at(onImage(x + (i % kTruthSide + 0.5) / kTruthSide, y + (i / kTruthSide + 0.5) / kTruthSide));
        sum += luminance(perturbed(p, mips[0].sample(p.uv).normal), kRoughness);
    }
    return sum / (kTruthSide * kTruthSide);
}

// Displayed values of one image for each form, and of the truth at the end. 0 outside of the rim.
using Values = std::array<std::vector<double>, kForms.size() + 1>;
Values valuesAt(const Ball& ball, const std::vector<Level>& mips, double angle)
{
    Values values;
    for (std::vector<double>& v : values)
        v.resize(kImageSide * kImageSide);
    const Turned surface(ball, angle);
    parallelFor(0, kImageSide, [&](int y) {
        for (int x = 0; x < kImageSide; ++x) {
            const glm::dvec2 image = onImage(x + 0.5, y + 0.5);
            if (glm::length(image) > kRim)
                continue;
            const Pixel at = pixelAt(surface, mips, image);
            const Pixel right = pixelAt(surface, mips, image + glm::dvec2(kBallPixel, 0));
            const Pixel below = pixelAt(surface, mips, image - glm::dvec2(0, kBallPixel));
            const auto i = std::size_t(y * kImageSide + x);
            for (std::size_t f = 0; f < kForms.size(); ++f)
                values[f][i] = f64::cotan_tone(luminance(at.shaded, roughnessOf(Form(f), at, right, below)));
            values.back()[i] = f64::cotan_tone(trueLuminance(surface, mips, x, y));
        }
    });
    return values;
}

Image shown(const std::vector<double>& values, int side)
{
    Image image = makeImage(side, side, PixelType::unorm8, "flicker");
    for (int i = 0; i < side * side; ++i) {
        const int x = i % side * kImageSide / side, y = i / side * kImageSide / side;
        const double v = f64::cotan_linear_to_srgb(values[std::size_t(y * kImageSide + x)]);
        std::uint8_t* const out = image.bytes8() + 4 * i;
        out[0] = out[1] = out[2] = std::uint8_t(std::lround(v * 255));
        out[3] = 255;
    }
    return image;
}

void addBall(Figure& figure, const Ball& ball, int side)
{
    const std::vector<Level> mips = mipsOf(ball);
    std::array<double, kForms.size()> errors{}, flickers{};
    Values last, first;
    std::size_t pixels = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        Values now = valuesAt(ball, mips, 0.3 + frame * kStep);
        for (std::size_t i = 0; i < now[0].size(); ++i) {
            pixels += frame == 0 && now.back()[i] > 0;
            for (std::size_t f = 0; f < kForms.size(); ++f) {
                const double error = now[f][i] - now.back()[i];
                errors[f] += error * error;
                const double change = frame == 0 ? 0 : error - (last[f][i] - last.back()[i]);
                flickers[f] += change * change;
            }
        }
        if (frame == 0)
            first = now;
        last = std::move(now);
    }
    for (std::size_t f = 0; f < kForms.size(); ++f) {
        const double error = std::sqrt(errors[f] / double(pixels * kFrames));
        const double flicker = std::sqrt(flickers[f] / double(pixels * (kFrames - 1)));
        figure.numbers.push_back({fmt::format("{}, {}, error", ball.name, kForms[f]), error});
        figure.numbers.push_back({fmt::format("{}, {}, flicker", ball.name, kForms[f]), flicker});
        const auto form = Form(f);
        if (form == Form::nothing || form == Form::both || (form == Form::twice && ball.isFaceted))
            figure.panels.push_back({fmt::format("{}-{}", ball.name, f), fmt::format("{}: {}", ball.text, kForms[f]),
                                     fmt::format("Error {:.3f}, flicker {:.3f}.", error, flicker),
                                     shown(first[f], side)});
    }
    figure.panels.push_back(
        {fmt::format("{}-truth", ball.name), fmt::format("{}: 256 samples", ball.text), "", shown(first.back(), side)});
}

} // namespace

Figure makeFlickerFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Turning spheres that sparkle";
    figure.text = {
        "Metal spheres of roughness 0.15 under one lamp, 58 pixels wide and enlarged, with one sample a pixel and the "
        "roughness of each form of specular antialiasing. \"Curvature\" takes differences of the interpolated normals, "
        "\"shaded normals\" of those with the map, as a G-buffer has them. The others are variances from the map's "
        "mips: from the length of the filtered texel, or stored in a channel or in a roughness map.",
        "Errors are root mean squares of displayed values against 256 samples. Flicker is the root mean square of the "
        "change of the error between two images, while the sphere turns by 0.4 pixels."};
    for (const Ball& ball : kBalls)
        addBall(figure, ball, studio.height());
    figure.sliders = {{0, 1}, {9, 11}};
    return figure;
}

} // namespace cotan::figures
