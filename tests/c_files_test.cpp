// The caller's functions in cotan_model_files: for which files and images they are called, that each result is released
// once, and what the library reports when they fail. The model is a square with a separate map file.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "cotan.h"

namespace {

char text[512];

constexpr char kModel[] =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "buffers": [{"uri": "square.bin", "byteLength": 140}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                  {"buffer": 0, "byteOffset": 48, "byteLength": 48},
    {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 12}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [2, 3, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
    {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
  "images": [{"uri": "bumps.png"}], "textures": [{"source": 0}],
  "materials": [{"normalTexture": {"index": 0}}],
  "meshes": [{"primitives": [
    {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}]})";

// The function that fails, and how.
enum class Failing {
    none,
    readSaysNo,
    readGivesNull,
    decodeSaysNo,
    decodeGivesBits,
    encodeSaysNo,
    encodeGivesNull,
    encodeGivesJpeg
};

struct Caller {
    Failing failing = Failing::none;
    std::vector<std::string> calls; // such as "read square.bin" or "done"
    std::vector<unsigned char> binary = std::vector<unsigned char>(140);
    std::array<unsigned char, 4 * 8 * 8> pixels{};
    // The PNG signature. The caller decodes, so nothing after the signature is read.
    unsigned char file[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

    Caller()
    {
        // A square of 2 by 3 with sheared uv, so that a conversion changes its map.
        const float positions[] = {0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0},
                    normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
        const float texcoords[] = {0, 0.9f, 0.6f, 0.9f, 0.9f, 0, 0.3f, 0};
        const unsigned short indices[] = {0, 1, 2, 0, 2, 3};
        std::memcpy(&binary[0], positions, 48);
        std::memcpy(&binary[48], normals, 48);
        std::memcpy(&binary[96], texcoords, 32);
        std::memcpy(&binary[128], indices, 12);
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            const unsigned char bump[] = {180, 150, 230, 255};
            std::memcpy(&pixels[i], bump, 4);
        }
    }

    cotan_model_files files()
    {
        cotan_model_files f = COTAN_INIT(cotan_model_files);
        f.user = this;
        f.read = [](void* user, const char* uri, const void** bytes, std::size_t* size) {
            Caller& self = *static_cast<Caller*>(user);
            self.calls.push_back(std::string("read ") + uri);
            if (self.failing == Failing::readSaysNo)
                return 1;
            const bool model = std::string(uri) == "square.bin";
            *bytes = model ? self.binary.data() : self.file;
            *size = model ? self.binary.size() : sizeof self.file;
            if (self.failing == Failing::readGivesNull)
                *bytes = nullptr;
            return 0;
        };
        f.decode = [](void* user, const char* name, const void* bytes, std::size_t size, cotan_image_view* picture) {
            Caller& self = *static_cast<Caller*>(user);
            self.calls.push_back(std::string("decode ") + name);
            EXPECT_TRUE(size == sizeof self.file && std::memcmp(bytes, self.file, size) == 0);
            EXPECT_EQ(picture->size, sizeof *picture);
            picture->width = picture->height = 8;
            picture->bits = self.failing == Failing::decodeGivesBits ? 7 : 8;
            picture->pixels = self.pixels.data();
            return int(self.failing == Failing::decodeSaysNo);
        };
        f.encode = [](void* user, const cotan_image_view* picture, const void** bytes, std::size_t* size) {
            Caller& self = *static_cast<Caller*>(user);
            self.calls.push_back("encode " + std::to_string(picture->width) + " x " + std::to_string(picture->height));
            static const unsigned char jpeg[8] = {0xFF, 0xD8, 0xFF, 0xE0, 0, 16, 'J', 'F'};
            *bytes = self.failing == Failing::encodeGivesNull ? nullptr
                : self.failing == Failing::encodeGivesJpeg    ? jpeg
                                                              : self.file;
            *size = sizeof self.file;
            return int(self.failing == Failing::encodeSaysNo);
        };
        f.done = [](void* user) { static_cast<Caller*>(user)->calls.push_back("done"); };
        return f;
    }

    // A conversion that encodes the map anew.
    static cotan_convert_options toCotangent()
    {
        cotan_convert_options options = COTAN_INIT(cotan_convert_options);
        options.to = "cotangent";
        return options;
    }

    cotan_status convert(cotan_bytes** glb)
    {
        const cotan_model_files f = files();
        const cotan_convert_options newMap = toCotangent();
        text[0] = '\0';
        return cotan_convert_gltf(kModel, sizeof kModel - 1, &f, &newMap, nullptr, glb, nullptr, text, sizeof text);
    }

    // Every call is released before the next, and every "done" follows a call.
    void expectEachDoneWith() const
    {
        ASSERT_EQ(calls.size() % 2, 0u);
        for (std::size_t i = 0; i < calls.size(); i += 2) {
            EXPECT_NE(calls[i], "done") << i;
            EXPECT_EQ(calls[i + 1], "done") << "after " << calls[i];
        }
    }
    std::size_t count(const std::string& call) const
    {
        return std::size_t(std::count(calls.begin(), calls.end(), call));
    }
};

TEST(CFiles, eachImageIsDecodedAndEncodedOnceAndReleased)
{
    Caller caller;
    cotan_bytes* glb = nullptr;
    ASSERT_EQ(caller.convert(&glb), COTAN_OK) << text;
    caller.expectEachDoneWith();
    for (const char* call : {"read square.bin", "encode 8 x 8"})
        EXPECT_EQ(caller.count(call), 1u) << call << " of " << testing::PrintToString(caller.calls);
    // Once more after it was encoded, to measure what that lost.
    EXPECT_EQ(caller.count("decode model.gltf: bumps.png"), 2u) << testing::PrintToString(caller.calls);
    // The new model contains the file that the caller encoded.
    const std::string made(static_cast<const char*>(cotan_bytes_data(glb)), cotan_bytes_size(glb));
    EXPECT_EQ(made.substr(0, 4), "glTF");
    EXPECT_NE(made.find("PNG\r\n", made.find("BIN")), std::string::npos);
    cotan_bytes_free(glb);
}

TEST(CFiles, aFailingCallbackEndsTheCallAndIsReleased)
{
    struct Case {
        Failing failing;
        cotan_status status;
        const char* message;
    };
    const Case cases[] = {
        {Failing::readSaysNo, COTAN_INPUT, "square.bin: there is no such file beside the model"},
        {Failing::readGivesNull, COTAN_INPUT, "square.bin: there is no such file beside the model"},
        {Failing::decodeSaysNo, COTAN_INPUT, "bumps.png: the caller did not decode the image"},
        {Failing::decodeGivesBits, COTAN_USAGE, "bumps.png.bits: expected 8, 16 or 32, found 7"},
        {Failing::encodeSaysNo, COTAN_OUTPUT, "the caller did not encode the image"},
        {Failing::encodeGivesNull, COTAN_OUTPUT, "the caller did not encode the image"},
        {Failing::encodeGivesJpeg, COTAN_OUTPUT, "expected a PNG file of the caller, found other data"},
    };
    for (const Case& c : cases) {
        Caller caller;
        caller.failing = c.failing;
        cotan_bytes* glb = nullptr;
        EXPECT_EQ(caller.convert(&glb), c.status) << c.message << ": " << text;
        EXPECT_NE(std::string(text).find(c.message), std::string::npos) << text;
        EXPECT_EQ(glb, nullptr);
        caller.expectEachDoneWith();
        EXPECT_FALSE(caller.calls.empty());
    }
}

// This caller's file decodes as the old map, whatever it was to encode: the error after the conversion is the error
// before.
TEST(CFiles, lossesOfTheCallersEncoderAreInTheReport)
{
    Caller caller;
    const cotan_model_files files = caller.files();
    cotan_bytes *glb = nullptr, *json = nullptr;
    cotan_convert_result result = COTAN_INIT(cotan_convert_result);
    const cotan_convert_options newMap = Caller::toCotangent();
    ASSERT_EQ(cotan_convert_gltf(kModel, sizeof kModel - 1, &files, &newMap, &result, &glb, &json, text, sizeof text),
              COTAN_OK)
        << text;
    const std::string report(static_cast<const char*>(cotan_bytes_data(json)), cotan_bytes_size(json));
    EXPECT_GT(result.worst_degrees_before, 2);
    EXPECT_DOUBLE_EQ(result.worst_degrees_after, result.worst_degrees_before);
    EXPECT_NE(report.find("as encoded by the caller, its error is"), std::string::npos) << report;
    cotan_bytes_free(glb);
    cotan_bytes_free(json);
}

TEST(CFiles, mapsThatAreKeptUnreadAreNotDecoded)
{
    for (const int keep : {1, COTAN_MAPS_UNREAD}) {
        Caller caller;
        const cotan_model_files files = caller.files();
        cotan_convert_options options = COTAN_INIT(cotan_convert_options);
        options.keep_maps = keep;
        cotan_bytes* glb = nullptr;
        ASSERT_EQ(
            cotan_convert_gltf(kModel, sizeof kModel - 1, &files, &options, nullptr, &glb, nullptr, text, sizeof text),
            COTAN_OK)
            << text;
        EXPECT_EQ(caller.count("decode model.gltf: bumps.png"), keep == COTAN_MAPS_UNREAD ? 0u : 1u);
        EXPECT_EQ(caller.count("encode 8 x 8"), 0u);
        cotan_bytes_free(glb);
    }
}

TEST(CFiles, imagesAreRenderedWithTheGivenOptions)
{
    Caller caller;
    const cotan_model_files files = caller.files();
    cotan_render_options options = COTAN_INIT(cotan_render_options);
    const auto render = [&](cotan_image** image) {
        text[0] = '\0';
        return cotan_render(kModel, sizeof kModel - 1, &files, &options, image, nullptr, text, sizeof text);
    };
    cotan_image* image = nullptr;
    options.word_count = 2;
    EXPECT_EQ(render(&image), COTAN_USAGE);
    EXPECT_STREQ(text, "options.words: expected an array, found null");
    const char* words[] = {"--size", nullptr};
    options.words = words;
    EXPECT_EQ(render(&image), COTAN_USAGE);
    EXPECT_NE(std::string(text).find("options.words"), std::string::npos) << text;
    EXPECT_EQ(render(nullptr), COTAN_USAGE);
    words[1] = "20x10";
    ASSERT_EQ(render(&image), COTAN_OK) << text;
    cotan_image_view made = COTAN_INIT(cotan_image_view);
    ASSERT_EQ(cotan_image_pixels(image, &made, text, sizeof text), COTAN_OK) << text;
    EXPECT_EQ(made.width, 20);
    EXPECT_EQ(made.height, 10);
    EXPECT_EQ(made.bits, 8);
    cotan_image_free(image);
    const char* lit[] = {"--lighting", "tangent-vertex"}; // an option of earlier versions
    options.words = lit;
    options.word_count = 2;
    EXPECT_EQ(render(&image), COTAN_USAGE);
    EXPECT_NE(std::string(text).find("unknown option --lighting: lights are always"), std::string::npos) << text;
    options.floats = 1;
    options.word_count = 0; // then the array is not read
    ASSERT_EQ(render(&image), COTAN_OK) << text;
    ASSERT_EQ(cotan_image_pixels(image, &made, text, sizeof text), COTAN_OK) << text;
    EXPECT_EQ(made.bits, 32);
    cotan_image_free(image);
}

// Numbers in words have a decimal point, also in a host with decimal commas (locale.cmake). Light is linear: float
// pixels are the exposure times those of exposure 1, but for rounding.
TEST(CFiles, anExposureWithDecimalsScalesAllLight)
{
    const auto render = [](const char* exposure) {
        const char* words[] = {"--device",     "reference",   "--size",    "8x8", "--environment", "studio",
                               "--background", "environment", "--samples", "1",   "--exposure",    exposure};
        cotan_render_options options = COTAN_INIT(cotan_render_options);
        options.words = words;
        options.word_count = std::size(words);
        options.floats = 1;
        cotan_image* image = nullptr;
        EXPECT_EQ(cotan_render(nullptr, 0, nullptr, &options, &image, nullptr, text, sizeof text), COTAN_OK) << text;
        cotan_image_view made = COTAN_INIT(cotan_image_view);
        EXPECT_EQ(cotan_image_pixels(image, &made, text, sizeof text), COTAN_OK) << text;
        const auto* first = static_cast<const float*>(made.pixels);
        const std::vector<float> values(first, first + std::size_t(4 * made.width * made.height));
        cotan_image_free(image);
        return values;
    };
    const auto once = render("1"), more = render("1.5"), less = render("0.25");
    ASSERT_EQ(once.size(), 256u);
    ASSERT_EQ(more.size(), once.size());
    ASSERT_EQ(less.size(), once.size());
    float brightest = 0;
    for (std::size_t i = 0; i < once.size(); ++i)
        if (i % 4 != 3) {
            brightest = std::max(brightest, once[i]);
            EXPECT_NEAR(more[i], 1.5f * once[i], 1e-5f * once[i]) << i;
            EXPECT_NEAR(less[i], 0.25f * once[i], 1e-5f * once[i]) << i;
        }
    EXPECT_GT(brightest, 0.1f) << "the image is black";
}

// Slopes of crossing waves: the slope along x varies along y as the slope along y varies along x. With red and green
// exchanged that no longer holds.
TEST(CFiles, exchangedRedAndGreenAreDetected)
{
    constexpr int kWidth = 96, kHeight = 64;
    for (const bool exchanged : {false, true}) {
        std::vector<float> pixels;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                // Height: 2 sin(x/4 + y/7) + sin(x/9 - y/5) + sin(x/6); y points down, green up.
                const double a = std::cos(x / 4.0 + y / 7.0), b = std::cos(x / 9.0 - y / 5.0), c = std::cos(x / 6.0);
                double dx = -(2 * a / 4 + b / 9 + c / 6), dy = 2 * a / 7 - b / 5;
                if (exchanged)
                    std::swap(dx, dy);
                const double length = std::sqrt(1 + dx * dx + dy * dy);
                for (const double n : {dx / length, dy / length, 1 / length})
                    pixels.push_back(float(0.5 * n + 0.5));
                pixels.push_back(1);
            }
        const cotan_image_view map{sizeof map, kWidth, kHeight, 32, pixels.data()};
        cotan_green green = COTAN_INIT(cotan_green);
        ASSERT_EQ(cotan_map_green(&map, &green, text, sizeof text), COTAN_OK) << text;
        EXPECT_EQ(green.swapped, int(exchanged)) << green.reason;
        if (!exchanged) {
            EXPECT_EQ(green.direction, 1) << green.reason;
        }
    }
}

// Asymmetric waves stored as an 8-bit map in each way that cotan_map_info distinguishes: zero at 128 or between 127 and
// 128; encoded as if they were an sRGB colour, or decoded as if they had been one.
TEST(CFiles, zeroAndTransferOfAMapAreDetected)
{
    constexpr int kWidth = 96, kHeight = 64;
    const auto toSrgb = [](double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
    const auto toLinear = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
    struct Row {
        double zero, most;
        int curve;
        int expectedZero, expectedSrgb;
    };
    for (const Row& row :
         {Row{128, 127, 0, 128, 0}, {127.5, 127.5, 0, 127, 0}, {127.5, 127.5, 1, -1, 1}, {127.5, 127.5, -1, -1, -1}}) {
        std::vector<unsigned char> pixels;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double dx = -0.5 * std::cos(x / 4.0 + y / 7.0), dy = 0.3 * std::cos(x / 9.0 - y / 5.0);
                const double length = std::sqrt(1 + dx * dx + dy * dy);
                for (const double n : {dx / length, dy / length, 1 / length}) {
                    const double code = (row.zero + row.most * n) / 255;
                    const double curved = row.curve > 0 ? toSrgb(code) : row.curve < 0 ? toLinear(code) : code;
                    pixels.push_back(static_cast<unsigned char>(std::lround(255 * curved)));
                }
                pixels.push_back(255);
            }
        const cotan_image_view map{sizeof map, kWidth, kHeight, 8, pixels.data()};
        cotan_map_info info = COTAN_INIT(cotan_map_info);
        ASSERT_EQ(cotan_map_describe(&map, &info, text, sizeof text), COTAN_OK) << text;
        EXPECT_EQ(info.srgb, row.expectedSrgb) << row.zero << " " << row.curve;
        if (row.expectedZero >= 0) {
            EXPECT_EQ(info.zero, row.expectedZero);
        }
    }
}

// An image of 8 or 16 bits survives a file round trip, rows from the top. Invalid ones are not written.
TEST(CFiles, imagesRoundTripThroughFiles)
{
    const std::string file = testing::TempDir() + "c_files_picture.png";
    const auto throughFile = [&](auto number) {
        std::vector<decltype(number)> pixels(4 * 5 * 3);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = decltype(number)(i * 977 + 3);
        const cotan_image_view given{sizeof given, 5, 3, int(8 * sizeof number), pixels.data()};
        const cotan_status written = cotan_image_write(file.c_str(), &given, text, sizeof text);
        if (written == COTAN_UNAVAILABLE)
            return;
        ASSERT_EQ(written, COTAN_OK) << text;
        cotan_image* image = nullptr;
        ASSERT_EQ(cotan_image_read(file.c_str(), 1, &image, text, sizeof text), COTAN_OK) << text;
        cotan_image_view made = COTAN_INIT(cotan_image_view);
        ASSERT_EQ(cotan_image_pixels(image, &made, text, sizeof text), COTAN_OK) << text;
        EXPECT_EQ(made.size, sizeof made);
        EXPECT_EQ(made.width, 5);
        EXPECT_EQ(made.height, 3);
        EXPECT_EQ(made.bits, given.bits);
        EXPECT_EQ(std::memcmp(made.pixels, pixels.data(), pixels.size() * sizeof number), 0);
        cotan_image_view shorter = made;
        shorter.size -= 1;
        EXPECT_EQ(cotan_image_pixels(image, &shorter, text, sizeof text), COTAN_USAGE);
        cotan_image_free(image);
    };
    throughFile(static_cast<unsigned char>(0));
    throughFile(static_cast<unsigned short>(0));
    std::remove(file.c_str());
}

// A model is bytes, or a file or shape named by the words, never both. A caller that stops is not called again.
TEST(CFiles, renderingRefusesContradictionsAndCanBeStopped)
{
    Caller caller;
    const cotan_model_files files = caller.files();
    cotan_render_options options = COTAN_INIT(cotan_render_options);
    cotan_image* image = nullptr;
    cotan_bytes* json = nullptr;
    std::vector<const char*> words = {"--device", "reference", "--size", "8x6",       "--environment",
                                      "none",     "--frame",   "smooth", "--samples", "1"};
    const auto render = [&](bool model) {
        options.words = words.data();
        options.word_count = words.size();
        return cotan_render(model ? kModel : nullptr, model ? sizeof kModel - 1 : 0, &files, &options, &image, &json,
                            text, sizeof text);
    };
    const cotan_status status = render(true);
    if (status == COTAN_UNAVAILABLE)
        GTEST_SKIP() << text;
    ASSERT_EQ(status, COTAN_OK) << text;
    const std::string report(static_cast<const char*>(cotan_bytes_data(json)), cotan_bytes_size(json));
    for (const char* part :
         {"cotan-render-result", "\"triangles\"", "\"view\"", "shaded", "reference", "\"frame\": \"smooth\""})
        EXPECT_NE(report.find(part), std::string::npos) << part << report;
    cotan_bytes_free(json);
    cotan_image_free(image);
    image = nullptr;
    json = nullptr;
    words.insert(words.end(), {"--shape", "plane"});
    EXPECT_EQ(render(true), COTAN_USAGE);
    EXPECT_STREQ(text, "model: expected bytes or a file or a shape, found also 'plane'");
    options.threads = -1;
    EXPECT_EQ(render(false), COTAN_USAGE);
    EXPECT_STREQ(text, "options.threads: expected 0 or more");
    options.threads = 1;
    options.progress = [](void*, double) { return 1; };
    EXPECT_EQ(render(false), COTAN_STOPPED);
    EXPECT_EQ(image, nullptr);
    EXPECT_EQ(json, nullptr);
}

} // namespace
