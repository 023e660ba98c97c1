#include "choose.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "map_files/jpeg_cost.hpp"
#include "maps/blocks/four_colours.hpp"
#include "maps/texels.hpp"

namespace cotan::app {

using namespace maps;

namespace {

struct Candidate {
    std::string word;
    TexelCode code;
    double bits = 0; // of a texel
};

// The formats of a device that hold the channels of `to`, the smallest first.
Result<std::vector<Candidate>> candidatesFor(const Convention& to, const std::string& swizzle,
                                             const std::filesystem::path& file, Device device)
{
    const bool two = to.channels != Channels::xyz;
    std::vector<Candidate> candidates;
    std::optional<Error> refused;
    for (const std::string& word : compressionWords()) {
        if (word == "bc5-snorm") // as exact as bc5, for shaders that expect signed values
            continue;
        const bool three = word == "bc7" || word == "uastc" || (word.starts_with("astc") && !two);
        const Device family = word.starts_with("bc") ? Device::desktop : word == "uastc" ? Device::web : Device::mobile;
        if (word != "none" && (family != device || (!two && !three)))
            continue;
        auto code = codeFor(word, "auto", to, file, swizzle);
        if (code)
            candidates.push_back({word, *code, bitsPerTexel(*code)});
        else if (!refused)
            refused = code.error();
    }
    if (refused && candidates.size() < 2)
        return *refused;
    std::ranges::stable_sort(candidates, {}, &Candidate::bits);
    return candidates;
}

// Squares of the map at equal distances, so that blocks of all sizes lie in them as in the map, from the texel (left,
// top) on. A small map stays, but for what is left of and above that texel. square: a multiple of the sides of a block.
Image sampleOf(const Image& map, int square = 24, int left = 0, int top = 0)
{
    constexpr int kAcross = 8;
    const int side = square * kAcross;
    const bool whole = map.width < 2 * side || map.height < 2 * side;
    const int width = whole ? map.width - left : side, height = whole ? map.height - top : side;
    const int run = whole ? width : square; // texels that are copied at once
    Image sample = makeImage(width, height, map.type);
    const std::size_t bytes = map.data.size() / map.pixelCount();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; x += run) {
            const int column = left + (whole ? 0 : x / square * (map.width / kAcross / square) * square);
            const int row = top + (whole ? y : y / square * (map.height / kAcross / square) * square + y % square);
            std::copy_n(map.data.data() + bytes * (std::size_t(row) * std::size_t(map.width) + std::size_t(column)),
                        bytes * std::size_t(run),
                        sample.data.data() + bytes * (std::size_t(y) * std::size_t(width) + std::size_t(x)));
        }
    return sample;
}

} // namespace

Json toJson(const TriedFormat& format)
{
    return {{"compress", format.compress},
            {"bits_per_texel", format.bitsPerTexel},
            {"mean_degrees", format.meanDegrees},
            {"percentile99_degrees", format.percentile99}};
}

namespace {

// What a format costs an image that is read in `convention`.
Result<TriedFormat> costOfFormat(const Image& image, const Convention& convention, const std::string& word)
{
    Convention to{.expansion = Expansion::biased, .channels = convention.channels};
    COTAN_TRY(code, codeFor(word, "auto", to, "map.ktx2"));
    to = storedConvention(*code, to);
    RecodeCounts counts;
    const Convention taken = codeConvention(*code, to);
    const Image given = recode(image, {.from = convention, .to = taken, .type = PixelType::float32}, counts);
    COTAN_TRY(level, levelOf(given, *code, to));
    ValueStatistics degrees;
    COTAN_CHECK(addCosts(given, taken, *level, *code, to, "map.ktx2", degrees));
    return TriedFormat{word, bitsPerTexel(*code), degrees.mean(), degrees.percentile(0.99)};
}

} // namespace

std::vector<TriedFormat> costsOf(const Image& map, const Convention& convention)
{
    const Image sample = sampleOf(map);
    std::vector<TriedFormat> costs;
    for (const char* const word : {"uastc", "bc7", "astc-6x6", "astc-8x8", "bc5", "eac-rg11"})
        if (const auto cost = costOfFormat(sample, convention, word))
            costs.push_back(*cost);
    return costs;
}

