// Models and options of cotan.h: both sides of each bound of the options of bake, lint and convert, shorter structs of
// older callers, and the images, figures and two-step conversion of a model with two maps. The caller decodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "cotan.h"

namespace {

char why[512];

void expectError(cotan_status status, const std::string& error, cotan_status expected = COTAN_USAGE)
{
    EXPECT_EQ(status, expected) << error << ": " << why;
    EXPECT_TRUE(std::string(why).starts_with(error)) << error << ": " << why;
    why[0] = '\0';
}

// A rectangle of 2 x 1 whose uv fill the unit square.
const float kPositions[] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0}, kNormals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1},
            kUvs[] = {0, 1, 1, 1, 1, 0, 0, 0};
const std::uint32_t kIndices[] = {0, 1, 2, 0, 2, 3};

cotan_mesh rectangle() { return {sizeof(cotan_mesh), 4, kPositions, kNormals, kUvs, 6, kIndices, nullptr}; }

// Two meshes of that rectangle. The map of the first is flat, that of the second tilted; the second also has a colour.
constexpr char kTwoMaps[] =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"mesh": 0}, {"mesh": 1, "translation": [0, 5, 0]}], "buffers": [{"uri": "data.bin", "byteLength": 140}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
    {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 12}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [2, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
    {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
  "images": [{"uri": "paint.png", "name": "colour"}, {"uri": "lean.png", "name": "leaning"},
             {"uri": "flat.png", "name": "even"}],
  "textures": [{"source": 0}, {"source": 1}, {"source": 2}],
  "materials": [{"normalTexture": {"index": 2}},
                {"normalTexture": {"index": 1}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
  "meshes": [
    {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]},
    {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 1}]}]})";

struct Reader {
    std::vector<unsigned char> binary = std::vector<unsigned char>(140), leaning, flat;
    std::string png = std::string("\x89PNG\r\n\x1A\n", 8);
    Reader()
    {
        const unsigned short indices[] = {0, 1, 2, 0, 2, 3};
        std::memcpy(&binary[0], kPositions, 48);
        std::memcpy(&binary[48], kNormals, 48);
        std::memcpy(&binary[96], kUvs, 32);
        std::memcpy(&binary[128], indices, 12);
        for (int i = 0; i < 8 * 8; ++i) {
            const unsigned char lean[] = {166, 153, 246, 255}, even[] = {128, 128, 255, 255};
            leaning.insert(leaning.end(), lean, lean + 4);
            flat.insert(flat.end(), even, even + 4);
        }
    }
    cotan_model_files files()
    {
        cotan_model_files f = COTAN_INIT(cotan_model_files);
        f.user = this;
        f.read = [](void* user, const char* uri, const void** bytes, std::size_t* size) {
            Reader& self = *static_cast<Reader*>(user);
            const bool data = std::strcmp(uri, "data.bin") == 0;
            *bytes = data ? static_cast<const void*>(self.binary.data()) : self.png.data();
            *size = data ? self.binary.size() : self.png.size();
            return 0;
        };
        f.decode = [](void* user, const char* name, const void*, std::size_t, cotan_image_view* picture) {
            Reader& self = *static_cast<Reader*>(user);
            const bool leans = std::strstr(name, "lean") != nullptr;
            picture->width = 8;
            picture->height = leans ? 8 : 4;
            picture->bits = 8;
            picture->pixels = leans ? self.leaning.data() : self.flat.data();
            return 0;
        };
        return f;
    }
};

std::string takeText(cotan_bytes* bytes)
{
    const std::string made(static_cast<const char*>(cotan_bytes_data(bytes)), cotan_bytes_size(bytes));
    cotan_bytes_free(bytes);
    return made;
}

// All values of the member `name` in a report, in order.
std::vector<std::string> valuesOf(const std::string& report, const std::string& name)
{
    const std::regex member("\"" + name + "\":\\s*\"?([^\",\\n}\\]]*)");
    std::vector<std::string> all;
    for (std::sregex_iterator at(report.begin(), report.end(), member), end; at != end; ++at)
        all.push_back((*at)[1]);
    return all;
}

