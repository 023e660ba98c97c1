// The accuracy of frames from float attributes, by distance from the origin, pixel size and uv.
#include "rows.hpp"
#include "tables.hpp"
#include "truth/precision.hpp"

#include <fmt/format.h>

namespace cotan {

namespace {

constexpr int kFloatTrials = 4000;
constexpr double kFootprints[] = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
constexpr Frame kFloatFrames[] = {Frame::cotangent, Frame::orthonormal, Frame::gradient, Frame::exact, Frame::triangle};

void measure(const AccuracySelection& selection, const std::string& scene, const std::string& settingName,
             const PrecisionSetting& setting, PositionSource source, std::uint64_t seed,
             std::vector<Measurement>& result)
{
    if (!selection.wantsScene(scene))
        return;
    for (Frame frame : kFloatFrames) {
        if (!selection.wants(frame))
            continue;
        Random random(seed);
        AngleCollector angles;
        for (int i = 0; i < kFloatTrials; ++i) {
            const PrecisionTrial t = makeTrial(random, setting);
            const bool edges = info(frame).source == FrameSource::triangle; // built from the edges of the triangle
            const glm::dvec3 truth = shade(frame, t.normal, edges ? exactEdges(t) : t.exact, t.texel);
            const auto d = edges ? floatEdges(t) : measuredDifferences(t, source);
            angles.add(degreesBetween(shadeFloat(frame, t.normal, d, t.texel), truth));
        }
        result.push_back(
            angles.finish({"precision", scene, settingName, std::string(name(frame)), "exact arithmetic", "float"}));
    }
}

} // namespace

std::vector<Measurement> measurePrecision(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    const std::pair<const char*, PositionSource> sources[] = {
        {"interpolated world position", PositionSource::world},
        {"eye offset per vertex", PositionSource::eyeOffsetPerVertex},
        {"eye offset per pixel", PositionSource::eyeOffsetPerPixel},
        {"camera-relative position", PositionSource::cameraRelative},
    };
    for (auto [scene, source] : sources)
        for (double offset : {0.0, 1e3, 1e5, 1e6})
            for (double footprint : kFootprints)
                measure(selection, scene, fmt::format("offset {:g}, footprint {:g}", offset, footprint),
                        {offset, footprint}, source, 81, result);
    for (double texcoords : {0.01, 1.0, 16.0, 256.0, 4096.0})
        for (double footprint : kFootprints)
            measure(selection, "large uv", fmt::format("uv up to {:g}, footprint {:g}", texcoords, footprint),
                    {0, footprint, texcoords}, PositionSource::cameraRelative, 82, result);
    return result;
}

} // namespace cotan
