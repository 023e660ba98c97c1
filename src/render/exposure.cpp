#include "cotan/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/try.hpp"
#include "scene/render_text.hpp"
#include "scene/sample_positions.hpp"

namespace cotan {

namespace {

constexpr double kMaxPixels = 20000;
constexpr float kMeterExposure = 0.25f; // exposure of the metering render: leaves headroom in the tone curve
constexpr float kGrey = 0.2f;           // target of the mean
constexpr float kGreyFraction = 0.35f;  // fraction of the way to the target, in stops
constexpr float kDarkestMean = 0.045f, kBrightestMean = 0.45f;
constexpr float kBrightest = 0.92f; // limit for the brightest 2 %

// Grey light in steps of 1/8 of a stop.
float lightAt(float step) { return std::exp2(step / 8 - 12); }

// Displayed value of each step, ascending, up to a light of 2^8.
using DisplayedSteps = std::array<float, 161>;

// Inverts the tone curve: the linear light that is displayed as `displayed`.
float invertToneCurve(const DisplayedSteps& steps, float displayed)
{
    const auto above = std::upper_bound(steps.begin(), steps.end(), displayed);
    if (above == steps.begin())
        return lightAt(0);
    if (above == steps.end())
        return lightAt(float(steps.size() - 1));
    const float low = *(above - 1);
    return lightAt(float(above - steps.begin() - 1) + (displayed - low) / (*above - low));
}

// Luminance of each pixel that the scene covers, before exposure and tone mapping.
std::vector<float> luminances(const Image& image, ToneMapping tone)
{
    DisplayedSteps steps{};
    for (std::size_t i = 0; i < steps.size(); ++i)
        steps[i] = f32::cotan_tone_of(int(tone), glm::vec3(lightAt(float(i)))).y;
    std::vector<float> values;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const std::uint8_t* p = image.bytes8() + 4 * i;
        if (p[3] < 128)
            continue;
        const auto linear = [&](int c) { return f32::cotan_srgb_to_linear(float(p[c]) / 255); };
        values.push_back(invertToneCurve(steps, 0.2126f * linear(0) + 0.7152f * linear(1) + 0.0722f * linear(2))
                         / kMeterExposure);
    }
    return values;
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
    view.exposure = kMeterExposure;
    COTAN_TRY(image, renderer.draw(view));
    std::vector<float> values = luminances(*image, view.toneMapping);
    if (values.empty())
        return 1.0f;
    double logarithms = 0;
    for (const float b : values)
        logarithms += std::log2(std::max(double(b), 1e-3));
    const float mean = float(std::exp2(logarithms / double(values.size())));
    const auto bright = values.begin() + std::ptrdiff_t(values.size() * 49 / 50);
    std::nth_element(values.begin(), bright, values.end());
    const float targetMean = std::clamp(mean * std::pow(kGrey / mean, kGreyFraction), kDarkestMean, kBrightestMean);
    const float exposure = std::min(targetMean / mean, kBrightest / *bright);
    return std::exp2(std::round(32 * std::log2(exposure)) / 32);
}

} // namespace cotan