TEST(CModels, bakeOptionsAreCheckedAgainstTheirBounds)
{
    const cotan_mesh mesh = rectangle();
    std::vector<std::uint8_t> pixels(4 * 6 * 4, 77), masked(pixels);
    cotan_image_view map = {sizeof map, 6, 4, 8, pixels.data()}, mask = {sizeof mask, 6, 4, 8, masked.data()};
    using Options = cotan_bake_options;
    const auto bake = [&](const auto& change) {
        Options o = COTAN_INIT(cotan_bake_options);
        change(o);
        return cotan_bake(&mesh, &mesh, &o, &map, nullptr, why, sizeof why);
    };
    if (bake([](Options&) {}) == COTAN_UNAVAILABLE)
        GTEST_SKIP() << why;
    std::fill(pixels.begin(), pixels.end(), 77);
    constexpr float kInf = std::numeric_limits<float>::infinity();
    for (const auto& [field, name] : {std::pair(&Options::max_distance, "max_distance"),
                                      {&Options::extrusion, "extrusion"},
                                      {&Options::cage_reach, "cage_reach"},
                                      {&Options::thickness_distance, "thickness_distance"},
                                      {&Options::curvature_radius, "curvature_radius"}})
        for (const float bad : {-0.001f, kInf, NAN})
            expectError(bake([&](Options& o) { o.*field = bad; }),
                        "options." + std::string(name) + ": expected 0 to 1e+17; found ");
    for (const auto& [field, bad, error] : {std::tuple(&Options::threads, -1, "threads: expected 0 or more"),
                                            {&Options::padding, -2, "padding: expected -1 or more"},
                                            {&Options::occlusion_rays, -1, "occlusion_rays: expected 0 to 65536"},
                                            {&Options::occlusion_rays, 65537, "occlusion_rays: expected 0 to 65536"},
                                            {&Options::material, -1, "material: expected 0 or more"},
                                            {&Options::material, 2, "material: expected 0 to 1, found 2"},
                                            {&Options::samples, 3, "samples: expected 1, 2 or 4"}})
        expectError(bake([&](Options& o) { o.*field = bad; }), "options." + std::string(error));
    for (const auto& [field, error] :
         {std::pair(&Options::kind,
                    "kind: expected normal, object-normal, height, ao, bent-normal, object-bent-normal, thickness, "
                    "curvature, position, base-color, roughness, metallic, roughness-metallic, emissive or id, found "
                    "'x'"),
          {&Options::id_by, "id_by: expected material, object or vertex-color, found 'x'"},
          {&Options::search, "search: expected first or nearest"},
          {&Options::tangents, "tangents: expected stored or generated"},
          {&Options::high_normals, "high_normals: expected smooth, curved, face or map, found 'x'"},
          {&Options::frame, "frame: expected one of cotangent, "},
          {&Options::convention, "convention: expected gltf"},
          {&Options::high_frame,
           "high_normals: expected map where a map, frame or convention is given, found 'smooth'"},
          {&Options::high_convention,
           "high_normals: expected map where a map, frame or convention is given, found 'smooth'"}})
        expectError(bake([&](Options& o) { o.*field = "x"; }), "options." + std::string(error));
    expectError(bake([](Options& o) { o.high_map_count = 1; }), "options.high_normals: expected map where");
    expectError(bake([](Options& o) { o.high_map_count = 1, o.high_normals = "map"; }),
                "options.high_maps: expected an array");
    expectError(bake([](Options& o) { o.high_normals = "map", o.high_convention = "x"; }),
                "options.high_convention: expected gltf");
    for (const auto& [width, height, bits] : {std::tuple(6, 3, 8), {5, 4, 8}, {6, 4, 16}, {4, 6, 8}})
        expectError(bake([&](Options& o) {
                        mask.width = width, mask.height = height, mask.bits = bits;
                        o.mask = &mask;
                    }),
                    "options.mask: expected 8 bits and the size of the map");
    for (const std::size_t least : {offsetof(Options, cage)}) {
        expectError(bake([&](Options& o) { o.size = least - 1; }),
                    "options.size: expected " + std::to_string(least) + " or more, found " + std::to_string(least - 1));
        EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](int x) { return x == 77; })); // untouched so far
        EXPECT_EQ(bake([&](Options& o) { o.size = least; }), COTAN_OK) << why;
    }
    EXPECT_EQ(bake([](Options& o) { o.padding = -1, o.occlusion_rays = 65536, o.material = 1, o.samples = 4; }),
              COTAN_OK)
        << why;
    EXPECT_EQ(bake([](Options& o) { o.search = "nearest", o.tangents = "generated", o.high_normals = "face"; }),
              COTAN_OK)
        << why;
    EXPECT_EQ(bake([](Options& o) { o.kind = "occlusion"; }), COTAN_OK) << why; // the name before version 9
    EXPECT_EQ(bake([](Options& o) { o.kind = "R=ao,G=height,A=0.2"; }), COTAN_OK) << why;
    EXPECT_EQ(pixels[3], 51); // 0.2
    expectError(bake([](Options& o) { o.kind = "R=normal"; }),
                "options.kind: R: expected a map of one value per texel (height, ao, ");
    expectError(bake([](Options& o) { o.kind = "base-color"; }),
                "high: expected a base colour map, a colour or vertex colours for a map of kind base-color; found none",
                COTAN_INPUT);
    cotan_bake_result result = COTAN_INIT(cotan_bake_result);
    Options curvature = COTAN_INIT(cotan_bake_options);
    curvature.kind = "curvature";
    curvature.curvature_radius = 3;
    EXPECT_EQ(cotan_bake(&mesh, &mesh, &curvature, &map, &result, why, sizeof why), COTAN_OK) << why;
    EXPECT_EQ(result.unit, 3);
    for (int axis = 0; axis < 3; ++axis) {
        float lowest = mesh.positions[axis], highest = lowest;
        for (std::size_t v = 1; v < mesh.vertex_count; ++v) {
            lowest = std::min(lowest, mesh.positions[3 * v + axis]);
            highest = std::max(highest, mesh.positions[3 * v + axis]);
        }
        EXPECT_EQ(result.box[axis], lowest);
        EXPECT_EQ(result.box[axis + 3], highest);
    }
    result.size = offsetof(cotan_bake_result, further) - 1;
    expectError(cotan_bake(&mesh, &mesh, nullptr, &map, &result, why, sizeof why), "result.size: expected ");
}

