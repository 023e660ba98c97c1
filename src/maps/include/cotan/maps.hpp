// Measures, tells apart, re-encodes, blends and shrinks normal maps. No files.
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
// Image space, used by everything here: x to the right, y up the image, z out of it.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "cotan/convention.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan::maps {

class PatchSampler; // inside: squares of a large image

// ---- what the numbers say ------------------------------------------------------------------

// What the numbers of a picture say about it as a normal map, before anyone says how it is stored.

// Which of the four components hold a two-channel map.
enum class Swizzle {
    rg,        // x in red, y in green
    greyAlpha, // x in red, green and blue, y in alpha: files of two channels
    alphaGreen // x in alpha, y in green, red constant: "DXT5nm"
};

enum class Content {
    tangentSpace, // three channels, nearly all of blue above the middle
    objectSpace,  // three channels, directions on both sides
    twoChannel,   // x and y only
    slopes,       // two channels, many outside the unit disc: no orthographic map
    signedValues, // three channels, stored signed
    flat,         // one direction only: nothing can be told
    grey,         // red, green and blue the same: a height map, perhaps
    other,        // lengths that no normal map has: a colour picture
};
enum class Centre { exact, biased, unknown };     // the middle code, 128 of 255, or 127.5 as zero
enum class Transfer { linear, srgb, linearised }; // srgb: stored as if it were a colour

struct NormalStatistics {
    Content content = Content::other;
    Swizzle swizzle = Swizzle::rg;
    Centre centre = Centre::unknown;
    Transfer transfer = Transfer::linear;
    bool redIsZ = false;       // red points outwards nearly everywhere, and blue does not: they are exchanged
    bool eightBits = false;    // 16-bit components that are all steps of 8 bits
    bool signedStored = false; // floats that go below zero, or unit vectors as they are
    std::size_t texels = 0;
    double background = 0;        // share outside the charts: alpha 0, black, white, fields of another colour; the rest
                                  // leaves it out
    double invalid = 0;           // share: not finite, or length under 0.1
    double belowHorizon = 0;      // share with z < -0.02
    double outsideDisc = 0;       // share with x^2 + y^2 > 1.02
    double meanLength = 0;        // of the valid ones, read with the centre found (exact if unknown)
    double lengthDeviation = 0;   // root mean square of (length - 1)
    double shortened = 0;         // share of length under 0.9
    std::array<double, 3> mean{}; // of x, y, z in picture space, green up
    std::array<double, 3> lowest{}, highest{}; // stored components
    double meanTilt = 0;                       // degrees from flat
    std::array<double, 9> tilt{};              // share in 0..10, 10..20, ... 80..90 degrees and beyond
    double rmsExact = 0, rmsBiased = 0;        // (length - 1) under either centre
};

// Whether a texel says by itself that it lies between the charts of a map: alpha 0, (nearly) black or white.
bool outsideCharts(const glm::vec4& texel);

// Whether a normal of three channels, filtered or compressed, can still have that length.
bool usableLength(float length);

// Reads the whole picture twice. Any size, any contents.
NormalStatistics statisticsOfMap(const Image& image);