std::optional<CostBefore> costBefore(const Image& map, const Convention& convention)
{
    if (const auto degrees = jpegCost(map))
        return CostBefore{"jpeg", *degrees};
    constexpr int kLeast = 32, kSquare = 24;
    if (map.width < kLeast || map.height < kLeast)
        return std::nullopt;
    const auto four = [&](FourColours colours, int left) { // what four colours cost, on average
        const Image sample = sampleOf(map, kSquare, left, left);
        ValueStatistics degrees;
        for (const float angle : anglesBetween(sample, convention, inFourColours(sample, colours), convention))
            degrees.add(double(angle), angle >= 0 ? 1 : 0);
        return degrees.count() > 0 ? degrees.mean() : 0;
    };
    constexpr double kHidden = 1.25; // what the lines of the file hide: a median of ten maps
    if (map.blocks == "bc1" || (map.blocks == "bc3" && swizzleOf(map) == Swizzle::rg))
        return CostBefore{map.blocks, kHidden * four(FourColours::line, 2)};
    if (map.blocks == "etc2")
        return CostBefore{map.blocks, kHidden * four(FourColours::plane, 2)};
    if (map.blocks == "etc1s") // half of what lies beside the means of blocks stands for what lay beside the grey lines
        return CostBefore{map.blocks, (four(FourColours::grey, 2) + four(FourColours::one, 0)) / 2};
    const auto code = codeNamed(map.blocks);
    if (!code || *code == TexelCode::rgba8 || *code == TexelCode::bc3)
        return std::nullopt;
    const int both = std::lcm(code->width, code->height);
    Image sample = sampleOf(map, both * std::max(1, kSquare / both), code->width / 2, code->height / 2);
    Convention read = convention;
    if (map.channels == 2) {
        read.channels = Channels::orthographic;
        unswizzle(sample, swizzleOf(sample));
    }
    const auto cost = costOfFormat(sample, read, map.blocks);
    return cost ? std::optional(CostBefore{map.blocks, cost->meanDegrees}) : std::nullopt;
}

Result<ChosenFormat> chooseFormat(const Convention& to, const std::string& swizzle, const std::filesystem::path& file,
                                  const FormatBudget& budget, const MakeTexture& make)
{
    COTAN_TRY(candidates, candidatesFor(to, swizzle, file, budget.device));
    ChosenFormat chosen;
    std::optional<TriedFormat> best;
    for (std::size_t i = 0; i < candidates->size(); ++i) {
        const Candidate& candidate = (*candidates)[i];
        if (best && candidate.bits > best->bitsPerTexel)
            break;
        COTAN_TRY(made, make(candidate.code, i, candidates->size()));
        if (!made->cost)
            return Error{ErrorKind::unavailable,
                         fmt::format("{}: this build cannot read {}, to measure it", file.string(), candidate.word)};
        const auto& [mean, percentile99] = *made->cost;
        chosen.tried.push_back({candidate.word, candidate.bits, mean, percentile99});
        if (mean > budget.limits.mean || percentile99 > budget.limits.percentile99
            || (best && mean >= best->meanDegrees))
            continue;
        best = chosen.tried.back();
        chosen.compress = candidate.word;
        chosen.code = candidate.code;
        chosen.made = *std::move(made);
    }
    if (best)
        return chosen;
    const auto nearest = std::ranges::min_element(chosen.tried, {}, &TriedFormat::meanDegrees);
    return about(
        "options.maxDegrees",
        Error{ErrorKind::limit,
              fmt::format("expected a format within {:.3g} degrees on average and {:.3g} on 99 % of the texels; "
                          "found none: {} has {:.3f} and {:.2f}",
                          budget.limits.mean, budget.limits.percentile99, nearest->compress, nearest->meanDegrees,
                          nearest->percentile99)});
}

} // namespace cotan::app