// A model of the rectangle's left and right half, which lean by 0.1 and 0.2 towards +x, and rise with x.
struct Halves {
    cotan_model* model = nullptr;
    Halves()
    {
        float positions[2][12], normals[2][12];
        cotan_mesh meshes[2];
        for (int half = 0; half < 2; ++half) {
            const float rise = half == 0 ? 0.1f : 0.2f, length = std::sqrt(1 + rise * rise);
            for (int v = 0; v < 4; ++v) {
                const float x = kPositions[3 * v] / 2 + float(half);
                const float position[] = {x, kPositions[3 * v + 1], 0.02f + rise * (x - float(half)) / 2};
                const float normal[] = {-rise / 2 / length, 0, 1 / length};
                std::copy(position, position + 3, &positions[half][3 * v]);
                std::copy(normal, normal + 3, &normals[half][3 * v]);
            }
            meshes[half] = {sizeof(cotan_mesh), 4, positions[half], normals[half], nullptr, 6, kIndices, nullptr};
        }
        const cotan_mesh* const both[] = {&meshes[0], &meshes[1]};
        const char* const names[] = {"left", "right"};
        EXPECT_EQ(cotan_model_of_meshes(2, both, names, &model, why, sizeof why), COTAN_OK) << why;
    }
    ~Halves() { cotan_model_free(model); }
};

cotan_model* modelOf(const cotan_mesh& mesh)
{
    const cotan_mesh* const meshes[] = {&mesh};
    cotan_model* model = nullptr;
    EXPECT_EQ(cotan_model_of_meshes(1, meshes, nullptr, &model, why, sizeof why), COTAN_OK) << why;
    return model;
}

// An image of 6 x 4 whose bytes are all 77.
struct Canvas {
    std::vector<unsigned char> bytes = std::vector<unsigned char>(6 * 4 * 16, 77);
    cotan_image_view view;
    explicit Canvas(int bits) : view{sizeof view, 6, 4, bits, bytes.data()} {}
};

