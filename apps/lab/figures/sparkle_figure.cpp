// Highlights smaller than a pixel: one sample per pixel with and without antialiasing, compared with 256 samples.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "figure.hpp"
#include "scene/render_text.hpp"
#include "stage.hpp"
#include "truth/grain.hpp"

namespace cotan::figures {

namespace {

constexpr int kSamplesPerSide = 16; // samples along a side of a pixel in the ground truth
constexpr int kMagnification = 3;   // panel pixels along a side of a drawn pixel
constexpr int kMaxDrawn = 160;      // maximum side of a drawn image: the ground truth takes 256 times its memory

Scene sparkling(Image map)
{
    Scene scene = sceneOf(makeTorus(0.8f, 0.35f, 96, 12, 3), std::move(map), metal({0.9f, 0.9f, 0.9f}, 0.3f));
    scene.materials[0].normalMap.sampler = Sampler{};
    return scene;
}

View sparklingView(int side)
{
    View view;
    view.width = view.height = side;
    view.samples = 1;
    view.linearOutput = true;
    view.shadows = false;
    view.camera.eye = {0.4f, 1.6f, 3};
    view.camera.target = {0, 0, 0};
    view.camera.verticalFieldOfView = 0.75f;
    Light sun = upperLeft();
    sun.intensity = 3;
    view.lights = {sun};
    return view;
}

Image averaged(const Image& fine)
{
    Image out = makeImage(fine.width / kSamplesPerSide, fine.height / kSamplesPerSide, PixelType::float32);
    for (int y = 0; y < out.height * kSamplesPerSide; ++y)
        for (int x = 0; x < out.width * kSamplesPerSide; ++x)
            for (int c = 0; c < 4; ++c)
                out.floats()[(y / kSamplesPerSide * out.width + x / kSamplesPerSide) * 4 + c] +=
                    fine.floats()[(y * fine.width + x) * 4 + c] / float(kSamplesPerSide * kSamplesPerSide);
    return out;
}

glm::vec3 colorOf(const Image& linear, std::size_t pixel)
{
    const float* const p = linear.floats() + 4 * pixel;
    return f32::cotan_tone_of(int(ToneMapping::neutral), glm::vec3(p[0], p[1], p[2]));
}

Image enlarged(const Image& linear)
{
    Image out = makeImage(linear.width * kMagnification, linear.height * kMagnification, PixelType::unorm8);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const glm::vec3 c = colorOf(linear, std::size_t(y / kMagnification * linear.width + x / kMagnification));
            std::uint8_t* const p = out.bytes8() + 4 * (y * out.width + x);
            for (int k = 0; k < 3; ++k)
                p[k] = std::uint8_t(std::lround(255 * f32::cotan_linear_to_srgb(c[k])));
            p[3] = 255;
        }
    return out;
}

// Root mean square difference of the displayed colours.
double error(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i) {
        const glm::vec3 d = colorOf(a, i) - colorOf(b, i);
        sum += double(glm::dot(d, d)) / 3;
    }
    return std::sqrt(sum / double(a.pixelCount()));
}

void addRow(FigureRenderer& studio, Figure& figure, const std::string& name, Image map)
{
    const Scene scene = sparkling(std::move(map));
    Scene finest = scene; // smaller levels of the map would have lost the detail in question
    finest.materials[0].normalMap.sampler.mip = MipFilter::none;
    studio.show(finest);
    const int side = std::clamp(studio.height() / kMagnification, 8, kMaxDrawn);
    const Image truth = averaged(studio.drawReference(sparklingView(side * kSamplesPerSide)));
    studio.show(scene);
    View view = sparklingView(side);
    const Image without = studio.drawReference(view);
    view.specularAntialiasing = true;
    const Image with = studio.drawReference(view);
    const double before = error(without, truth), after = error(with, truth);
    figure.panels.push_back(
        {name + "-none", name + ", one sample per pixel", fmt::format("Error {:.3f}.", before), enlarged(without)});
    figure.panels.push_back({name + "-antialiased", name + ", with --specular-antialiasing",
                             fmt::format("Error {:.3f}: {:.2f} times that.", after, after / before), enlarged(with)});
    figure.panels.push_back({name + "-truth", name + ", 256 samples per pixel", "", enlarged(truth)});
    figure.numbers.push_back({name + ", error without", before});
    figure.numbers.push_back({name + ", error with", after});
}

} // namespace

Figure makeSparkleFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Highlights smaller than a pixel";
    figure.text = {"A metal ring with a normal map of grain, and one with domes, many texels per pixel; pixels are "
                   "enlarged. Averaged normals give too few highlights, which are too bright. Specular antialiasing "
                   "lights 16 to 256 points of each pixel, more for sharper highlights, each with the roughness that "
                   "follows from the lost length of its normal. Errors are root mean squares of displayed colours. All "
                   "by the reference renderer."};
    addRow(studio, figure, "grain", makeGrain(0.135));
    addRow(studio, figure, "domes", makeReliefMap(Relief::domes, 256));
    figure.sliders = {{0, 1}, {3, 4}};
    figure.overview = {0, 1};
    return figure;
}

} // namespace cotan::figures
