#include <fmt/format.h>

#include "parts.hpp"

namespace cotan::lint {

namespace {

// Below this nobody sees a difference, above it moving highlights show one.
constexpr double kUnseenMean = 0.5, kUnseen95 = 2;
// Steps at edges over this, and a map for `cotangent` shows creases there.
constexpr double kCreases95 = 2;

// Over all primitives with a map, weighted by area; of the 95 % too it is the mean.
struct Whole {
    double area = 0, mean = 0, percentile95 = 0;
    void add(double a, const Spread& s)
    {
        area += a;
        mean += a * s.mean;
        percentile95 += a * s.percentile95;
    }
    void finish()
    {
        if (area > 0) {
            mean /= area;
            percentile95 /= area;
        }
    }
};

Whole wholeReading(const LintReport& report, const std::string& name)
{
    Whole w;
    for (const PrimitiveLint& p : report.primitives)
        for (const Reading& r : p.readings)
            if (r.name == name)
                w.add(p.uv.area, r.error);
    w.finish();
    return w;
}

// Shares of the area with a map and stored tangents.
struct Stored {
    double reversedW = 0, turned = 0;
};

Stored storedShares(const LintReport& report)
{
    Stored s;
    double area = 0;
    for (const PrimitiveLint& p : report.primitives)
        if (p.stored.present && !p.readings.empty()) {
            area += p.uv.area;
            s.reversedW += p.uv.area * p.stored.reversedW;
            s.turned += p.uv.area * p.stored.turned;
        }
    if (area > 0) {
        s.reversedW /= area;
        s.turned /= area;
    }
    return s;
}

// The maps whose green points the other way than declared, by name; empty if there are none.
std::string otherGreen(const LintReport& report)
{
    std::string names;
    for (const GreenEvidence& g : report.maps)
        if (!g.asDeclared())
            names += (names.empty() ? "" : ", ") + (g.name.empty() ? fmt::format("image {}", g.image) : g.name);
    return names;
}

// What is wrong with the model as it is; sets LintReport::distrustStored.
std::string defects(LintReport& report)
{
    const Stored s = storedShares(report);
    const std::string green = otherGreen(report);
    const bool reversed = s.reversedW > 0.5;
    if (reversed && !green.empty())
        return fmt::format("The stored TANGENT.w is reversed on {:.0f} % of the area and green points the other way in {}: "
                           "together they are right, each alone is not. ", 100 * s.reversedW, green);
    std::string text;
    report.distrustStored = s.reversedW > 0.1 || s.turned > 0.1;
    if (reversed)
        text = fmt::format("The stored TANGENT.w is reversed on {:.0f} % of the area. ", 100 * s.reversedW);
    else if (report.distrustStored)
        text = fmt::format("The stored tangents contradict the uv: w is reversed on {:.0f} % of the area, the tangent turned by over "
                           "{:.0f} degrees on {:.0f} %. ", 100 * s.reversedW, kTurned, 100 * s.turned);
    if (!green.empty())
        text += fmt::format("Green seems to point the other way in {} (cotan map convert --from directx --to gltf turns it). ", green);
    return text;
}

// Which extension reads tangents in which material, as a sentence; empty if none.
std::string otherReaders(const LintReport& report)
{
    std::string names;
    for (const PrimitiveLint& p : report.primitives) {
        const std::string name = p.material.empty() ? "a material" : p.material;
        const std::string one = fmt::format("{} ({})", name, p.tangentsFor);
        if (!p.tangentsFor.empty() && names.find(one) == std::string::npos)
            names += (names.empty() ? "" : ", ") + one;
    }
    return names.empty() ? "" : fmt::format(" Tangents are also read by what is not looked at here and stay for it: {}.", names);
}

// The primitive with the largest mean error of that reading among those where somebody might see it; empty
// if there is none.
std::string worstReading(const LintReport& report, const std::string& name)
{
    std::string text;
    double worst = 0;
    for (const PrimitiveLint& p : report.primitives)
        for (const Reading& r : p.readings)
            if (r.name == name && (r.error.mean > kUnseenMean || r.error.percentile95 > kUnseen95) && r.error.mean > worst) {
                worst = r.error.mean;
                text = fmt::format("; most in {}: {:.2f}, and 5 % of it over {:.1f}", p.mesh.empty() ? p.material : p.mesh,
                                   r.error.mean, r.error.percentile95);
            }
    return text;
}

} // namespace

void recommend(LintReport& report)
{
    bool anyMap = false;
    for (const PrimitiveLint& p : report.primitives)
        anyMap = anyMap || !p.readings.empty();
    if (!anyMap) {
        const std::string others = otherReaders(report);
        report.recommendation = "No primitive has a normal map and uv to read it with: "
            + (others.empty() ? std::string("nothing here uses tangents, they can be dropped.")
                              : "no normal map uses tangents." + others);
        return;
    }
    const std::string notes = defects(report);
    const Whole orthonormal = wholeReading(report, "orthonormal"), cotangent = wholeReading(report, "cotangent");
    Whole steps;
    for (const PrimitiveLint& p : report.primitives)
        if (!p.readings.empty())
            steps.add(p.uv.area, p.steps.cotangent);
    steps.finish();
    if (orthonormal.mean < kUnseenMean && orthonormal.percentile95 < kUnseen95) {
        report.advice = Advice::readOrthonormal;
        report.recommendation = notes
            + fmt::format("If the maps were made for MikkTSpace, they can be read without tangents with the frame orthonormal, "
                          "{:.2f} degrees off on average{}. The command drops the tangents and fits those maps to that frame that gain by it.",
                          orthonormal.mean, worstReading(report, "orthonormal"))
            + otherReaders(report);
        return;
    }
    const bool creases = steps.percentile95 > kCreases95;
    report.advice = creases ? Advice::convertToSmooth : Advice::convertToCotangent;
    report.recommendation = notes
        + fmt::format("If the maps were made for MikkTSpace, reading them without tangents is {:.1f} degrees off on "
                      "average (orthonormal; cotangent {:.1f}): convert them to {}{}.",
                      orthonormal.mean, cotangent.mean, creases ? "smooth" : "cotangent",
                      creases ? fmt::format(", because cotangent steps by up to {:.0f} degrees at edges (95 %)",
                                            steps.percentile95) : "")
        + otherReaders(report);
}

} // namespace cotan::lint