TEST(CModels, severalMapsOfOneTraceAreAsEachAlone)
{
    const Halves high;
    cotan_model* const low = modelOf(rectangle());
    const cotan_model* const highs[] = {high.model, high.model}; // the second covers the first
    const char* const kinds[] = {"normal", "ao", "B=height,G=ao,A=0.5", "id", "curvature", "orm"};
    const std::size_t count = 5; // orm needs materials
    cotan_bake_options options = COTAN_INIT(cotan_bake_options);
    std::vector<double> shares;
    options.id_by = "object", options.samples = 1, options.curvature_radius = 3, options.threads = 1;
    options.user = &shares;
    options.progress = [](void* user, double done) {
        static_cast<std::vector<double>*>(user)->push_back(done);
        return 0;
    };
    Canvas canvases[] = {Canvas(8), Canvas(16), Canvas(8), Canvas(8), Canvas(32)};
    cotan_image_view* views[count];
    cotan_bake_result results[count];
    cotan_bake_result* wanted[count];
    for (std::size_t i = 0; i < count; ++i) {
        results[i] = COTAN_INIT(cotan_bake_result);
        views[i] = &canvases[i].view;
        wanted[i] = i == 2 ? nullptr : &results[i];
    }
    cotan_bytes *ids = nullptr, *warnings = nullptr;
    const cotan_status baked =
        cotan_bake_maps(low, 2, highs, &options, count, kinds, views, wanted, &ids, &warnings, why, sizeof why);
    if (baked == COTAN_UNAVAILABLE) {
        cotan_model_free(low);
        GTEST_SKIP() << why;
    }
    ASSERT_EQ(baked, COTAN_OK) << why;
    EXPECT_EQ(takeText(ids), "#800000 left\n#008000 right"); // labels 1 and 2 of PASCAL VOC
    EXPECT_EQ(takeText(warnings), "");
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()) && !shares.empty() && shares.back() == 1) << "once";
    EXPECT_EQ(results[0].unit, 0);
    EXPECT_EQ(results[4].unit, 3);
    std::size_t raysAlone[count] = {};
    for (std::size_t i = 0; i < count; ++i) {
        Canvas alone(canvases[i].view.bits);
        cotan_bake_result result = COTAN_INIT(cotan_bake_result);
        options.kind = kinds[i];
        ASSERT_EQ(cotan_bake_models(low, 2, highs, &options, &alone.view, &result, nullptr, why, sizeof why), COTAN_OK)
            << why;
        EXPECT_EQ(alone.bytes, canvases[i].bytes) << kinds[i];
        EXPECT_NE(alone.bytes, Canvas(8).bytes) << kinds[i];
        raysAlone[i] = result.rays;
    }
    EXPECT_EQ(results[0].rays, results[1].rays);
    EXPECT_EQ(results[0].rays, raysAlone[1]) << "as many as for occlusion alone";
    EXPECT_GT(raysAlone[0], 0u);

    // A null stands for options.kind; another size of the struct is that of an older caller.
    Canvas first(8), second(8);
    cotan_image_view* both[] = {&first.view, &second.view};
    const char* words[] = {"ao", nullptr};
    options.kind = "normal", options.progress = nullptr;
    const auto bake = [&](std::size_t maps) {
        return cotan_bake_maps(low, 2, highs, &options, maps, words, both, nullptr, nullptr, nullptr, why, sizeof why);
    };
    EXPECT_EQ(bake(2), COTAN_OK) << why;
    EXPECT_EQ(second.bytes, canvases[0].bytes);
    first = Canvas(8), second = Canvas(8);
    first.view.pixels = first.bytes.data(), second.view.pixels = second.bytes.data();
    options.progress = [](void*, double) { return 1; };
    EXPECT_EQ(bake(2), COTAN_STOPPED);
    options.progress = nullptr;
    expectError(bake(0), "map_count: expected 1 or more");
    options.kind = "x";
    expectError(bake(2), "options.kind: expected normal, ");
    words[1] = "x";
    expectError(bake(2), "kinds[1]: expected normal, object-normal, ");
    words[1] = "R=normal";
    expectError(bake(2), "kinds[1]: R: expected a map of one value per texel (");
    words[1] = "occlusion";
    expectError(bake(2), "kinds[1]: expected each map once, found 'ao' twice");
    words[1] = "orm";
    expectError(bake(2), "left: expected a map or numbers of roughness and metallic", COTAN_INPUT);
    words[1] = "normal";
    std::swap(second.view.width, second.view.height);
    expectError(bake(2), "maps[1]: expected 6 x 4 pixels as maps[0], found 4 x 6");
    second.view.bits = 7;
    expectError(bake(2), "maps[1].bits: expected 8, 16 or 32, found 7");
    both[1] = nullptr;
    expectError(bake(2), "maps[1]: expected a struct, found null");
    results[1].size = 8;
    expectError(cotan_bake_maps(low, 2, highs, nullptr, 2, words, views, wanted, nullptr, nullptr, why, sizeof why),
                "results[1].size: expected ");
    expectError(cotan_bake_maps(low, 2, highs, nullptr, 1, nullptr, both, nullptr, nullptr, nullptr, why, sizeof why),
                "kinds: expected an array, found null");
    expectError(cotan_bake_maps(low, 2, highs, nullptr, 1, words, nullptr, nullptr, nullptr, nullptr, why, sizeof why),
                "maps: expected an array, found null");
    EXPECT_EQ(first.bytes, Canvas(8).bytes) << "unwritten after errors";
    EXPECT_EQ(second.bytes, Canvas(8).bytes) << "unwritten after errors";
    cotan_model_free(low);
}

