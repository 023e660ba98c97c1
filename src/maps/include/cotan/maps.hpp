// Analyses, classifies, re-encodes, blends and downsamples normal maps. Reads and writes no files.
//
//     auto map = cotan::readImage("map.png");
//     const cotan::maps::GreenVerdict verdict = cotan::maps::greenOf(*map);
//     std::printf("green points %s: %s\n", name(verdict.green), verdict.reason.c_str());
//     cotan::maps::RecodeSettings settings;
//     settings.from = *cotan::parseConvention("directx");
//     settings.to = *cotan::parseConvention("gltf");
//     cotan::maps::RecodeCounts counts;
//     const cotan::Image recoded = cotan::maps::recode(*map, settings, counts);
//
// All functions here use image space: x points right, y up the image, z out of it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "cotan/convention.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan::maps {

class PatchSampler; // internal: square patches of a large image

// ---- what the numbers say ------------------------------------------------------------------

// What the stored numbers alone reveal about an image as a normal map, when its convention is unknown.

// The components that hold x and y in a two-channel map.
enum class Swizzle {
    rg,        // x in red, y in green
    greyAlpha, // x in red, green and blue, y in alpha: from two-channel files
    alphaGreen // x in alpha, y in green, red constant: "DXT5nm"
};

enum class Content {
    tangentSpace, // three channels, blue above the middle nearly everywhere
    objectSpace,  // three channels, directions on both sides
    twoChannel,   // x and y only
    slopes,       // two channels, many texels outside the unit disc: not an orthographic map
    signedValues, // three channels, stored signed
    flat,         // a single direction, which reveals nothing
    grey,         // red, green and blue are equal: probably a height map
    other,        // lengths that no normal map has: a colour image
};
enum class Centre { exact, biased, unknown };     // which code is zero: 128 of 255 (exact) or 127.5 (biased)
enum class Transfer { linear, srgb, linearised }; // srgb: encoded, linearised: decoded, as if colour

struct NormalStatistics {
    Content content = Content::other;
    Swizzle swizzle = Swizzle::rg;
    Centre centre = Centre::unknown;
    Transfer transfer = Transfer::linear;
    bool redIsZ = false;       // red points outwards nearly everywhere and blue does not: they are exchanged
    bool eightBits = false;    // 16-bit components whose values are all multiples of an 8-bit step
    bool signedStored = false; // floats below zero, or unit vectors stored unencoded
    bool transparent = false;  // alpha is 0 everywhere, and is ignored
    bool alphaMasks = false;   // texels whose alpha is 0 are outside the charts
    std::size_t texels = 0;
    double background = 0;        // fraction outside the charts, excluded below: alpha 0, black, white, uniform fill
    double invalid = 0;           // fraction that is not finite or has length below 0.1
    double belowHorizon = 0;      // fraction with z < -0.02
    double outsideDisc = 0;       // fraction with x^2 + y^2 > 1.02
    double meanLength = 0;        // of valid texels, decoded with `centre` (exact if unknown)
    double lengthDeviation = 0;   // root mean square of (length - 1)
    double shortened = 0;         // fraction with length below 0.9
    std::array<double, 3> mean{}; // of x, y, z in image space, green up
    std::array<double, 3> lowest{}, highest{}; // of the stored components
    double meanTilt = 0;                       // degrees from (0,0,1)
    std::array<double, 9> tilt{};              // fraction in 0..10, 10..20, ... 70..80 degrees, and 80 or more
    double rmsExact = 0, rmsBiased = 0;        // of (length - 1), for each centre
};

// What alpha of a map means: bakers and painting programs clear it outside the charts; glTF ignores it.
enum class AlphaUse { masksCharts, ignored };

// Whether a texel's own value shows that it lies between charts: (nearly) black or (nearly) white, or, if alpha masks
// charts, alpha 0.
bool outsideCharts(const glm::vec4& texel, bool alphaMasks);

// Whether a three-channel normal can still have this length after filtering or compression.
bool usableLength(float length);

// Makes two passes over the image, which may have any size and content.
NormalStatistics statisticsOfMap(const Image& image);

// Statistics of a model's map, whose alpha is ignored, from at most 16 x 16 evenly spaced patches of 16 x 16 texels:
// takes milliseconds for any size.
NormalStatistics statisticsOfSample(const Image& image);

