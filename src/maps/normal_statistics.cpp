#include "cotan/maps.hpp"
#include "cotan/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/named_values.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

bool outsideCharts(const glm::vec4& t, bool alphaMasks)
{
    constexpr float kDark = 8.0f / 255, kBright = 247.0f / 255; // range of black and white after JPEG compression
    const bool black = std::abs(t.x) <= kDark && std::abs(t.y) <= kDark && std::abs(t.z) <= kDark;
    return (alphaMasks && t.w == 0) || black || (t.x >= kBright && t.y >= kBright && t.z >= kBright);
}

bool usableLength(float length) { return length > 0.5f && length < 1.45f; }

namespace {

constexpr float kShortest = 0.1f;
constexpr double kConstant = 3.0 / 255; // a channel with a smaller range is constant

// Sums over a band of rows. Bands are added in order, so that results do not depend on threads.
struct Sums {
    std::size_t all = 0, allGrey = 0;
    std::size_t finite = 0, grey = 0; // of texels that are not background
    std::size_t strange = 0;          // finite texels that are no normal under any reading
    std::array<double, 4> lowest{1e30, 1e30, 1e30, 1e30}, highest{-1e30, -1e30, -1e30, -1e30};
    std::array<double, 4> error2{}; // squared errors of lengths: exact, biased, decoded from sRGB, encoded to sRGB
    std::array<double, 4> length{}; // sums, same order
    std::array<std::size_t, 4> counted{};
    std::size_t signedUnit = 0;         // texels whose stored length is within 0.1 of 1
    std::array<std::size_t, 3> above{}; // 0.5
    std::size_t between = 0;            // texels that are no multiple of an 8-bit step
    ChannelRange range;

    // times: adds that many copies of `o`.
    void add(const Sums& o, std::size_t times = 1)
    {
        range.add(o.range);
        all += times * o.all, allGrey += times * o.allGrey;
        finite += times * o.finite;
        strange += times * o.strange;
        grey += times * o.grey;
        signedUnit += times * o.signedUnit;
        between += times * o.between;
        for (std::size_t i = 0; i < 3; ++i)
            above[i] += times * o.above[i];
        for (std::size_t i = 0; i < 4; ++i) {
            lowest[i] = std::min(lowest[i], o.lowest[i]);
            highest[i] = std::max(highest[i], o.highest[i]);
            error2[i] += double(times) * o.error2[i];
            length[i] += double(times) * o.length[i];
            counted[i] += times * o.counted[i];
        }
    }
};

// A function of stored values by table lookup: exact for 8 bits, accurate enough to decide otherwise.
struct Curve {
    std::array<float, 256> table{};
    explicit Curve(float (*f)(float))
    {
        for (std::size_t i = 0; i < 256; ++i)
            table[i] = f(float(i) / 255);
    }
    float operator()(float c) const { return table[std::size_t(std::clamp(c, 0.0f, 1.0f) * 255 + 0.5f)]; }
};

bool allEqual(const Image& image)
{
    const std::size_t pixel = image.bytesPerPixel(), bytes = image.pixelCount() * pixel;
    return bytes > pixel && std::memcmp(image.data.data(), image.data.data() + pixel, bytes - pixel) == 0;
}

// Calls work(sums, texel, its left neighbour) for every texel. A strip of one colour costs a single texel: files of a
// few bytes can hold millions of them.
template<class Band, class Work> void sumBands(const Image& image, Band& all, Work work)
{
    if (allEqual(image)) {
        std::vector<glm::vec4> row(std::size_t(image.width));
        loadRow(image, 0, row);
        Band band;
        work(band, row[0], row[0]);
        all.add(band, image.pixelCount());
        return;
    }
    std::vector<Band> bands(std::size_t(image.height + 15) / 16);
    forRowBands(image.width, image.height, [&](int first, int last) {
        std::vector<glm::vec4> row(std::size_t(image.width));
        for (int y = first; y < last; ++y) {
            loadRow(image, y, row);
            for (std::size_t x = 0; x < row.size(); ++x)
                work(bands[std::size_t(first) / 16], row[x],
                     row[x > 0 ? x - 1 : std::min<std::size_t>(1, row.size() - 1)]);
        }
    });
    for (const Band& band : bands)
        all.add(band);
}

// The sums over the texels with alpha, and over those whose alpha is 0.
struct SumsByAlpha {
    Sums visible, transparent;