TEST(CModels, coloursOfMeshesAreIdsAndSteerRays)
{
    const float paint[2][16] = {{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1},
                                {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}};
    float moved[12];
    for (int i = 0; i < 12; ++i)
        moved[i] = kPositions[i] / (i % 3 == 0 ? 2 : 1);
    cotan_mesh left = rectangle(), whole = rectangle(), low = rectangle();
    left.positions = moved, left.colors = paint[0]; // the first of two surfaces that a ray meets counts
    whole.colors = paint[1];
    const float behind[] = {0, 0, -0.01f, 2, 0, -0.01f, 2, 1, -0.01f, 0, 1, -0.01f};
    whole.positions = behind;
    cotan_model *a = modelOf(left), *b = modelOf(whole);
    const cotan_model* const highs[] = {a, b};
    cotan_bake_options options = COTAN_INIT(cotan_bake_options);
    options.kind = "id", options.id_by = "vertex-color", options.samples = 1;
    const auto bake = [&](const cotan_mesh& simple, Canvas& canvas) {
        cotan_model* const model = modelOf(simple);
        const cotan_status done =
            cotan_bake_models(model, 2, highs, &options, &canvas.view, nullptr, nullptr, why, sizeof why);
        cotan_model_free(model);
        return done;
    };
    Canvas canvas(8);
    if (bake(low, canvas) != COTAN_UNAVAILABLE) {
        for (std::size_t x = 0; x < 6; ++x)
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(canvas.bytes[4 * x + k], k == (x < 3 ? 0u : 2u) ? 255 : 0) << x;
        options.rays = "vertex-color";
        expectError(bake(low, canvas), "options.rays: expected vertex colours in the low mesh; found none",
                    COTAN_INPUT);
        low.colors = paint[0];
        EXPECT_EQ(bake(low, canvas), COTAN_OK) << why;
        low.size = offsetof(cotan_mesh, colors); // of an older caller, whose struct ends here
        expectError(bake(low, canvas), "options.rays: expected vertex colours in the low mesh; found none",
                    COTAN_INPUT);
        float bad[16] = {};
        bad[9] = NAN;
        low = rectangle(), low.colors = bad;
        expectError(bake(low, canvas), "low: mesh 0: colour 2: expected finite numbers", COTAN_INPUT);
    }
    cotan_model_free(a);
    cotan_model_free(b);
}

