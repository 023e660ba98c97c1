#include <algorithm>

#include <fmt/format.h>

#include "bake/lint/map_fit.hpp"
#include "cotan/maps.hpp"
#include "lint_parts.hpp"

namespace cotan {

Frame frameOf(const LintReport& report)
{
    return report.advice == Advice::readNamed         ? report.named.value_or(Frame::orthonormal)
        : report.advice == Advice::convertToCotangent ? Frame::cotangent
        : report.advice == Advice::convertToSmooth    ? Frame::smooth
                                                      : Frame::orthonormal;
}

namespace lint {

namespace {

// Below this nobody sees a difference, above it moving highlights show one.
constexpr double kUnseenMean = 0.5, kUnseen95 = 2;
// From this mean on the light seems to come from elsewhere, without anything moving.
constexpr double kWrongMean = 5;
// Degrees on average: what converted maps stay off by in other engines. On real models read by three.js it was 0.1 to
// 1.7, mostly over what the untouched map was off by when it was read with orthonormal
// (docs/how-to/remove-tangents.md).
constexpr double kConvertedStaysOff = 1;
// Steps at edges over this, and a map for `cotangent` shows creases there.
constexpr double kCreases95 = 2;
constexpr std::size_t kMaxNames = 3; // in one sentence

// Of all primitives that were judged, weighted by area; of the 95 % too it is the mean.
struct Whole {
    double area = 0, mean = 0, percentile95 = 0;

