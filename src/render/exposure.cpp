#include "cotan/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/picture_text.hpp"
#include "scene/sample_places.hpp"

namespace cotan {

namespace {

constexpr double kMaxPixels = 20000;
constexpr float kProbe = 0.25f; // exposure of the small picture: so much more fits under a tone curve's end
constexpr float kGrey = 0.2f;   // where the mean goes
constexpr float kPart = 0.35f;  // of the way, in stops
constexpr float kDarkestMean = 0.045f, kBrightestMean = 0.45f;
constexpr float kBrightest = 0.92f; // of the brightest fiftieth

// Grey light in steps of 1/8 of a stop.
float lightAt(float step) { return std::exp2(step / 8 - 12); }

// What a curve shows of each step, ascending, to a light of 2^8.
using ShownSteps = std::array<float, 161>;

// The light that a curve shows so.
float undone(const ShownSteps& steps, float shown)
{
    const auto above = std::upper_bound(steps.begin(), steps.end(), shown);
    if (above == steps.begin())
        return lightAt(0);
    if (above == steps.end())
        return lightAt(float(steps.size() - 1));
    const float low = *(above - 1);
    return lightAt(float(above - steps.begin() - 1) + (shown - low) / (*above - low));
}

// Of the pixels that the scene covers.
std::vector<float> brightness(const Image& picture, ToneMapping tone)
{
    ShownSteps steps{};
    for (std::size_t i = 0; i < steps.size(); ++i)
        steps[i] = f32::cotan_tone_of(int(tone), glm::vec3(lightAt(float(i)))).y;
    std::vector<float> found;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
        const std::uint8_t* p = picture.bytes8() + 4 * i;
        if (p[3] < 128)
            continue;
        const auto linear = [&](int c) { return f32::cotan_srgb_to_linear(float(p[c]) / 255); };
        found.push_back(undone(steps, 0.2126f * linear(0) + 0.7152f * linear(1) + 0.0722f * linear(2)) / kProbe);
    }
    return found;
}

} // namespace

Result<float> meterExposure(Renderer& renderer, View view)
{
    const double scale = std::min(1.0, std::sqrt(kMaxPixels / (double(view.width) * view.height)));
    view.width = std::max(1, int(view.width * scale));
    view.height = std::max(1, int(view.height * scale));
    view.output = Output::shaded;
    view.linearOutput = false;
    view.dither = false;
    view.samples = std::min(view.samples, kMaxSharedSamples);
    view.background = false;
    view.ground.reset();
    view.exposure = kProbe;
    const auto picture = renderer.draw(view);
    if (!picture)
        return picture.error();
    std::vector<float> found = brightness(*picture, view.toneMapping);
    if (found.empty())
        return 1.0f;
    double logarithms = 0;
    for (const float b : found)
        logarithms += std::log2(std::max(double(b), 1e-3));
    const float mean = float(std::exp2(logarithms / double(found.size())));
    const auto bright = found.begin() + std::ptrdiff_t(found.size() * 49 / 50);
    std::nth_element(found.begin(), bright, found.end());
    const float wanted = std::clamp(mean * std::pow(kGrey / mean, kPart), kDarkestMean, kBrightestMean);
    const float exposure = std::min(wanted / mean, kBrightest / *bright);
    return std::exp2(std::round(32 * std::log2(exposure)) / 32);
}

} // namespace cotan