TEST(CModels, trianglesOnOtherTilesThanTheBakedOneAreNamed)
{
    const Halves high;
    const float uvs[] = {0, 1, 2, 1, 2, 0, 0, 0}; // of the rectangle, on two tiles
    cotan_mesh mesh = rectangle();
    mesh.texcoords = uvs;
    cotan_model* const low = modelOf(mesh);
    Canvas canvas(8);
    const cotan_model* const highs[] = {high.model};
    for (const auto& [tile, said] :
         {std::pair(0, "options.tile: the low mesh also has triangles on tiles 1002: they are not baked"),
          {1001, ""},
          {1002, ""}}) {
        cotan_bake_options options = COTAN_INIT(cotan_bake_options);
        options.tile = tile, options.samples = 1;
        cotan_bytes* warnings = nullptr;
        const cotan_status baked =
            cotan_bake_models(low, 1, highs, &options, &canvas.view, nullptr, &warnings, why, sizeof why);
        if (baked == COTAN_UNAVAILABLE)
            break;
        ASSERT_EQ(baked, COTAN_OK) << why;
        EXPECT_EQ(takeText(warnings), said) << tile;
    }
    cotan_model_free(low);
}

TEST(CModels, lintAndConvertOptionsAreCheckedAgainstTheirBounds)
{
    Reader reader;
    const cotan_model_files files = reader.files();
    const cotan_mesh mesh = rectangle();
    const cotan_mesh* meshes[] = {&mesh};
    cotan_model* model = nullptr; // has no maps, which is fast
    ASSERT_EQ(cotan_model_of_meshes(1, meshes, nullptr, &model, why, sizeof why), COTAN_OK) << why;
    cotan_lint_result result = COTAN_INIT(cotan_lint_result);
    using Lint = cotan_lint_options;
    const auto lint = [&](const auto& change) {
        Lint o = COTAN_INIT(cotan_lint_options);
        change(o);
        return cotan_lint_model(model, &o, &result, nullptr, why, sizeof why);
    };
    if (lint([](Lint&) {}) == COTAN_UNAVAILABLE)
        GTEST_SKIP() << why;
    for (const auto& [field, bad, error] : {std::tuple(&Lint::distance, -0.1, "distance: expected 0 or more"),
                                            {&Lint::distance, double(NAN), "distance: expected 0 or more"},
                                            {&Lint::limit, -0.1, "limit: expected degrees from 0 to 180"},
                                            {&Lint::limit, 180.1, "limit: expected degrees from 0 to 180"},
                                            {&Lint::limit_area, -0.1, "limit_area: expected percent from 0 to 100"},
                                            {&Lint::limit_area, 100.1, "limit_area: expected percent from 0 to 100"}})
        expectError(lint([&](Lint& o) { o.*field = bad; }), "options." + std::string(error));
    for (const char* frame : {"unit", "", "Stored"})
        expectError(lint([&](Lint& o) { o.frame = frame; }),
                    "options.frame: expected cotangent, orthonormal, smooth, exact, triangle or stored");
    for (const char* frame : {"cotangent", "orthonormal", "smooth", "exact", "triangle", "stored"})
        EXPECT_EQ(lint([&](Lint& o) { o.frame = frame, o.limit = 180, o.limit_area = 100; }), COTAN_OK) << why;
    expectError(lint([](Lint& o) { o.size = offsetof(Lint, limit) - 1; }), "options.size");
    EXPECT_EQ(lint([](Lint& o) { o.size = offsetof(Lint, limit), o.limit = 999; }), COTAN_OK) << why; // not read
    result.size -= 1;
    expectError(lint([](Lint&) {}), "result.size");
    cotan_model_free(model);

    using Convert = cotan_convert_options;
    cotan_bytes* glb = nullptr;
    cotan_convert_result converted = COTAN_INIT(cotan_convert_result);
    const auto convert = [&](const auto& change) {
        Convert o = COTAN_INIT(cotan_convert_options);
        change(o);
        const cotan_status status =
            cotan_convert_gltf(kTwoMaps, sizeof kTwoMaps - 1, &files, &o, &converted, &glb, nullptr, why, sizeof why);
        cotan_bytes_free(glb);
        glb = nullptr;
        return status;
    };
    expectError(convert([](Convert& o) { o.threads = -1; }), "options.threads: expected 0 or more");
    expectError(convert([](Convert& o) { o.from = "x"; }), "options.from: expected one of cotangent, ");
    expectError(convert([](Convert& o) { o.to = "x"; }), "options.to: expected one of cotangent, ");
    expectError(convert([](Convert& o) { o.expansion = "x"; }), "options.expansion: expected biased or exact");
    expectError(convert([](Convert& o) { o.keep_maps = 1, o.to = "vertex"; }),
                "options.to: expected a frame without tangents for maps that are kept, found vertex");
    expectError(convert([](Convert& o) { o.keep_maps = 1, o.bits = 8; }),
                "options.bits: expected 0 where maps are kept");
    expectError(convert([](Convert& o) { o.size = offsetof(Convert, expansion) - 1; }), "options.size");
    EXPECT_EQ(convert([](Convert& o) { o.size = offsetof(Convert, expansion); }), COTAN_OK) << why;
    EXPECT_EQ(converted.maps_converted + converted.maps_kept, 2u);
    EXPECT_EQ(convert([](Convert& o) { o.keep_maps = 1; }), COTAN_OK) << why;
    EXPECT_EQ(converted.maps_kept, 2u);
    EXPECT_EQ(converted.maps_converted, 0u);
    EXPECT_EQ(converted.worst_degrees_before, converted.worst_degrees_after);
    converted.size -= 1;
    expectError(convert([](Convert&) {}), "result.size");
}