    bool unseen() const { return mean < kUnseenMean && percentile95 < kUnseen95; }
};

// The error of that reading; null where there is none.
const ValueSummary* errorOf(const PrimitiveLint& p, const std::string& reading)
{
    const auto found = std::ranges::find(p.readings, reading, &Reading::name);
    return found != p.readings.end() && found->error.count > 0 ? &found->error : nullptr;
}

bool judged(const PrimitiveLint& p) { return errorOf(p, "orthonormal") != nullptr; }

// summaryOf(primitive): null for one that does not count.
Whole wholeOf(const LintReport& report, const auto& summaryOf)
{
    Whole w;
    for (const PrimitiveLint& p : report.primitives)
        if (const ValueSummary* const s = summaryOf(p); s && s->count > 0) {
            w.area += p.uv.area;
            w.mean += p.uv.area * s->mean;
            w.percentile95 += p.uv.area * s->percentile95;
        }
    w.mean /= w.area; // of nothing: NaN, which is below no limit
    w.percentile95 /= w.area;
    return w;
}

Whole wholeReading(const LintReport& report, const std::string& name)
{
    return wholeOf(report, [&](const PrimitiveLint& p) { return errorOf(p, name); });
}

// Shares of the area with a map and stored tangents; NaN, which is above no limit, where there are none.
struct Stored {
    double reversedW = 0, turned = 0;
};

Stored storedShares(const LintReport& report)
{
    Stored s;
    double area = 0;
    for (const PrimitiveLint& p : report.primitives)
        if (p.stored.present && p.stored.angle.count > 0 && p.image >= 0) {
            area += p.uv.area;
            s.reversedW += p.uv.area * p.stored.reversedW;
            s.turned += p.uv.area * p.stored.turned;
        }
    s.reversedW /= area;
    s.turned /= area;
    return s;
}

void addSentence(std::string& text, const std::string& sentence)
{
    if (!sentence.empty())
        text += (text.empty() ? "" : " ") + sentence;
}

// "a, b, c and 4 more".
std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
        text += (i > 0 ? ", " : "") + names[i];
    return names.size() > kMaxNames ? text + fmt::format(" and {} more", names.size() - kMaxNames) : text;
}

void addOnce(std::vector<std::string>& names, const std::string& name)
{
    if (std::ranges::find(names, name) == names.end())
        names.push_back(name);
}

// The maps whose green points the other way than declared, by name; empty if there are none.
std::string otherGreen(const LintReport& report)
{
    std::vector<std::string> names;
    for (const GreenEvidence& g : report.maps)
        if (!g.asDeclared())
            names.push_back(g.name.empty() ? fmt::format("image {}", g.image) : g.name);
    return listed(names);
}

// What turns them; about 127.5 where that is zero in all of them.
std::string turningOptions(const LintReport& report)
{
    bool biased = true;
    for (const GreenEvidence& g : report.maps)
        biased = biased && (g.asDeclared() || g.verdict.statistics.centre == maps::Centre::biased);
    return biased ? "--from directx,biased --to gltf,biased" : "--from directx --to gltf";
}

// What is wrong with the maps as files, and how each is fixed; empty if nothing.
std::string brokenMaps(const LintReport& report)
{
    std::string text;
    for (const GreenEvidence& g : report.maps)
        addSentence(text,
                    maps::sentenceOf(g.name.empty() ? fmt::format("Image {}", g.image) : g.name,
                                     maps::faultsOf(g.verdict.statistics), g.verdict.statistics));
    return text;
}

constexpr double kMostly = 0.5;      // of the area reversed: the whole model is
constexpr double kContradicts = 0.1; // of the area: the stored tangents are not what the uv say

bool contradicts(const Stored& s) { return s.reversedW > kContradicts || s.turned > kContradicts; }

// What is wrong with the model as it is.
std::string defectsOfFrames(const LintReport& report)
{
    const Stored s = storedShares(report);
    const std::string green = otherGreen(report);
    const bool reversed = s.reversedW > kMostly;
    if (reversed && !green.empty())
        return fmt::format(
            "The stored TANGENT.w is reversed on {:.0f} % of the area and green points the other way in {}: "
            "together they are right, each alone is not.",
            100 * s.reversedW, green);
    std::string text;
    if (reversed)
        text = fmt::format("The stored TANGENT.w is reversed on {:.0f} % of the area.", 100 * s.reversedW);
    else if (contradicts(s))
        text = fmt::format(
            "The stored tangents contradict the uv: w is reversed on {:.0f} % of the area, the tangent turned by over "
            "{:.0f} degrees on {:.0f} %.",
            100 * s.reversedW, kTurned, 100 * s.turned);
    if (!text.empty() && green.empty() && !distrustStored(report))
        text += " Whether green is right cannot be told from the maps, so the tangents are followed.";
    if (!green.empty())
        addSentence(text,
                    fmt::format("Green seems to point the other way in {} (cotan map convert {} turns it).", green,
                                turningOptions(report)));
    return text;
}

const ValueSummary& of(const FrameSummaries& summaries, Advice advice)
{
    return advice == Advice::convertToCotangent ? summaries.cotangent
        : advice == Advice::convertToSmooth     ? summaries.smooth
                                                : summaries.orthonormal;
}

// Whether something else than a normal map that is converted needs the tangents of a primitive.
bool neededElsewhere(const PrimitiveLint& p, Advice advice)
{
    return !p.tangentsFor.empty() && !directionStays(of(p.turned, advice));
}

// Which extension needs tangents in which material, as a sentence; empty if none.
std::string otherReaders(const LintReport& report)
{
    std::vector<std::string> names;
    for (const PrimitiveLint& p : report.primitives)
        if (neededElsewhere(p, report.advice))
            addOnce(names, fmt::format("{} ({})", p.material.empty() ? "a material" : p.material, p.tangentsFor));
    return names.empty()
        ? ""
        : fmt::format("Tangents are also read by what is not converted and stay for it: {}.", listed(names));
}

std::string nameOf(const PrimitiveLint& p)
{
    return p.mesh.empty() ? p.material.empty() ? "a primitive" : p.material : p.mesh;
}

// Normal maps that are there and could not be judged, as a sentence; empty if none.
std::string notJudged(const LintReport& report)
{
    std::vector<std::string> names;
    for (const PrimitiveLint& p : report.primitives)
        if (!p.notJudged.empty())
            addOnce(names, fmt::format("{} ({})", nameOf(p), p.notJudged));
    return names.empty() ? "" : fmt::format("The normal map could not be judged in {}.", listed(names));
}

// A sentence on the primitive with the largest mean error of reading with orthonormal among those where somebody might
// see it; empty if there is none.
std::string worstReading(const LintReport& report)
{
    std::string text;
    double worst = 0;
    for (const PrimitiveLint& p : report.primitives)
        if (const ValueSummary* const error = errorOf(p, "orthonormal");
            error && (error->mean > kUnseenMean || error->percentile95 > kUnseen95) && error->mean > worst) {
            worst = error->mean;
            text = fmt::format("The largest error is in {}: {:.2f} degrees on average, over {:.1f} on 5 % of its area.",
                               nameOf(p), error->mean, error->percentile95);
        }
    return text;
}

std::string seen(const Whole& orthonormal, const Whole& cotangent)
{
    const char* how = orthonormal.unseen() ? "nobody sees a difference"
        : orthonormal.mean < kWrongMean    ? "moving highlights show a difference"
                                           : "the light seems to come from elsewhere";
    return fmt::format("If the maps were made for MikkTSpace and are read without tangents, {}: {:.2f} degrees off on "
                       "average with the "
                       "frame orthonormal ({:.2f} with cotangent).",
                       how, orthonormal.mean, cotangent.mean);
}

// Counts what the command would do; dropTangents (bake/convert/map_jobs.cpp) says which tangents go. Maps that are to
// be read as they are stay: with the frame orthonormal by --keep-maps, with one that the file names without a command.
void foresee(LintReport& report)
{
    for (const MapFit& fit : report.fits)
        ++(fitsAsItIs(of(fit, report.advice)) ? report.mapsKept : report.mapsConverted);
    if (report.advice == Advice::readNamed || report.advice == Advice::readOrthonormal) {
        report.mapsConverted = 0;
        report.mapsKept = report.fits.size();
    }
    if (report.advice == Advice::readNamed)
        return;
    for (const PrimitiveLint& p : report.primitives)
        report.dropsTangents =
            report.dropsTangents || (p.stored.present && !neededElsewhere(p, report.advice) && !p.unread);
}

// What to do, given what the command would do.
std::string advised(const LintReport& report, const Whole& steps)
{
    const std::string frame(name(frameOf(report)));
    const std::string why = report.advice != Advice::convertToSmooth
        ? ""
        : fmt::format(" (cotangent steps by up to {:.0f} degrees at edges, 95 %)", steps.percentile95);
    const std::string tangents = report.dropsTangents ? " The command drops the tangents." : "";
    if (report.mapsConverted == 0 && report.dropsTangents)
        return fmt::format("Read the maps with the frame {} as they are; the command drops the tangents.", frame);
    if (report.mapsConverted == 0 && (!brokenMaps(report).empty() || !otherGreen(report).empty()))
        return fmt::format("Fix the maps; then they can be read with the frame {}.", frame);
    if (report.mapsConverted == 0)
        return fmt::format("Nothing has to be changed: read the maps with the frame {} as they are.", frame);
    if (report.mapsKept == 0)
        return fmt::format("Convert the maps to the frame {}{}.{}", frame, why, tangents);
    return fmt::format("Convert {} of {} maps to the frame {}{}; the others can be read with it as they are.{}",
                       report.mapsConverted, report.fits.size(), frame, why, tangents);
}

void adviseWithoutMaps(LintReport& report)
{
    if (!report.notJudged.empty())
        report.advised = "No normal map was judged, so nothing is advised.";
    else if (!report.fits.empty())
        report.advised = "Only clear coats have normal maps: cotan convert judges each by itself.";
    else if (report.otherReaders.empty())
        report.advised =
            "No primitive has a normal map and uv to read it with: nothing here uses tangents, they can be dropped.";
    else
        report.advised = "No primitive has a normal map and uv to read it with: no normal map uses tangents.";
}

// What is seen of maps that name their frame, where another reads them.
std::string seenOfNamed(const LintReport& report, const Whole& orthonormal)
{
    const std::string_view frame = name(*report.named);
    return *report.named == Frame::orthonormal
        ? fmt::format("The file says that its maps are for the frame {}.", frame)
        : fmt::format("The file says that its maps are for the frame {}; read with orthonormal they are off by {:.2f} "
                      "degrees on average.",
                      frame, orthonormal.mean);
}

// Whether reading the maps with orthonormal leaves less than converting them does, for every map, against what the
// stored tangents show.
bool readsAsItIs(const LintReport& report, const Whole& orthonormal)
{
    return orthonormal.mean < kConvertedStaysOff
        && std::ranges::none_of(report.fits, [](const MapFit& f) { return f.orthonormal.mean >= kConvertedStaysOff; });
}

void adviseForMaps(LintReport& report)
{
    const Whole orthonormal = wholeReading(report, "orthonormal");
    const Whole steps =
        wholeOf(report, [](const PrimitiveLint& p) { return judged(p) ? &p.steps.cotangent : nullptr; });
    report.seen =
        report.named ? seenOfNamed(report, orthonormal) : seen(orthonormal, wholeReading(report, "cotangent"));
    report.worst = report.named ? std::string() : worstReading(report);
    report.advice = report.named           ? Advice::readNamed
        : readsAsItIs(report, orthonormal) ? Advice::readOrthonormal
        : orthonormal.unseen()             ? Advice::convertToOrthonormal
        : steps.percentile95 > kCreases95  ? Advice::convertToSmooth
                                           : Advice::convertToCotangent;
    foresee(report);
    report.advised = advised(report, steps);
}

} // namespace

double meanOfReading(const LintReport& report, const std::string& frame) { return wholeReading(report, frame).mean; }

bool distrustStored(const LintReport& report)
{
    const Stored s = storedShares(report);
    if (s.reversedW > kMostly && !otherGreen(report).empty())
        return false;
    const bool told =
        std::ranges::any_of(report.maps, [](const GreenEvidence& g) { return g.decided() && g.asDeclared(); });
    return told && contradicts(s);
}

void recommend(LintReport& report)
{
    report.notJudged = notJudged(report);
    if (std::ranges::any_of(report.primitives, judged)) {
        report.distrustStored = distrustStored(report);
        report.defects = brokenMaps(report);
        addSentence(report.defects, defectsOfFrames(report));
        adviseForMaps(report);
        report.otherReaders = otherReaders(report);
    } else {
        report.otherReaders = otherReaders(report);
        adviseWithoutMaps(report);
    }
    for (const std::string* sentence :
         {&report.defects, &report.seen, &report.worst, &report.advised, &report.notJudged, &report.otherReaders})
        addSentence(report.recommendation, *sentence);
}

} // namespace lint

} // namespace cotan
