#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "bake/lint/map_fit.hpp"
#include "cotan/maps.hpp"
#include "lint_parts.hpp"

namespace cotan {

namespace {

bool readsMap(const FrameDecision& d) { return d.reason != ChoiceReason::noMap; }

// The frames that read maps without the file's tangents, and how many meshes each reads.
std::map<Frame, std::size_t> framesChosen(const LintReport& report)
{
    std::map<Frame, std::size_t> frames;
    for (const FrameDecision& d : report.decisions)
        if (readsMap(d) && d.dropsTangents())
            ++frames[d.frame];
    return frames;
}

} // namespace

Frame frameOf(const LintReport& report)
{
    if (report.advice == Advice::readNamed)
        return report.named.value_or(Frame::orthonormal);
    const auto frames = framesChosen(report);
    const auto most = std::ranges::max_element(frames, {}, [](const auto& f) { return f.second; });
    return most != frames.end() ? most->first : Frame::orthonormal;
}

namespace lint {

namespace {

// Degrees: from this mean on the light seems to come from elsewhere, even without motion.
constexpr double kWrongMean = 5;
constexpr std::size_t kMaxNames = 3; // per sentence

// Means over all judged primitives, weighted by area; percentile95 is the mean of their percentiles.
struct AreaMean {
    double area = 0, mean = 0, percentile95 = 0;
};

// The error of that reading; null if there is none.
const ValueSummary* errorOf(const PrimitiveLint& p, const std::string& reading)
{
    const auto found = std::ranges::find(p.readings, reading, &Reading::name);
    return found != p.readings.end() && found->error.count > 0 ? &found->error : nullptr;
}

bool judged(const PrimitiveLint& p) { return errorOf(p, "orthonormal") != nullptr; }

// summaryOf(primitive): null if it does not count.
AreaMean areaMeanOf(const LintReport& report, const auto& summaryOf)
{
    AreaMean w;
    for (const PrimitiveLint& p : report.primitives)
        if (const ValueSummary* const s = summaryOf(p); s && s->count > 0) {
            w.area += p.uv.area;
            w.mean += p.uv.area * s->mean;
            w.percentile95 += p.uv.area * s->percentile95;
        }
    w.mean /= w.area; // NaN if empty, which is below no limit
    w.percentile95 /= w.area;
    return w;
}

AreaMean meanReading(const LintReport& report, const std::string& name)
{
    return areaMeanOf(report, [&](const PrimitiveLint& p) { return errorOf(p, name); });
}

// Fractions of the area with a map and stored tangents; NaN, which is above no limit, if there is none.
struct Stored {
    double reversedW = 0, rotated = 0;
};

Stored storedFractions(const LintReport& report)
{
    Stored s;
    double area = 0;
    for (const PrimitiveLint& p : report.primitives)
        if (p.stored.present && p.stored.angle.count > 0 && p.image >= 0) {
            area += p.uv.area;
            s.reversedW += p.uv.area * p.stored.reversedW;
            s.rotated += p.uv.area * p.stored.rotated;
        }
    s.reversedW /= area;
    s.rotated /= area;
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

// The names of the maps whose green points the other way than declared; empty if there are none.
std::string reversedGreen(const LintReport& report)
{
    std::vector<std::string> names;
    for (const GreenEvidence& g : report.maps)
        if (!g.asDeclared())
            names.push_back(mapName(g));
    return listed(names);
}

// The options that flip these maps; biased ones if all of them have zero at about 127.5.
std::string flipOptions(const LintReport& report)
{
    bool biased = true;
    for (const GreenEvidence& g : report.maps)
        biased = biased && (g.asDeclared() || g.verdict.statistics.centre == maps::Centre::biased);
    return biased ? "--from directx,biased --to opengl,biased" : "--from directx --to opengl";
}

// The defects of the maps as files, and how each is fixed; empty if there are none.
std::string brokenMaps(const LintReport& report)
{
    std::string text;
    for (const GreenEvidence& g : report.maps)
        addSentence(text, g.sentence);
    return text;
}

constexpr double kMostly = 0.5;      // of the area reversed: then the whole model is
constexpr double kContradicts = 0.1; // of the area: then the stored tangents contradict the uv

bool contradicts(const Stored& s) { return s.reversedW > kContradicts || s.rotated > kContradicts; }

// The defects of the model's tangents and of green; empty if there are none.
std::string defectsOfFrames(const LintReport& report)
{
    const Stored s = storedFractions(report);
    const std::string green = reversedGreen(report);
    const bool reversed = s.reversedW > kMostly;
    if (reversed && !green.empty())
        return fmt::format("The stored TANGENT.w is reversed on {:.0f} % of the area and green is flipped in {}: "
                           "together they cancel out, each alone is wrong.",
                           100 * s.reversedW, green);
    std::string text;
    if (reversed)
        text = fmt::format("The stored TANGENT.w is reversed on {:.0f} % of the area.", 100 * s.reversedW);
    else if (contradicts(s))
        text = fmt::format(
            "The stored tangents contradict the uv: w is reversed on {:.0f} % of the area, the tangent is rotated by "
            "more than {:.0f} degrees on {:.0f} %.",
            100 * s.reversedW, kMaxTangentAngle, 100 * s.rotated);
    if (!text.empty() && green.empty() && !distrustStored(report))
        text += " The maps do not show whether green is right, so the tangents are trusted.";
    if (!green.empty())
        addSentence(text,
                    fmt::format("Green seems to be flipped in {} (cotan map convert {} flips it back).", green,
                                flipOptions(report)));
    return text;
}

// Whether something other than a normal map needs the tangents of a primitive.
bool neededElsewhere(const LintReport& report, const PrimitiveLint& p)
{
    const bool smooth = p.meshIndex < report.decisions.size() && report.decisions[p.meshIndex].frame == Frame::smooth;
    return !p.tangentsFor.empty() && !directionStays(smooth ? p.rotation.smooth : p.rotation.orthonormal);
}

// A sentence on the extensions that need tangents, with their materials; empty if there are none.
std::string otherReaders(const LintReport& report)
{
    std::vector<std::string> names;
    for (const PrimitiveLint& p : report.primitives)
        if (neededElsewhere(report, p))
            addOnce(names, fmt::format("{} ({})", p.material.empty() ? "a material" : p.material, p.tangentsFor));
    return names.empty()
        ? ""
        : fmt::format("Tangents are also read by unconverted extensions and are kept for them: {}.", listed(names));
}

std::string nameOf(const PrimitiveLint& p)
{
    return p.mesh.empty() ? p.material.empty() ? "a primitive" : p.material : p.mesh;
}

// A sentence on the normal maps that could not be judged; empty if there are none.
std::string notJudged(const LintReport& report)
{
    std::vector<std::string> names;
    for (const PrimitiveLint& p : report.primitives)
        if (!p.notJudged.empty())
            addOnce(names, fmt::format("{} ({})", nameOf(p), p.notJudged));
    return names.empty() ? "" : fmt::format("The normal map could not be judged in {}.", listed(names));
}

// Whether reading a primitive with orthonormal shows a difference in moving highlights. The limit is the one by which
// frames are chosen, and so is the measurement: what is called invisible is also what is advised. Without it, as of
// maps whose pixels were not read, `error` is compared.
bool isVisible(const LintReport& report, const PrimitiveLint& p, const ValueSummary& error)
{
    constexpr ChoiceLimits kUnseen;
    if (p.meshIndex < report.decisions.size())
        for (const FrameCandidate& c : report.decisions[p.meshIndex].candidates)
            if (c.frame == Frame::orthonormal && c.points > 0)
                return !c.within(kUnseen);
    return error.mean > kUnseen.mean || error.percentile95 > kUnseen.percentile99;
}

// The primitive with the largest mean error of reading with orthonormal among those on which it is visible; null if
// there is none.
const PrimitiveLint* worstReading(const LintReport& report)
{
    const PrimitiveLint* worst = nullptr;
    for (const PrimitiveLint& p : report.primitives)
        if (const ValueSummary* const error = errorOf(p, "orthonormal");
            error && isVisible(report, p, *error) && (!worst || error->mean > errorOf(*worst, "orthonormal")->mean))
            worst = &p;
    return worst;
}

std::string worstText(const PrimitiveLint* worst)
{
    if (!worst)
        return {};
    const ValueSummary& error = *errorOf(*worst, "orthonormal");
    return fmt::format("The largest error is in {}: {:.2f} degrees on average, over {:.1f} on 5 % of its area.",
                       nameOf(*worst), error.mean, error.percentile95);
}

// visible: whether worstReading found a primitive.
std::string visibleErrorText(const AreaMean& orthonormal, const AreaMean& cotangent, bool visible)
{
    const char* how = !visible          ? "the difference is invisible"
        : orthonormal.mean < kWrongMean ? "moving highlights show a difference"
                                        : "the light seems to come from elsewhere";
    return fmt::format("If the maps were made for MikkTSpace and are read without tangents, {}: the error is {:.2f} "
                       "degrees on average with the frame orthonormal ({:.2f} with cotangent).",
                       how, orthonormal.mean, cotangent.mean);
}

// Predicts what `convert` would do; dropTangents (bake/convert/map_jobs.cpp) decides which tangents are dropped.
void predictConversion(LintReport& report)
{
    std::set<std::size_t> needed;
    for (const PrimitiveLint& p : report.primitives)
        if (p.stored.present && (neededElsewhere(report, p) || p.unread))
            needed.insert(p.meshIndex);
    std::set<std::size_t> counted;
    for (const PrimitiveLint& p : report.primitives)
        if (p.stored.present && counted.insert(p.meshIndex).second) {
            const bool drops = p.meshIndex < report.decisions.size() && !needed.contains(p.meshIndex)
                && (report.distrustStored || report.decisions[p.meshIndex].dropsTangents());
            ++(drops ? report.dropping : report.keeping);
        }
}

// What the command does to maps whose green the stored tangents reverse; empty if there are none.
std::string tangentsAndGreen(const LintReport& report)
{
    std::vector<std::string> reversed, shared;
    for (const GreenEvidence& g : report.maps)
        if (g.reversedByTangents)
            addOnce(g.reversedEverywhere ? reversed : shared, mapName(g));
    std::string text = " the command drops the tangents";
    if (!reversed.empty())
        text += fmt::format(" and reverses green of {}, as they show it", listed(reversed));
    if (!shared.empty())
        text += fmt::format("; surfaces that reverse green of {}, which others show as declared, keep theirs",
                            listed(shared));
    return text + ".";
}

// "orthonormal (9), smooth (2)".
std::string framesText(const LintReport& report)
{
    const auto frames = framesChosen(report);
    std::string text;
    for (const auto& [frame, count] : frames)
        text += fmt::format("{}{}{}", text.empty() ? "" : ", ", name(frame),
                            frames.size() > 1 ? fmt::format(" ({})", count) : "");
    return text;
}

// The advice, given what the command would do.
std::string adviceText(const LintReport& report)
{
    const std::string frames = framesText(report);
    if (report.dropping > 0 && report.distrustStored)
        return "The tangents are wrong, for green of the maps is right: the command decides as if there were none, and "
               "drops them.";
    if (report.dropping > 0) {
        const std::string kept = report.keeping > 0
            ? fmt::format(" Those of {} primitive{} stay.", report.keeping, report.keeping == 1 ? "" : "s")
            : "";
        return fmt::format("Read the maps with {} as they are;{}{}",
                           report.advice == Advice::readNamed ? fmt::format("the frame {}", name(frameOf(report)))
                               : frames.empty()               ? std::string("their tangents")
                                                              : frames,
                           tangentsAndGreen(report), kept);
    }
    if (report.keeping > 0 && frames.empty())
        return "Keep the tangents: without them the difference would be visible.";
    if (!brokenMaps(report).empty() || !reversedGreen(report).empty())
        return fmt::format("Fix the maps; then they can be read with {}.", frames);
    return fmt::format("Nothing has to be changed: read the maps with {} as they are.",
                       report.advice == Advice::readNamed ? fmt::format("the frame {}", name(frameOf(report)))
                                                          : frames);
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

// A sentence on the visible error of maps that name their frame, if another frame reads them.
std::string namedErrorText(const LintReport& report, const AreaMean& orthonormal)
{
    const std::string_view frame = name(*report.named);
    return *report.named == Frame::orthonormal
        ? fmt::format("The file says that its maps are for the frame {}.", frame)
        : fmt::format("The file says that its maps are for the frame {}; read with orthonormal, their error is {:.2f} "
                      "degrees on average.",
                      frame, orthonormal.mean);
}

void adviseForMaps(LintReport& report)
{
    const AreaMean orthonormal = meanReading(report, "orthonormal");
    const PrimitiveLint* const worst = report.named ? nullptr : worstReading(report);
    report.seen = report.named ? namedErrorText(report, orthonormal)
                               : visibleErrorText(orthonormal, meanReading(report, "cotangent"), worst != nullptr);
    report.worst = worstText(worst);
    report.advice = report.named ? Advice::readNamed : Advice::readChosen;
    predictConversion(report);
    report.advised = adviceText(report);
}

} // namespace

double meanOfReading(const LintReport& report, const std::string& frame) { return meanReading(report, frame).mean; }

bool distrustStored(const LintReport& report)
{
    const Stored s = storedFractions(report);
    if (s.reversedW > kMostly && !reversedGreen(report).empty())
        return false;
    const bool greenConfirmed =
        std::ranges::any_of(report.maps, [](const GreenEvidence& g) { return g.decided() && g.asDeclared(); });
    return greenConfirmed && contradicts(s);
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