// The same statistics for an image that arrives in strips from the top, twice: every strip to addFirstPass(), then
// every strip to addSecondPass(). Strips have a multiple of 16 rows, except the last one.
class MapSurvey {
public:
    explicit MapSurvey(AlphaUse alpha = AlphaUse::masksCharts);
    ~MapSurvey();
    void addFirstPass(const Image& strip);
    bool oneColour() const; // after the first pass: all texels are equal, and the second pass may be skipped
    void addSecondPass(const Image& strip);
    NormalStatistics finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// A short phrase such as "tangent space" or "two channels (slopes)".
std::string describe(Content content);

// ---- which way green points ----------------------------------------------------------------

// The slopes a = dh/dx and b = dh/dy of a height h satisfy da/dy = db/dx. A map whose green is negated satisfies da/dy
// = -db/dx instead; in a map with red and green exchanged, a and b trade places. Bumps and dents cannot be
// distinguished: (x,-y) and (-x,y) are the same relief, once as bumps and once as dents. We assume that red points
// right, as in every convention.
//
// Only the charts of a map count. The space between them (alpha 0, black, white, a single colour) carries no
// information. Slopes jump where two charts meet, so each cell's weight is bounded.

enum class Green { up, down, undecidable };
enum class Swapped { no, yes, undecidable };
enum class Confidence { none, likely, certain };

struct GreenVerdict {
    Green green = Green::undecidable;
    Swapped swapped = Swapped::undecidable; // red and green exchanged
    Confidence confidence = Confidence::none;
    std::string reason; // one sentence: why, or why not
    // Correlation of da/dy with db/dx, assuming green points up: +1 for green up, -1 for green down, near 0 when
    // undecidable. `exchanged`: the same with red and green exchanged.
    double agreement = 0, exchanged = 0;
    double deviations = 0;       // |agreement| over its standard error, by a jackknife over the patches
    double residualRatio = 1;    // unexplained residual of the opposite direction over that of this one
    double votes = 0;            // fraction of the patches, by weight, that agree with the verdict
    double used = 0;             // fraction of the texel cells in the patches that carry information
    double sampled = 1;          // fraction of the image that the patches cover
    NormalStatistics statistics; // of the patches
};

const char* name(Green green);           // up, down, undecidable
const char* name(Swapped swapped);       // no, yes, undecidable
const char* name(Confidence confidence); // none, likely, certain

GreenVerdict greenOf(const PatchSampler& sampler, AlphaUse alpha = AlphaUse::masksCharts);
GreenVerdict greenOf(const Image& image,
                     AlphaUse alpha = AlphaUse::masksCharts); // samples the same patches; needs pixels

// ---- faults --------------------------------------------------------------------------------

// Faults of a normal map as a file, and how to fix them.

struct Fault {
    enum class Kind {
        srgb,
        linearised,
        redAndBlue,
        redAndGreen,
        tooShort,
        tooLong,
        eightBitsIn16,
        greenDown,
        // Faults of a model's map, which glTF reads as three channels in tangent space:
        twoChannels,
        slopes,
        objectSpace,
        height,
        noNormals
    };
    Kind kind{};
    std::string text; // one sentence
};

// srgb, linearised, bgr, grb, washed_out, too_strong, 8_in_16, green_down, two_channels, slopes, object_space, height,
// no_normals
const char* name(Fault::Kind kind);

// Returns the faults that the statistics reveal; for images that are no normal map, only those of the bit depth.
// `green`: the verdict on the same map, which adds faults of the green channel; may be null.
std::vector<Fault> faultsOf(const NormalStatistics& statistics, const GreenVerdict* green = nullptr);

// The faults of a model's normal map: these, and contents that glTF does not read as they are meant. Each door that
// reads models reports the faults of statisticsOfSample.
std::vector<Fault> faultsInModel(const NormalStatistics& statistics, const GreenVerdict* green = nullptr);

// Whether a model is lit wrongly by such a map.
bool changesLight(Fault::Kind kind);

// What is odd about a map but changes no normal, one sentence; empty if there is nothing.
std::string noteOf(const NormalStatistics& statistics);

// One sentence with its name for each normal map of a scene, clear coats included, that has faults in the model or a
// note. judgeGreen: also where green points down although it is read as up, which takes up to a second for a map;
// without it a map takes milliseconds. Maps that are not read as three channels, and images without pixels, have none.
std::vector<std::string> mapFaults(const Scene& scene, bool judgeGreen = false);

// The options of `cotan map convert` that fix all faults, such as "--from directx,srgb --to opengl"; empty without
// faults. A map whose zero is 127.5 keeps it: negating green about 128 would tilt it by 0.45 degrees. A file of two
// channels is read as such; as glTF reads it only if that is one of the faults.
enum class ReadAs { file, glTF };
std::string fixOptions(const std::vector<Fault>& faults, const NormalStatistics& statistics,
                       ReadAs reading = ReadAs::file);

// What the word `auto` in place of a convention means: how a map is stored, and what repairs it. The v of `from` is
// that of `to`; so is its zero where none can be told.
struct FoundMap {
    StatedConvention from{};
    Convention to{};                           // as requested, but a zero of 127.5 stays unless a word states another
    bool normalise = false, eightBits = false; // see RecodeSettings; all 16-bit components have 8-bit values
};

// subject: begins the message. look: gives the verdict on the map after a damage is undone; called once or twice.
// Errors: those of `look`; ErrorKind::input: green is undecidable.
Result<FoundMap> findMap(const std::string& subject, const StatedConvention& to,
                         const std::function<Result<GreenVerdict>(const Damage&)>& look);

// "NAME: FAULT; FAULT; cotan map convert OPTIONS fixes it."; without the command if none fixes it; empty without
// faults.
std::string sentenceOf(const std::string& name, const std::vector<Fault>& faults, const NormalStatistics& statistics);

// What certainly contradicts the convention that someone states for a map, such as "green points up, not down"; empty
// if nothing does. verdict: of the map, after the stated damage was undone.
std::string contradictionOf(const GreenVerdict& verdict, const Convention& stated);
std::string contradictionOf(const Image& map, const Convention& stated); // judges a million texels at most

// ---- stated conventions --------------------------------------------------------------------

// How to read a map, from what the user states and what its file says itself.

// The convention to read a map with. A file that stores two channels (BC5, KTX2 and DDS of red and green, grey with
// alpha) takes precedence: unless stated otherwise, z is reconstructed from x and y. file: its name. channels:
// Image::channels. option: the option that stated the convention, for messages.
// Errors: ErrorKind::usage, starting with `option`: three channels are stated, and the file has two; ErrorKind::input:
// the file has one.
Result<Convention> conventionOf(const StatedConvention& stated, const std::string& file, int channels,
                                const std::string& option);

// Makes an image readable by what conventionOf returns, which it returns: moves x and y of two channels to red and
// green, wherever they are, and undoes the damage. Errors: those of conventionOf.
Result<Convention> makeReadable(Image& image, const StatedConvention& stated, const std::string& file,
                                const std::string& option);

// Undoes damage: first the transfer curve on red, green and blue, then their order. The pixel type stays. unorm values
// are rounded to the nearest step; for a map that was saved through the curve by mistake this restores the original
// step.
void undo(const Damage& damage, Image& image);

// ---- to another convention -----------------------------------------------------------------

struct RecodeSettings {
    Convention from{}, to{};
    PixelType type = PixelType::unorm8; // of the result
    float strength = 1;                 // factor on the slopes; not 0
    bool normalise = false;             // three channels to three: by default lengths are kept
    bool dither = false;                // adds noise of half a step before rounding; flat stays flat
    int firstRow = 0;                   // of these rows in the whole image, for the noise
};

// What the conversion could not keep.
struct RecodeCounts {
    std::size_t invalid = 0; // not finite or without length: written as flat
    std::size_t clamped = 0; // slopes over 1, or directions below the horizon, which the target cannot hold
};

// Converts the map to another convention. Alpha is kept if both have three channels. Signed values need float32. If
// only the green channel changes and lengths are kept, unorm values map one to one.
Image recode(const Image& map, const RecodeSettings& settings, RecodeCounts& counts);

// ---- blending ------------------------------------------------------------------------------

enum class BlendMode { reoriented, whiteout, udn, slopes, linear }; // defined in cotan/blend.h

struct BlendSettings {
    Convention base{}, detail{}, to{};
    BlendMode mode = BlendMode::reoriented;
    float strength = 1;          // factor on the detail's slopes
    int tilesX = 1, tilesY = 1;  // repetitions of the detail over the base; at least 1
    const Image* mask = nullptr; // red scales the strength; any size; null: strength everywhere
    PixelType type = PixelType::unorm8;
    bool dither = false;
    int firstRow = 0, imageHeight = 0; // first row and height of the whole image; 0: base is whole
};

// Returns the blend, which has the base's size, and its alpha if both have three channels. The detail repeats and is
// filtered bilinearly; where it is minified, it is averaged as vectors over the texel's footprint. invalid: texels
// where base or detail has no direction; these take the other one.
Image blend(const Image& base, const Image& detail, const BlendSettings& settings, std::size_t& invalid);

// ---- heights -------------------------------------------------------------------------------

// Units: the solvers measure heights in texels (a slope of 1 rises by one texel width per texel). The caller scales by
// the size of a texel in metres and the height of white.

enum class Kernel {
    spectral, // exact for smooth periodic heights; only for normal maps to heights
    forward,  // next minus this: sharpest, shifted by half a texel
    central,  // half of (next minus previous)
    sobel,    // central, smoothed across with 1 2 1
    scharr,   // central, smoothed across with 3 10 3: most isotropic
};
enum class Wrap { repeat, clamp, mirror };

struct FromHeightSettings {
    Kernel kernel = Kernel::central; // not spectral
    Wrap wrap = Wrap::repeat;
    double scaleX = 1, scaleY = 1; // slope per unit of stored height and texel
    Convention to;
    PixelType type = PixelType::unorm16;
    bool dither = false;
    bool bordered = false; // the first and last row only serve as neighbours and are missing from the result; wrap
                           // applies to left and right
    int firstRow = 0;      // of the result in a larger image, for the dither
};

// Returns the normal map of a height image, whose red channel is read. invalid: texels with a neighbouring height that
// is not finite; they become flat.
Image normalsFromHeight(const Image& height, const FromHeightSettings& settings, std::size_t& invalid);

enum class Boundary { periodic, free };

struct ToHeightSettings {
    Convention from;
    Boundary boundary = Boundary::periodic;
    Kernel kernel = Kernel::spectral; // that the slopes were made with; free: with clamped borders
    double aspect = 1;                // a texel's height over its width, both in metres
};

struct Heights {
    std::vector<float> texels; // in texel widths, mean 0, rows from the top
    double lowest = 0, highest = 0;
    double slope = 0;        // root mean square of the map's slopes
    double residual = 0;     // root mean square of the slopes that no height explains: curl, rounding
    double meanTilt = 0;     // degrees, of the mean slope; periodic heights cannot reproduce it
    std::size_t invalid = 0; // texels without a direction, taken as flat; slopes are clamped to 128
};

// Returns the least-squares height, whose slopes are nearest to the map's. Periodic: R. Frankot, R. Chellappa, A Method
// for Enforcing Integrability in Shape from Shading Algorithms, 1988, with the kernel's frequency response in place of
// the derivative's. Free: the same over heights that are clamped at the borders, by cosine transforms; spectral: over
// differences of neighbours, Poisson's equation with natural boundaries.
Heights heightFromNormals(const Image& map, const ToHeightSettings& settings);

// Bytes that heightFromNormals allocates for periodic heights in addition to the map, to check before the call. Free
// heights take a third of the memory and the same time.
std::size_t heightWorkBytes(int width, int height);

// ---- mips ----------------------------------------------------------------------------------

// Mip chains filtered as vectors, and the roughness that compensates for lost detail.
//
// The mean of differing unit normals has a length R below 1. Normalising it discards their variance, and a rough
// surface seen from afar turns smooth. The variance is added to the roughness instead.

enum class VarianceModel {
    toksvig, // variance (1-R)/R on Blinn-Phong's exponent; M. Toksvig, Mipmapping Normal Maps, 2005
    vmf,     // 2/kappa added, kappa = (3R - R^3)/(1 - R^2); C. Han et al., Frequency Domain Normal Map Filtering, 2007
    lean     // the variance of the slopes; M. Olano, D. Baker, LEAN Mapping, 2010
};

struct MipSettings {
    Convention from{}, to{};
    bool keepLengths = false; // three channels: store the mean vector instead of its direction
    VarianceModel model = VarianceModel::lean;
    double roughness = 0.3; // of the material, perceptual (alpha is its square), [0,1]
    PixelType type = PixelType::unorm8;
};

struct MipLevel {
    Image normals;
    Image roughness;       // grey, perceptual
    double meanLength = 1; // of the mean vectors before normalisation
    double meanRoughness = 0;
};

// The perceptual roughness of a surface with the given perceptual roughness, [0,1], whose unit normals have a mean of
// length R, [0,1], or whose slopes have the given variance (of x plus that of y, >= 0). The result is at most 1.
double roughnessFromLength(double roughness, double length, VarianceModel model); // toksvig, vmf
double roughnessFromVariance(double roughness, double variance);                  // lean

// Returns level 0 (the re-encoded map) to the level of 1 x 1. Each texel is the area average of the level before, also
// for odd sizes. Texels without a direction do not count; slopes are clamped to 128.
std::vector<MipLevel> mipChain(const Image& map, const MipSettings& settings);

// ---- comparison ----------------------------------------------------------------------------

// For each texel the angle in degrees between two maps of the same size, each read with its own convention; -1 where
// either is not a direction (not finite, or without length).
std::vector<float> anglesBetween(const Image& a, const Convention& conventionA, const Image& b,
                                 const Convention& conventionB);

} // namespace cotan::maps