    void add(const SumsByAlpha& o, std::size_t times = 1)
    {
        visible.add(o.visible, times);
        transparent.add(o.transparent, times);
    }
};

void addStoredValues(const Image& image, SumsByAlpha& sums)
{
    static const Curve decoded(f32::cotan_srgb_to_linear), encoded(f32::cotan_linear_to_srgb);
    const int bits = bitsPerComponent(image.type);
    const float top = bits == 32 ? 2.0f : std::exp2(float(bits)), middle = top / 2; // floats: 2c - 1 for both centres
    sumBands(image, sums, [=](SumsByAlpha& band, const glm::vec4& t, const glm::vec4& left) {
        Sums& s = t.w == 0 ? band.transparent : band.visible;
        const bool grey = std::abs(t.x - t.y) < 0.012f && std::abs(t.x - t.z) < 0.012f;
        ++s.all;
        s.allGrey += grey;
        const glm::vec3 v(t);
        const glm::vec3 exact = bits == 32 ? v * 2.0f - 1.0f : (v * (top - 1) - middle) / (middle - 1);
        // Equal neighbours that are no normals are uniform fill. Floats may be signed, so their lengths prove nothing.
        if (outsideCharts(t, /*alphaMasks*/ false) || (t == left && bits != 32 && !usableLength(glm::length(exact))))
            return;
        s.range.add(t);
        if (!isFinite(t))
            return;
        ++s.finite;
        s.grey += grey;
        for (int c = 0; c < 4; ++c) {
            s.lowest[std::size_t(c)] = std::min(s.lowest[std::size_t(c)], double(t[c]));
            s.highest[std::size_t(c)] = std::max(s.highest[std::size_t(c)], double(t[c]));
        }
        s.signedUnit += std::abs(glm::length(v) - 1) < 0.1f;
        for (int c = 0; c < 3; ++c)
            s.above[std::size_t(c)] += t[c] > 0.5f;
        const glm::vec3 steps = v * 255.0f, off = glm::abs(steps - glm::round(steps));
        s.between += std::max({off.x, off.y, off.z}) > 0.001f;
        const glm::vec3 readings[] = {exact, v * 2.0f - 1.0f,
                                      glm::vec3(decoded(v.x), decoded(v.y), decoded(v.z)) * 2.0f - 1.0f,
                                      glm::vec3(encoded(v.x), encoded(v.y), encoded(v.z)) * 2.0f - 1.0f};
        std::array<float, 4> lengths{};
        std::ranges::transform(readings, lengths.begin(), [](const glm::vec3& r) { return glm::length(r); });
        if (bits != 32 && std::ranges::none_of(lengths, usableLength)) { // floats may be signed
            ++s.strange;
            return;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            s.error2[i] += (lengths[i] - 1.0) * (lengths[i] - 1.0);
            s.length[i] += lengths[i];
            ++s.counted[i];
        }
    });
}

double rms(const Sums& s, std::size_t reading)
{
    return s.counted[reading] ? std::sqrt(s.error2[reading] / double(s.counted[reading])) : 0;
}

// Standard deviation of the lengths, from the mean square of (length - 1).
double deviation(double error2, double mean) { return std::sqrt(std::max(error2 - (mean - 1) * (mean - 1), 0.0)); }

// The sRGB curve changes every length; the reading with unit vectors is the right one. Vectors of one common length
// were scaled, not passed through a curve.
Transfer transferOf(const Sums& s)
{
    const double stored = std::min(rms(s, 0), rms(s, 1));
    const double mean = s.counted[0] ? s.length[0] / double(s.counted[0]) : 1;
    const double scaled = deviation(rms(s, 0) * rms(s, 0), mean);
    if (stored < 0.05 || scaled < 0.5 * std::min(rms(s, 2), rms(s, 3)))
        return Transfer::linear;
    if (rms(s, 2) < 0.4 * stored && rms(s, 2) <= rms(s, 3))
        return Transfer::srgb;
    return rms(s, 3) < 0.4 * stored ? Transfer::linearised : Transfer::linear;
}

// At the right centre 8-bit rounding alone gives an error of 0.0023 to 0.004; the wrong centre adds up to 0.004. Maps
// whose lengths vary for other reasons are undecidable.
Centre centreOf(const Sums& s)
{
    const double exact = rms(s, 0), biased = rms(s, 1);
    if (std::min(exact, biased) > 0.01 || std::max(exact, biased) < 1e-6)
        return Centre::unknown;
    if (exact < 0.95 * biased)
        return Centre::exact;
    return biased < 0.95 * exact ? Centre::biased : Centre::unknown;
}

struct Directions {
    std::size_t valid = 0, below = 0, outside = 0, shortened = 0, background = 0;
    double length = 0, error2 = 0, tilt = 0;
    std::array<double, 3> sum{};
    std::array<std::size_t, 9> histogram{};