// The figures are those of the worst map, wherever it is. Frames that keep stretch see u half as steep here.
TEST(CModels, lintFiguresAreThoseOfTheReportAndTheWorstMap)
{
    Reader reader;
    const cotan_model_files files = reader.files();
    cotan_lint_result r = COTAN_INIT(cotan_lint_result);
    cotan_bytes* json = nullptr;
    const cotan_status status =
        cotan_lint_gltf(kTwoMaps, sizeof kTwoMaps - 1, &files, nullptr, &r, &json, why, sizeof why);
    if (status == COTAN_UNAVAILABLE)
        GTEST_SKIP() << why;
    ASSERT_EQ(status, COTAN_OK) << why;
    const std::string report = takeText(json);
    EXPECT_EQ(r.primitives, 2u);
    EXPECT_EQ(r.maps, 2u);
    EXPECT_EQ(r.green_against, 0u);
    EXPECT_EQ(r.distrust_stored, 0);
    const double x = 38, y = 25, z = 118, dot = x * x / 2 + y * y + z * z;
    const double angle = std::acos(dot / std::sqrt((x * x + y * y + z * z) * (x * x / 4 + y * y + z * z)));
    EXPECT_NEAR(r.cotangent_degrees, angle * 180 / std::numbers::pi, 0.01);
    EXPECT_NEAR(r.orthonormal_degrees, 0, 0.01);
    EXPECT_GT(r.smooth_degrees, 1);
    EXPECT_EQ(valuesOf(report, "advice"), std::vector<std::string>{r.advice});
    EXPECT_EQ(r.maps_to_convert, 0u); // maps stay
    EXPECT_NE(report.find(std::string(r.recommendation).substr(0, 40)), std::string::npos);
    EXPECT_NE(report.find("cotan-lint-result"), std::string::npos);
}

TEST(CModels, imagesArriveInOrderWithNamesUntilTheCallbackStops)
{
    Reader reader;
    const cotan_model_files files = reader.files();
    struct Seen {
        std::vector<std::string> names;
        std::string stopAt;
    } seen;
    const auto take = [](void* user, const char* name, const void* bytes, std::size_t size) {
        Seen& s = *static_cast<Seen*>(user);
        EXPECT_TRUE(size == 8 && std::memcmp(bytes, "\x89PNG", 4) == 0);
        s.names.emplace_back(name);
        return int(name == s.stopAt);
    };
    const auto pictures = [&](int mapsOnly, const char* stopAt = "none") {
        seen = {{}, stopAt};
        return cotan_gltf_images(kTwoMaps, sizeof kTwoMaps - 1, &files, mapsOnly, take, &seen, why, sizeof why);
    };
    if (pictures(0) == COTAN_UNAVAILABLE)
        GTEST_SKIP() << why;
    EXPECT_EQ(seen.names, (std::vector<std::string>{"colour", "leaning", "even"}));
    EXPECT_EQ(pictures(1), COTAN_OK);
    EXPECT_EQ(seen.names, (std::vector<std::string>{"leaning", "even"}));
    expectError(pictures(0, "leaning"), "stopped by the caller", COTAN_STOPPED);
    EXPECT_EQ(seen.names, (std::vector<std::string>{"colour", "leaning"}));
}