// The same for a picture that comes in strips from the top: all of them once, then all of them again.
// Strips of 16 rows, or multiples, but for the last one.
class MapSurvey {
public:
    MapSurvey();
    ~MapSurvey();
    void first(const Image& strip);
    bool oneColour() const; // after the first pass: all texels are alike, and the second may be left out
    void second(const Image& strip);
    NormalStatistics finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// A few words, such as "tangent space" or "two channels (slopes)".
std::string describe(Content content);

// ---- which way green points ----------------------------------------------------------------

// The slopes a = dh/dx and b = dh/dy of a height h satisfy da/dy = db/dx. A map whose green is
// negated satisfies da/dy = -db/dx instead, and one with red and green exchanged has them in each
// other's place. What cannot be told: whether bumps are dents. (x,-y) and (-x,y) are the same
// relief, once seen as bumps and once as dents; we take red to point right, as every convention has it.
//
// Maps of charts are judged by their charts: what lies between them (alpha 0, black, white, one colour) says
// nothing, and where two charts meet the slopes jump, so that large steps count no more than small ones.

enum class Green { up, down, undecidable };
enum class Swapped { no, yes, undecidable };
enum class Confidence { none, likely, certain };

struct GreenVerdict {
    Green green = Green::undecidable;
    Swapped swapped = Swapped::undecidable; // red and green exchanged
    Confidence confidence = Confidence::none;
    std::string reason; // one sentence: why, or why not
    // Correlation of da/dy with db/dx, green taken to point up: +1 for green up, -1 for green down,
    // near 0 when there is nothing to tell. `exchanged`: the same with red and green exchanged.
    double agreement = 0, exchanged = 0;
    double deviations = 0;       // |agreement| in units of its uncertainty, from patches left out in turn
    double residualRatio = 1;    // what the other way leaves unexplained over what this way leaves
    double votes = 0;            // share of the patches, by weight, that agree with the verdict
    double used = 0;             // share of the texel cells in the patches that say something
    double sampled = 1;          // share of the picture that the patches hold
    NormalStatistics statistics; // of the patches
};

const char* name(Green green);           // up, down, undecidable
const char* name(Swapped swapped);       // no, yes, undecidable
const char* name(Confidence confidence); // none, likely, certain

GreenVerdict greenOf(const PatchSampler& sampler);
GreenVerdict greenOf(const Image& image); // sampled in the same way; needs pixels

// ---- faults --------------------------------------------------------------------------------

// What is wrong with a normal map as a file, and how to fix it.

struct Fault {
    enum class Kind { srgb, linearised, redAndBlue, redAndGreen, tooShort, tooLong, eightBitsIn16, greenDown };
    Kind kind{};
    std::string text; // one sentence
};

const char* name(Fault::Kind kind); // srgb, linearised, bgr, grb, washed_out, too_strong, 8_in_16, green_down

// What the numbers alone tell; of pictures that are no normal map nothing but their bits. `green`: the verdict on the
// same map, for the green channel too; null: without it.
std::vector<Fault> faultsOf(const NormalStatistics& statistics, const GreenVerdict* green = nullptr);

// The options of `cotan map convert` that fix them all, such as "--from directx,srgb --to gltf"; empty without faults.
// A map whose zero is 127.5 keeps it: green that is turned about 128 would lean by 0.45 degrees.
std::string fixOptions(const std::vector<Fault>& faults, const NormalStatistics& statistics);

// "NAME: FAULT; FAULT; cotan map convert OPTIONS fixes it."; empty without faults.
std::string sentenceOf(const std::string& name, const std::vector<Fault>& faults, const NormalStatistics& statistics);

// ---- what somebody says of a map -----------------------------------------------------------

// How a map is to be read: what somebody says of it, and what its file says itself.

// The convention to read a map with. A file that stores two channels (BC5, KTX2 and DDS of red and green, grey with
// alpha) is believed: z comes from x and y where the words do not say how. file: its name. channels: Image::channels.
// option: what said the words, for messages.
// Errors: ErrorKind::usage, begun with `option`: the words name three channels, and the file has two;
// ErrorKind::input: the file has one.
Result<Convention> conventionOf(const StatedConvention& stated, const std::string& file, int channels,
                                const std::string& option);

// Undoes damage: the curve on red, green and blue, then their order. Values keep their type; of unorm ones the nearest
// step is taken, which for a map that was saved through the curve by mistake is the step that it had.
void undo(const Damage& damage, Image& image);

// ---- to another convention -----------------------------------------------------------------

struct RecodeSettings {
    Convention from{}, to{};
    PixelType type = PixelType::unorm8; // of the result
    float strength = 1;                 // factor on the slopes; not 0
    bool normalise = false;             // three channels to three: otherwise lengths are kept
    bool dither = false;                // half a step of noise before rounding; flat stays flat
    int firstRow = 0;                   // where the rows lie in the picture, for the noise
};

// What could not be kept.
struct RecodeCounts {
    std::size_t invalid = 0; // not finite or without length: written as flat
    std::size_t clamped = 0; // slopes over 1, or directions below the horizon that the form cannot hold
};

// The map in the other form. Alpha is kept where both have three channels. Signed values need float32.
// Where nothing but the green channel changes and no length is touched, unorm values map one to one.
Image recode(const Image& map, const RecodeSettings& settings, RecodeCounts& counts);

// ---- blending ------------------------------------------------------------------------------

enum class BlendMode { reoriented, whiteout, udn, slopes, linear }; // cotan/blend.h says what each does

struct BlendSettings {
    Convention base{}, detail{}, to{};
    BlendMode mode = BlendMode::reoriented;
    float strength = 1;          // factor on the detail's slopes
    int tilesX = 1, tilesY = 1;  // how often the detail repeats over the base; at least 1
    const Image* mask = nullptr; // red times this much of the strength; any size; none: everywhere
    PixelType type = PixelType::unorm8;
    bool dither = false;
    int firstRow = 0, pictureHeight = 0; // the base is these rows of a picture of that height; 0: all of it
};

// The blend, of the base's size. The detail is filtered bilinearly and repeats; where it is shrunk it
// is averaged over the texel's footprint first, as vectors. invalid: texels where either is no direction;
// there the other one counts alone.
Image blend(const Image& base, const Image& detail, const BlendSettings& settings, std::size_t& invalid);

// ---- heights -------------------------------------------------------------------------------

// Units: the solvers know heights in texels (a slope of 1 rises one texel's width per texel). What a
// texel is in metres, and what white is, is a factor that the caller applies.

enum class Kernel {
    spectral, // exact for what repeats and is smooth; to-height only
    forward,  // next minus this: sharpest, half a texel off
    central,  // half of next minus previous
    sobel,    // central, smoothed across with 1 2 1
    scharr,   // central, smoothed across with 3 10 3: turns with the relief most evenly
};
enum class Wrap { repeat, clamp, mirror };

struct FromHeightSettings {
    Kernel kernel = Kernel::central; // not spectral
    Wrap wrap = Wrap::repeat;
    double scaleX = 1, scaleY = 1; // slope per unit of stored height and texel
    Convention to;
    PixelType type = PixelType::unorm16;
    bool dither = false;
    bool bordered = false; // the picture's first and last row are neighbours only: the result lacks them, and
                           // wrap is for left and right
    int firstRow = 0;      // where the result lies in a larger picture, for the dither
};

// The normal map of a height picture (red is read). invalid: texels whose heights around are not
// finite; they become flat.
Image normalsFromHeight(const Image& height, const FromHeightSettings& settings, std::size_t& invalid);

enum class Boundary { periodic, free };

struct ToHeightSettings {
    Convention from;
    Boundary boundary = Boundary::periodic;
    Kernel kernel = Kernel::spectral; // how the slopes were made. free: with the borders clamped
    double aspect = 1;                // a texel's height over its width, both in metres
};

struct Heights {
    std::vector<float> texels; // in widths of a texel, mean 0, rows from the top
    double lowest = 0, highest = 0;
    double slope = 0;        // root mean square of the map's slopes
    double residual = 0;     // root mean square of what no height explains: curl, rounding
    double meanTilt = 0;     // degrees; periodic heights cannot follow a tilt of the whole
    std::size_t invalid = 0; // texels that are no direction: taken as flat; slopes are held at 128
};

// Least squares: the height whose slopes are nearest to the map's. Periodic: R. Frankot, R.
// Chellappa, A Method for Enforcing Integrability in Shape from Shading Algorithms, 1988, with the kernel's own
// response in place of the derivative's. Free: the same over heights that are clamped at the borders, by cosine
// transforms; spectral: over differences of neighbours, Poisson's equation with natural boundaries.
Heights heightFromNormals(const Image& map, const ToHeightSettings& settings);

// Bytes that heightFromNormals takes beside the map, for a check before it is called: of periodic heights. Free ones
// take a third of the memory, and as long.
std::size_t heightWorkBytes(int width, int height);

// ---- mips ----------------------------------------------------------------------------------

// Chains of smaller maps, filtered as vectors, and the roughness that makes up for lost detail.
//
// The mean of unit vectors that spread has a length R below 1. Normalising it loses the spread, and
// a rough surface seen from afar turns smooth. The spread goes into the roughness instead.

enum class VarianceModel {
    toksvig, // variance (1-R)/R on Blinn-Phong's exponent; M. Toksvig, Mipmapping Normal Maps, 2005
    vmf,     // 2/kappa added, kappa = (3R - R^3)/(1 - R^2); C. Han et al., Frequency Domain Normal Map Filtering, 2007
    lean     // the variance of the slopes themselves; M. Olano, D. Baker, LEAN Mapping, 2010
};

struct MipSettings {
    Convention from{}, to{};
    bool keepLengths = false; // three channels: store the mean vector, not its direction
    VarianceModel model = VarianceModel::lean;
    double roughness = 0.3; // of the material, perceptual: alpha is its square; in [0,1]
    PixelType type = PixelType::unorm8;
};

struct MipLevel {
    Image normals;
    Image roughness;       // grey, perceptual
    double meanLength = 1; // of the mean vectors
    double meanRoughness = 0;
};

// The roughness, perceptual, of a surface of that roughness whose unit normals have a mean of length
// R, or whose slopes have this variance (of x and y together). Each in its valid range: roughness
// [0,1], R [0,1], variance from 0. The result is at most 1.
double roughnessFromLength(double roughness, double length, VarianceModel model); // toksvig, vmf
double roughnessFromVariance(double roughness, double variance);                  // lean

// Levels 0 (the map itself, re-encoded) to 1 x 1. Each texel is the mean over its area of the level before, also where
// sizes are odd. Texels that are no direction do not count; slopes are held at 128.
std::vector<MipLevel> mipChain(const Image& map, const MipSettings& settings);

// ---- comparison ----------------------------------------------------------------------------

// Per texel the angle in degrees between two maps of the same size, each read with its own
// convention; -1 where one of the two is not a direction (not finite, or of no length).
std::vector<float> anglesBetween(const Image& a, const Convention& conventionA, const Image& b,
                                 const Convention& conventionB);

} // namespace cotan::maps