    void add(const Directions& o, std::size_t times = 1)
    {
        valid += times * o.valid, below += times * o.below, outside += times * o.outside;
        shortened += times * o.shortened, background += times * o.background;
        length += double(times) * o.length, error2 += double(times) * o.error2, tilt += double(times) * o.tilt;
        for (std::size_t i = 0; i < 3; ++i)
            sum[i] += double(times) * o.sum[i];
        for (std::size_t i = 0; i < 9; ++i)
            histogram[i] += times * o.histogram[i];
    }
};

void addDirections(const Image& image, const Convention& convention, Transfer transfer, bool alphaMasks,
                   Directions& sums)
{
    static const Curve decoded(f32::cotan_srgb_to_linear), encoded(f32::cotan_linear_to_srgb);
    const bool xyz = convention.channels == Channels::xyz;
    sumBands(image, sums, [&](Directions& d, glm::vec4 t, const glm::vec4& left) {
        if (outsideCharts(t, alphaMasks)) {
            ++d.background;
            return;
        }
        const bool alike = t == left;
        if (transfer != Transfer::linear && isFinite(t)) {
            const Curve& curve = transfer == Transfer::srgb ? decoded : encoded;
            t = {curve(t.x), curve(t.y), curve(t.z), t.w};
        }
        const glm::vec3 n = decodeTexel(t, convention, image.type);
        const float length = glm::length(n);
        if (alike && (xyz ? !usableLength(length) : n.x * n.x + n.y * n.y > 1.2f)) { // uniform fill
            ++d.background;
            return;
        }
        if (!(length >= kShortest))
            return;
        ++d.valid;
        d.below += n.z < -0.02f;
        d.outside += n.x * n.x + n.y * n.y > 1.02f;
        d.shortened += length < 0.9f;
        d.length += length;
        d.error2 += (length - 1.0) * (length - 1.0);
        const double tilt = std::atan2(double(std::hypot(n.x, n.y)), double(n.z)) * 180 / std::numbers::pi;
        d.tilt += tilt;
        ++d.histogram[std::size_t(std::clamp(tilt / 10, 0.0, 8.0))];
        for (int c = 0; c < 3; ++c)
            d.sum[std::size_t(c)] += n[c];
    });
}

double fraction(std::size_t part, std::size_t whole) { return whole ? double(part) / double(whole) : 0; }

Content twoChannelContent(const NormalStatistics& s)
{
    return s.outsideDisc > 0.005 ? Content::slopes : Content::twoChannel;
}

Content contentOf(const NormalStatistics& s, const Sums& sums, bool constantBlue, bool constantAll)
{
    if (s.swizzle != Swizzle::rg)
        return twoChannelContent(s);
    // Black and white texels count as grey in a grey image; around charts they do not make it one.
    if (fraction(sums.allGrey, sums.all) > 0.97 && (sums.finite == 0 || fraction(sums.grey, sums.finite) > 0.97))
        return Content::grey;
    if (sums.finite == 0)
        return s.background == 1 ? Content::flat : Content::other;
    if (constantAll)
        return Content::flat;
    if (constantBlue)
        return twoChannelContent(s);
    if (fraction(sums.strange, sums.finite) > 0.1)
        return Content::other;
    const bool upwards = fraction(sums.above[2], sums.finite) > 0.99;
    if (upwards && deviation(s.lengthDeviation * s.lengthDeviation, s.meanLength) < 0.1)
        return Content::tangentSpace; // lengths other than 1, but uniform
    if (s.belowHorizon > 0.1)
        return s.lengthDeviation < 0.2 ? Content::objectSpace : Content::other;
    return s.lengthDeviation < 0.25 ? Content::tangentSpace : Content::other;
}

} // namespace

struct MapSurvey::State {
    NormalStatistics s;
    AlphaUse alpha = AlphaUse::masksCharts;
    SumsByAlpha byAlpha;
    Sums sums; // of the texels that count
    Directions d;
    PixelType type = PixelType::unorm8;
    Convention read;
    Image texel; // the first one, while all are equal; cleared afterwards
    bool two = false, constantAll = false, between = false;