// If bits are given, both maps are written anew. Each PNG file belongs to its own image, whichever is given first.
TEST(CModels, aConversionOfTwoImagesUsesTheFileOfEach)
{
    Reader reader;
    const cotan_model_files files = reader.files();
    for (const std::size_t first : {std::size_t(0), std::size_t(1)}) {
        cotan_convert_options options = COTAN_INIT(cotan_convert_options);
        options.to = "cotangent";
        options.bits = 8;
        cotan_convert_result result = COTAN_INIT(cotan_convert_result);
        cotan_conversion* conversion = nullptr;
        const cotan_status begun =
            cotan_convert_begin(kTwoMaps, sizeof kTwoMaps - 1, &files, &options, &result, &conversion, why, sizeof why);
        if (begun == COTAN_UNAVAILABLE)
            GTEST_SKIP() << why;
        ASSERT_EQ(begun, COTAN_OK) << why;
        EXPECT_EQ(result.maps_converted, 2u);
        EXPECT_EQ(result.maps_kept, 0u);
        EXPECT_EQ(result.primitives_given, 0u);
        EXPECT_EQ(result.tangent_bytes_dropped, 0u);
        EXPECT_GT(result.worst_degrees_before, 5); // of the tilted map, not the flat one
        EXPECT_LT(result.worst_degrees_after, 0.5);
        ASSERT_EQ(cotan_conversion_count(conversion), 2u);
        cotan_image_view picture = COTAN_INIT(cotan_image_view);
        std::vector<std::string> given(2);
        const auto set = [&](std::size_t number) {
            EXPECT_EQ(cotan_conversion_image(conversion, number, &picture, why, sizeof why), COTAN_OK) << why;
            EXPECT_EQ(picture.width, 8);
            EXPECT_TRUE(picture.height == 8 || picture.height == 4);
            given[number] = reader.png + (picture.height == 8 ? "of the leaning one" : "of the flat one, longer");
            return cotan_conversion_set(conversion, number, given[number].data(), given[number].size(), why,
                                        sizeof why);
        };
        cotan_bytes *glb = nullptr, *json = nullptr;
        expectError(cotan_conversion_set(conversion, first, "", 0, why, sizeof why), "png: expected bytes, found none");
        expectError(cotan_conversion_set(conversion, first, nullptr, 1, why, sizeof why), "png: expected bytes");
        ASSERT_EQ(set(first), COTAN_OK) << why;
        expectError(set(first), "number: expected an image that has no PNG file yet");
        expectError(cotan_convert_end(conversion, &glb, nullptr, why, sizeof why),
                    "conversion: expected the PNG files of all");
        expectError(cotan_conversion_image(conversion, 2, &picture, why, sizeof why),
                    "number: expected less than 2, found 2");
        ASSERT_EQ(set(1 - first), COTAN_OK) << why;
        expectError(cotan_convert_end(conversion, nullptr, nullptr, why, sizeof why), "conversion and glb");
        ASSERT_EQ(cotan_convert_end(conversion, &glb, &json, why, sizeof why), COTAN_OK) << why;
        cotan_conversion_free(conversion);
        const std::string whole = takeText(glb), report = takeText(json);
        for (const std::string& file : given)
            EXPECT_NE(whole.find(file), std::string::npos) << file;
        EXPECT_EQ(whole.find("that cotan_conversion_set gives"), std::string::npos);
        EXPECT_EQ(valuesOf(report, "bytes_after"),
                  (std::vector<std::string>{std::to_string(given[0].size()), std::to_string(given[1].size())}));
    }
}

} // namespace