    // Derives from the first pass how the second pass reads the texels.
    void afterFirst()
    {
        between = true;
        sums = byAlpha.visible;
        Sums whole = byAlpha.visible;
        whole.add(byAlpha.transparent);
        s.swizzle = (byAlpha.visible.all > 0 ? byAlpha.visible : whole).range.swizzle();
        s.transparent = s.swizzle == Swizzle::rg && byAlpha.visible.all == 0;
        s.alphaMasks = alpha == AlphaUse::masksCharts && !s.transparent;
        if (s.alphaMasks) {
            sums.all = whole.all; // an image is grey as a whole
            sums.allGrey = whole.allGrey;
        } else {
            sums = whole;
        }
        std::array<double, 4> range{};
        for (std::size_t c = 0; c < 4; ++c)
            range[c] = sums.finite ? sums.highest[c] - sums.lowest[c] : 0;
        for (std::size_t c = 0; c < 3 && sums.finite; ++c) {
            s.lowest[c] = sums.lowest[c];
            s.highest[c] = sums.highest[c];
        }
        s.eightBits = type == PixelType::unorm16 && sums.finite > 0 && sums.between == 0;
        // z points outwards nearly everywhere, x to both sides.
        s.redIsZ = s.swizzle == Swizzle::rg && fraction(sums.above[0], sums.finite) > 0.99
            && fraction(sums.above[2], sums.finite) < 0.9;
        two = s.swizzle != Swizzle::rg || range[2] <= kConstant;
        constantAll = range[0] <= kConstant && range[1] <= kConstant && range[2] <= kConstant && range[3] <= kConstant;
        s.signedStored = type == PixelType::float32 && sums.finite
            && (std::min(s.lowest[0], s.lowest[1]) < -0.01
                || (!two && fraction(sums.signedUnit, sums.finite) > 0.9 && rms(sums, 1) > 0.2));
        if (!two && !s.signedStored && !constantAll) {
            s.rmsExact = rms(sums, 0);
            s.rmsBiased = rms(sums, 1);
            s.transfer = transferOf(sums);
            if (s.transfer == Transfer::linear)
                s.centre = centreOf(sums);
        }
        read.expansion =
            s.centre == Centre::biased || s.transfer != Transfer::linear ? Expansion::biased : Expansion::exact;
        if (s.signedStored)
            read.expansion = Expansion::signedValues;
        if (two && !constantAll)
            read.channels = Channels::orthographic;
    }
};

MapSurvey::MapSurvey(AlphaUse alpha) : state_(std::make_unique<State>()) { state_->alpha = alpha; }
MapSurvey::~MapSurvey() = default;

void MapSurvey::addFirstPass(const Image& strip)
{
    State& s = *state_;
    s.type = strip.type;
    const std::size_t pixel = strip.bytesPerPixel();
    if (s.s.texels == 0) {
        s.texel = makeImage(1, 1, strip.type);
        std::memcpy(s.texel.data.data(), strip.data.data(), pixel);
    }
    const bool alike = strip.pixelCount() == 1 || allEqual(strip);
    if (!s.texel.data.empty() && !(alike && std::memcmp(s.texel.data.data(), strip.data.data(), pixel) == 0))
        s.texel.data.clear();
    s.s.texels += strip.pixelCount();
    addStoredValues(strip, s.byAlpha);
}

bool MapSurvey::oneColour() const { return !state_->texel.data.empty(); }

void MapSurvey::addSecondPass(const Image& strip)
{
    if (!state_->between)
        state_->afterFirst();
    Image unswizzled;
    if (state_->s.swizzle != Swizzle::rg) {
        unswizzled = strip;
        unswizzle(unswizzled, state_->s.swizzle);
    }
    addDirections(unswizzled.width > 0 ? unswizzled : strip, state_->read, state_->s.transfer, state_->s.alphaMasks,
                  state_->d);
}

NormalStatistics MapSurvey::finish()
{
    if (!state_->between && oneColour()) { // the second pass needs only this texel
        addSecondPass(state_->texel);
        const Directions one = std::exchange(state_->d, {});
        state_->d.add(one, state_->s.texels);
    }
    NormalStatistics& s = state_->s;
    const Directions& d = state_->d;
    s.background = fraction(d.background, s.texels);
    s.invalid = fraction(s.texels - d.background - d.valid, s.texels);
    s.belowHorizon = fraction(d.below, d.valid);
    s.outsideDisc = fraction(d.outside, d.valid);
    s.shortened = fraction(d.shortened, d.valid);
    if (d.valid) {
        const double n = double(d.valid);
        s.meanLength = d.length / n;
        s.lengthDeviation = std::sqrt(d.error2 / n);
        s.meanTilt = d.tilt / n;
        for (std::size_t i = 0; i < 3; ++i)
            s.mean[i] = d.sum[i] / n;
        for (std::size_t i = 0; i < 9; ++i)
            s.tilt[i] = fraction(d.histogram[i], d.valid);
    }
    s.content = oneColour() ? Content::flat : contentOf(s, state_->sums, state_->two, state_->constantAll);
    if (s.signedStored && s.content == Content::tangentSpace)
        s.content = Content::signedValues;
    return s;
}

NormalStatistics statisticsOfMap(const Image& image)
{
    MapSurvey survey;
    survey.addFirstPass(image);
    survey.addSecondPass(image);
    return survey.finish();
}

std::string describe(Content content)
{
    constexpr const char* kTexts[] = {"tangent space",
                                      "object space (directions on both sides)",
                                      "two channels (x and y; z is reconstructed)",
                                      "two channels outside the unit disc: a slope map",
                                      "tangent space, stored signed",
                                      "one value everywhere",
                                      "grey: a height map, not a normal map",
                                      "not a normal map: lengths far from 1"};
    return textAt(kTexts, content);
}

} // namespace cotan::maps
