// What functions of cotan.h refuse, one argument at a time: each pointer that may not be null, each struct that is a
// byte too short, each number beyond its bound. The message names the argument, and nothing is written.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "cotan.h"

namespace {

char refusal[512];

// Expects that the call was refused with a message that names the argument.
void expectRefused(cotan_status status, const std::string& named, cotan_status expected = COTAN_USAGE)
{
    EXPECT_EQ(status, expected) << named << ": " << refusal;
    EXPECT_NE(std::string(refusal).find(named), std::string::npos) << named << ": " << refusal;
    refusal[0] = '\0';
}

// A square of two triangles.
struct Square {
    std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::vector<float> texcoords{0, 1, 1, 1, 1, 0, 0, 0};
    std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    cotan_mesh mesh() const
    {
        return {sizeof(cotan_mesh), 4, positions.data(), normals.data(), texcoords.data(), 6, indices.data(), nullptr};
    }
};

struct Pixels {
    std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(4 * 4 * 2, 128);
    cotan_image_view view{sizeof(cotan_image_view), 4, 2, 8, bytes.data()};
};

int takeLevel(void*, int, const cotan_image_view*, const cotan_image_view*) { return 0; }

TEST(CRefusals, framesRequireAllTheirArrays)
{
    const float n[3] = {0, 0, 1}, p[3] = {1, 0, 0}, q[3] = {0, 1, 0}, u[2] = {1, 0}, v[2] = {0, 1};
    float out[3] = {77, 77, 77};
    const cotan_surface_points good = {sizeof good, 1, n, p, q, u, v};
    using Call = cotan_status (*)(const char*, const cotan_surface_points*, const float*, float*, char*, std::size_t);
    for (const Call call : {&cotan_frame_apply, &cotan_frame_encode}) {
        ASSERT_EQ(call("cotangent", &good, n, out, refusal, sizeof refusal), COTAN_OK) << refusal;
        out[0] = 77;
        expectRefused(call(nullptr, &good, n, out, refusal, sizeof refusal), "frame");
        expectRefused(call("cotangent", nullptr, n, out, refusal, sizeof refusal), "points");
        expectRefused(call("cotangent", &good, nullptr, out, refusal, sizeof refusal), "texels and normals");
        expectRefused(call("cotangent", &good, n, nullptr, refusal, sizeof refusal), "texels and normals");
        for (const auto member :
             {&cotan_surface_points::normals, &cotan_surface_points::dpdx, &cotan_surface_points::dpdy,
              &cotan_surface_points::duvdx, &cotan_surface_points::duvdy}) {
            cotan_surface_points points = good;
            points.*member = nullptr;
            expectRefused(call("cotangent", &points, n, out, refusal, sizeof refusal), "points: expected five arrays");
        }
        cotan_surface_points points = good;
        points.size = sizeof points - 1;
        expectRefused(call("cotangent", &points, n, out, refusal, sizeof refusal), "points.size");
        for (const char* frame : {"mikktspace", "vertex", "smooth", "nothing"})
            expectRefused(call(frame, &good, n, out, refusal, sizeof refusal), "frame");
        EXPECT_EQ(out[0], 77);
    }
}

TEST(CRefusals, vertexFramesRequireTheArraysTheyRead)
{
    const float n[3] = {0, 0, 1}, t[4] = {1, 0, 0, 1}, u[3] = {1, 0, 0}, v[3] = {0, 1, 0};
    float out[3];
    const cotan_interpolated_points good = {sizeof good, 1, n, t, u, v};
    using Call =
        cotan_status (*)(const char*, const cotan_interpolated_points*, const float*, float*, char*, std::size_t);
    for (const Call call : {&cotan_vertex_frame_apply, &cotan_vertex_frame_encode}) {
        expectRefused(call("smooth", &good, nullptr, out, refusal, sizeof refusal), "texels and normals");
        expectRefused(call("smooth", &good, n, nullptr, refusal, sizeof refusal), "texels and normals");
        expectRefused(call("smooth", nullptr, n, out, refusal, sizeof refusal), "points");
        expectRefused(call("cotangent", &good, n, out, refusal, sizeof refusal), "frame");
        for (const char* frame : {"mikktspace", "vertex", "smooth"}) {
            const bool smooth = frame == std::string("smooth");
            ASSERT_EQ(call(frame, &good, n, out, refusal, sizeof refusal), COTAN_OK) << refusal;
            for (const auto member :
                 {&cotan_interpolated_points::normals, &cotan_interpolated_points::tangents,
                  &cotan_interpolated_points::cotangents_u, &cotan_interpolated_points::cotangents_v}) {
                cotan_interpolated_points points = good;
                points.*member = nullptr;
                const bool reads = member == &cotan_interpolated_points::normals
                    || (member == &cotan_interpolated_points::tangents) == !smooth;
                if (reads)
                    expectRefused(call(frame, &points, n, out, refusal, sizeof refusal), "points: expected normals");
                else
                    EXPECT_EQ(call(frame, &points, n, out, refusal, sizeof refusal), COTAN_OK) << refusal;
            }
        }
    }
}

TEST(CRefusals, meshFunctionsRequireTheArraysTheyRead)
{
    const Square square;
    const cotan_mesh good = square.mesh();
    std::vector<float> t(24, 77), u(18, 77), v(18, 77);
    std::array<std::uint32_t, 16> indices{}, sources{};
    std::size_t count = 0;
    const std::vector<std::function<cotan_status(const cotan_mesh*)>> calls = {
        [&](const cotan_mesh* m) { return cotan_tangents("mikktspace", m, 1, t.data(), refusal, sizeof refusal); },
        [&](const cotan_mesh* m) { return cotan_smooth_cotangents(m, u.data(), v.data(), refusal, sizeof refusal); },
        [&](const cotan_mesh* m) { return cotan_triangle_vectors(m, 1, u.data(), v.data(), refusal, sizeof refusal); },
        [&](const cotan_mesh* m) {
            return cotan_split_mirrored(m, indices.data(), sources.data(), &count, refusal, sizeof refusal);
        }};
    for (const auto& call : calls) {
        ASSERT_EQ(call(&good), COTAN_OK) << refusal;
        expectRefused(call(nullptr), "mesh");
        for (const auto member : {&cotan_mesh::positions, &cotan_mesh::normals, &cotan_mesh::texcoords}) {
            cotan_mesh mesh = good;
            mesh.*member = nullptr;
            expectRefused(call(&mesh), "mesh: expected positions, normals and texcoords");
        }
        cotan_mesh mesh = good;
        mesh.indices = nullptr;
        expectRefused(call(&mesh), "mesh.indices: expected an array");
        mesh.index_count = 0;
        EXPECT_EQ(call(&mesh), COTAN_OK) << refusal;
        mesh = good;
        mesh.size = offsetof(cotan_mesh, colors); // that of older callers
        EXPECT_EQ(call(&mesh), COTAN_OK) << refusal;
        mesh.size -= 1;
        expectRefused(call(&mesh), "mesh.size");
        for (const std::size_t wrong : {4u, 5u}) {
            mesh = good;
            mesh.index_count = wrong;
            expectRefused(call(&mesh), "mesh.index_count");
        }
        Square high;
        high.indices[0] = 4;
        mesh = high.mesh();
        expectRefused(call(&mesh), "mesh.indices[0]: expected less than 4, found 4", COTAN_INPUT);
        high = Square();
        high.indices[5] = 5;
        mesh = high.mesh();
        expectRefused(call(&mesh), "mesh.indices[5]: expected less than 4, found 5", COTAN_INPUT);
        const std::vector<std::pair<std::vector<float> Square::*, std::string>> arrays = {
            {&Square::positions, "mesh.positions[3]"},
            {&Square::normals, "mesh.normals[3]"},
            {&Square::texcoords, "mesh.texcoords[3]"}};
        for (const auto& [array, named] : arrays)
            for (const auto& [number, written] : {std::pair(std::numeric_limits<float>::infinity(), "found inf"),
                                                  {-std::numeric_limits<float>::infinity(), "found -inf"},
                                                  {std::numeric_limits<float>::quiet_NaN(), "found nan"}}) {
                Square bad;
                (bad.*array).back() = number;
                mesh = bad.mesh();
                expectRefused(call(&mesh), named + ": expected finite numbers, " + written, COTAN_INPUT);
            }
    }
    expectRefused(cotan_tangents(nullptr, &good, 1, t.data(), refusal, sizeof refusal), "kind");
    expectRefused(cotan_tangents("vertex", &good, -1, t.data(), refusal, sizeof refusal), "threads");
    EXPECT_EQ(cotan_tangents("vertex", &good, 0, t.data(), refusal, sizeof refusal), COTAN_OK);
    expectRefused(cotan_tangents("vertex", &good, 1, nullptr, refusal, sizeof refusal), "tangents");
    expectRefused(cotan_smooth_cotangents(&good, nullptr, v.data(), refusal, sizeof refusal), "u and v");
    expectRefused(cotan_smooth_cotangents(&good, u.data(), nullptr, refusal, sizeof refusal), "u and v");
    expectRefused(cotan_triangle_vectors(&good, 1, nullptr, v.data(), refusal, sizeof refusal), "u and v");
    expectRefused(cotan_triangle_vectors(&good, 1, u.data(), nullptr, refusal, sizeof refusal), "u and v");
    expectRefused(cotan_triangle_vectors(&good, -1, u.data(), v.data(), refusal, sizeof refusal), "threads");
}

TEST(CRefusals, packingRequiresEachArrayUnlessTheCountIsZero)
{
    const float three[3] = {0, 0, 1}, four[4] = {1, 0, 0, 1};
    std::array<std::uint32_t, 3> words{};
    std::array<std::int16_t, 4> shorts{};
    std::uint16_t packed = 0;
    const auto each = [&](auto call, auto first, auto second, auto third, auto out) {
        ASSERT_EQ(call(first, second, third, out), COTAN_OK) << refusal;
        EXPECT_EQ(call(nullptr, second, third, out), COTAN_USAGE);
        EXPECT_EQ(call(first, nullptr, third, out), COTAN_USAGE);
        EXPECT_EQ(call(first, second, nullptr, out), COTAN_USAGE);
        EXPECT_EQ(call(first, second, third, nullptr), COTAN_USAGE);
    };
    each([&](const float* n, const float* u, const float* v,
             std::int16_t* o) { return cotan_pack_smooth8(1, n, u, v, o, refusal, sizeof refusal); },
         three, three, three, shorts.data());
    each([&](const float* n, const float* u, const float* v,
             std::uint32_t* o) { return cotan_pack_smooth4(1, n, u, v, o, refusal, sizeof refusal); },
         three, three, three, words.data());
    EXPECT_EQ(cotan_pack_triangles(1, nullptr, three, words.data(), refusal, sizeof refusal), COTAN_USAGE);
    EXPECT_EQ(cotan_pack_triangles(1, three, nullptr, words.data(), refusal, sizeof refusal), COTAN_USAGE);
    EXPECT_EQ(cotan_pack_triangles(1, three, three, nullptr, refusal, sizeof refusal), COTAN_USAGE);
    EXPECT_EQ(cotan_pack_tangents(1, nullptr, four, &packed, refusal, sizeof refusal), COTAN_USAGE);
    EXPECT_EQ(cotan_pack_tangents(1, three, nullptr, &packed, refusal, sizeof refusal), COTAN_USAGE);
    EXPECT_EQ(cotan_pack_tangents(1, three, four, nullptr, refusal, sizeof refusal), COTAN_USAGE);
    EXPECT_EQ(cotan_pack_tangents(1, three, four, &packed, refusal, sizeof refusal), COTAN_OK);
}

TEST(CRefusals, vertexCopiesRequireBuffersAndACount)
{
    const Square square;
    const cotan_mesh mesh = square.mesh();
    const std::vector<float> corners(4 * 6, 1);
    std::array<std::uint32_t, 6> indices{}, sources{}, provoking{};
    std::size_t count = 77;
    const auto vertices = [&](const float* read, std::uint32_t* a, std::uint32_t* b, std::size_t* c) {
        return cotan_split_vertices(4, 6, square.indices.data(), read, a, b, c, refusal, sizeof refusal);
    };
    const auto mirrored = [&](std::uint32_t* a, std::uint32_t* b, std::size_t* c) {
        return cotan_split_mirrored(&mesh, a, b, c, refusal, sizeof refusal);
    };
    const auto provoked = [&](std::uint32_t* a, std::uint32_t* b, std::size_t* c, std::uint32_t* d) {
        return cotan_provoking(4, 6, square.indices.data(), 0, a, b, c, d, refusal, sizeof refusal);
    };
    expectRefused(vertices(nullptr, indices.data(), sources.data(), &count), "corners");
    expectRefused(vertices(corners.data(), nullptr, sources.data(), &count), "split_indices");
    expectRefused(vertices(corners.data(), indices.data(), nullptr, &count), "sources");
    expectRefused(vertices(corners.data(), indices.data(), sources.data(), nullptr), "split_count");
    expectRefused(mirrored(nullptr, sources.data(), &count), "split_indices");
    expectRefused(mirrored(indices.data(), nullptr, &count), "sources");
    expectRefused(mirrored(indices.data(), sources.data(), nullptr), "split_count");
    expectRefused(provoked(nullptr, sources.data(), &count, provoking.data()), "made_indices");
    expectRefused(provoked(indices.data(), nullptr, &count, provoking.data()), "sources");
    expectRefused(provoked(indices.data(), sources.data(), nullptr, provoking.data()), "made_count");
    expectRefused(provoked(indices.data(), sources.data(), &count, nullptr), "corners");
    EXPECT_EQ(count, 77u);
    EXPECT_EQ(vertices(corners.data(), indices.data(), sources.data(), &count), COTAN_OK) << refusal;
    EXPECT_EQ(mirrored(indices.data(), sources.data(), &count), COTAN_OK) << refusal;
    EXPECT_EQ(provoked(indices.data(), sources.data(), &count, provoking.data()), COTAN_OK) << refusal;
}

TEST(CRefusals, mapFunctionsRequireTheirImagesAndNames)
{
    Pixels map, out, other;
    using P = cotan_image_view*;
    cotan_green green = {};
    green.size = sizeof green;
    cotan_map_info info = {};
    info.size = sizeof info;
    std::vector<float> heights(8);
    // Each of these functions reads the image.
    const std::vector<std::pair<std::string, std::function<cotan_status(P)>>> readers = {
        {"map", [&](P p) { return cotan_map_green(p, &green, refusal, sizeof refusal); }},
        {"map", [&](P p) { return cotan_map_describe(p, &info, refusal, sizeof refusal); }},
        {"map", [&](P p) { return cotan_map_convert(p, "gltf", "gltf", &out.view, refusal, sizeof refusal); }},
        {"height", [&](P p) { return cotan_map_from_height(p, 1, 1, "gltf", &out.view, refusal, sizeof refusal); }},
        {"map", [&](P p) { return cotan_map_to_height(p, "gltf", heights.data(), refusal, sizeof refusal); }},
        {"base",
         [&](P p) { return cotan_map_blend(p, &other.view, "gltf", "udn", 1, &out.view, refusal, sizeof refusal); }},
        {"detail",
         [&](P p) { return cotan_map_blend(&other.view, p, "gltf", "udn", 1, &out.view, refusal, sizeof refusal); }},
        {"map", [&](P p) { return cotan_map_mips(p, "gltf", 0.5, takeLevel, nullptr, refusal, sizeof refusal); }}};
    for (const auto& [named, call] : readers) {
        ASSERT_EQ(call(&map.view), COTAN_OK) << named << refusal;
        expectRefused(call(nullptr), named);
        Pixels wrong;
        wrong.view.pixels = nullptr;
        expectRefused(call(&wrong.view), named);
        wrong = Pixels();
        wrong.view.size -= 1;
        expectRefused(call(&wrong.view), named + ".size");
        for (const int side : {0, 65537}) {
            wrong = Pixels();
            wrong.view.width = side;
            expectRefused(call(&wrong.view), named);
            wrong = Pixels();
            wrong.view.height = side;
            expectRefused(call(&wrong.view), named);
        }
    }
    expectRefused(cotan_map_green(&map.view, nullptr, refusal, sizeof refusal), "green");
    green.size -= 1;
    expectRefused(cotan_map_green(&map.view, &green, refusal, sizeof refusal), "green.size");
    expectRefused(cotan_map_describe(&map.view, nullptr, refusal, sizeof refusal), "info");
    P to = &out.view;
    expectRefused(cotan_map_convert(&map.view, nullptr, "gltf", to, refusal, sizeof refusal), "from");
    expectRefused(cotan_map_convert(&map.view, "gltf", nullptr, to, refusal, sizeof refusal), "to");
    expectRefused(cotan_map_convert(&map.view, "gltf", "gltf", nullptr, refusal, sizeof refusal), "to_map");
    expectRefused(cotan_map_convert(&map.view, "gltf", "object", to, refusal, sizeof refusal), "to");
    expectRefused(cotan_map_convert(&map.view, "gltf", "gltf,signed", to, refusal, sizeof refusal), "to");
    constexpr double kInf = std::numeric_limits<double>::infinity();
    expectRefused(cotan_map_from_height(&map.view, kInf, 1, "gltf", to, refusal, sizeof refusal), "scale_x");
    expectRefused(cotan_map_from_height(&map.view, 1, kInf, "gltf", to, refusal, sizeof refusal), "scale_y");
    expectRefused(cotan_map_from_height(&map.view, 1, 1, nullptr, to, refusal, sizeof refusal), "to");
    expectRefused(cotan_map_from_height(&map.view, 1, 1, "gltf,signed", to, refusal, sizeof refusal), "to");
    expectRefused(cotan_map_from_height(&map.view, 1, 1, "gltf", nullptr, refusal, sizeof refusal), "map");
    expectRefused(cotan_map_to_height(&map.view, nullptr, heights.data(), refusal, sizeof refusal), "from");
    expectRefused(cotan_map_to_height(&map.view, "gltf", nullptr, refusal, sizeof refusal), "heights");
    const auto blend = [&](const char* convention, const char* mode, double strength, P target) {
        return cotan_map_blend(&map.view, &other.view, convention, mode, strength, target, refusal, sizeof refusal);
    };
    expectRefused(blend(nullptr, "udn", 1, to), "convention");
    expectRefused(blend("gltf,signed", "udn", 1, to), "convention");
    expectRefused(blend("gltf", nullptr, 1, to), "mode");
    expectRefused(blend("gltf", "multiply", 1, to), "mode");
    expectRefused(blend("gltf", "udn", kInf, to), "strength");
    expectRefused(blend("gltf", "udn", 1, nullptr), "map");
    for (const char* mode : {"reoriented", "whiteout", "udn", "slopes", "linear"})
        EXPECT_EQ(blend("gltf", mode, 1, to), COTAN_OK) << refusal;
    const auto mips = [&](const char* convention, double roughness, cotan_take_level take) {
        return cotan_map_mips(&map.view, convention, roughness, take, nullptr, refusal, sizeof refusal);
    };
    expectRefused(mips(nullptr, 0.5, takeLevel), "convention");
    expectRefused(mips("gltf", -0.001, takeLevel), "roughness");
    expectRefused(mips("gltf", 1.001, takeLevel), "roughness");
    expectRefused(mips("gltf", 0.5, nullptr), "take");
    EXPECT_EQ(mips("gltf", 0, takeLevel), COTAN_OK) << refusal;
    EXPECT_EQ(mips("gltf", 1, takeLevel), COTAN_OK) << refusal;
}

TEST(CRefusals, modelAndConversionFunctionsRequireTheirPointers)
{
    const Square square;
    const cotan_mesh mesh = square.mesh();
    const cotan_mesh* meshes[] = {&mesh};
    cotan_model* model = nullptr;
    expectRefused(cotan_model_of_meshes(1, nullptr, nullptr, &model, refusal, sizeof refusal), "meshes");
    expectRefused(cotan_model_of_meshes(1, meshes, nullptr, nullptr, refusal, sizeof refusal), "model");
    const cotan_mesh* none[] = {nullptr};
    expectRefused(cotan_model_of_meshes(1, none, nullptr, &model, refusal, sizeof refusal), "meshes[0]");
    EXPECT_EQ(model, nullptr);
    ASSERT_EQ(cotan_model_of_meshes(1, meshes, nullptr, &model, refusal, sizeof refusal), COTAN_OK) << refusal;
    expectRefused(cotan_model_up(nullptr, "y", refusal, sizeof refusal), "model");
    expectRefused(cotan_model_up(model, nullptr, refusal, sizeof refusal), "up");
    expectRefused(cotan_model_up(model, "x", refusal, sizeof refusal), "up: expected y or z, found 'x'");
    expectRefused(cotan_lint_model(nullptr, nullptr, nullptr, nullptr, refusal, sizeof refusal), "model");
    EXPECT_STREQ(cotan_model_warnings(model), "");
    cotan_model_free(model);
    cotan_model_free(nullptr);
    expectRefused(cotan_model_open(nullptr, 0, 0, &model, refusal, sizeof refusal), "file");
    expectRefused(cotan_model_open("x.glb", 0, 0, nullptr, refusal, sizeof refusal), "model");
    expectRefused(cotan_model_open("x.glb", 0, -1, &model, refusal, sizeof refusal), "memory");
    cotan_image* image = nullptr;
    expectRefused(cotan_image_read(nullptr, 0, &image, refusal, sizeof refusal), "file");
    expectRefused(cotan_image_read("x.png", 0, nullptr, refusal, sizeof refusal), "image");
    expectRefused(cotan_image_read("x.png", -1, &image, refusal, sizeof refusal), "memory");
    Pixels pixels;
    expectRefused(cotan_image_write(nullptr, &pixels.view, refusal, sizeof refusal), "file");
    expectRefused(cotan_image_write("x.png", nullptr, refusal, sizeof refusal), "image");
    expectRefused(cotan_image_pixels(nullptr, &pixels.view, refusal, sizeof refusal), "image");
    cotan_bytes* glb = nullptr;
    cotan_conversion* conversion = nullptr;
    const auto take = [](void*, const char*, const void*, std::size_t) { return 0; };
    expectRefused(cotan_gltf_images(nullptr, 1, nullptr, 0, take, nullptr, refusal, sizeof refusal), "model");
    expectRefused(cotan_gltf_images("{}", 2, nullptr, 0, nullptr, nullptr, refusal, sizeof refusal), "take");
    expectRefused(cotan_lint_gltf(nullptr, 1, nullptr, nullptr, nullptr, nullptr, refusal, sizeof refusal), "model");
    expectRefused(cotan_convert_gltf(nullptr, 1, nullptr, nullptr, nullptr, &glb, nullptr, refusal, sizeof refusal),
                  "model");
    expectRefused(cotan_convert_gltf("{}", 2, nullptr, nullptr, nullptr, nullptr, nullptr, refusal, sizeof refusal),
                  "glb");
    expectRefused(cotan_convert_begin("{}", 2, nullptr, nullptr, nullptr, nullptr, refusal, sizeof refusal),
                  "conversion");
    expectRefused(cotan_conversion_image(nullptr, 0, &pixels.view, refusal, sizeof refusal), "conversion");
    expectRefused(cotan_conversion_set(nullptr, 0, "", 0, refusal, sizeof refusal), "conversion");
    expectRefused(cotan_convert_end(nullptr, &glb, nullptr, refusal, sizeof refusal), "conversion");
    EXPECT_EQ(cotan_conversion_count(nullptr), 0u);
    cotan_conversion_free(nullptr);
    cotan_image_free(nullptr);
    cotan_bytes_free(nullptr);
    EXPECT_EQ(conversion, nullptr);
    EXPECT_EQ(glb, nullptr);
}

// Messages name a mesh without a name by its number.
TEST(CRefusals, messagesNameMeshesByNameOrNumber)
{
    const Square square;
    const cotan_mesh good = square.mesh();
    cotan_mesh bad = good;
    bad.index_count = 5;
    const cotan_mesh* meshes[] = {&good, &bad};
    cotan_model* model = nullptr;
    for (const char* name : {"lid", "", static_cast<const char*>(nullptr)}) {
        const char* names[] = {"box", name};
        expectRefused(cotan_model_of_meshes(2, meshes, names, &model, refusal, sizeof refusal),
                      std::string(name && *name ? name : "meshes[1]") + ".index_count: expected a multiple of 3");
    }
    expectRefused(cotan_model_of_meshes(2, meshes, nullptr, &model, refusal, sizeof refusal), "meshes[1].index_count");
    bad = good;
    bad.positions = nullptr;
    expectRefused(cotan_model_of_meshes(2, meshes, nullptr, &model, refusal, sizeof refusal),
                  "meshes[1]: expected positions, found null");
    EXPECT_EQ(model, nullptr);
    bad.vertex_count = bad.index_count = 0; // then no array is read
    EXPECT_EQ(cotan_model_of_meshes(2, meshes, nullptr, &model, refusal, sizeof refusal), COTAN_OK) << refusal;
    cotan_model_free(model);
    EXPECT_EQ(cotan_bytes_data(nullptr), nullptr);
    EXPECT_EQ(cotan_bytes_size(nullptr), 0u);
    EXPECT_STREQ(cotan_model_warnings(nullptr), "");
}

TEST(CRefusals, shaderTextIsOfTheRequestedStage)
{
    const auto text = [](const char* frame) {
        std::size_t size = 0;
        EXPECT_EQ(cotan_shader_text("glsl", frame, "gltf", nullptr, &size, refusal, sizeof refusal), COTAN_OK)
            << refusal;
        std::string made(size, '\0');
        EXPECT_EQ(cotan_shader_text("glsl", frame, "gltf", made.data(), &size, refusal, sizeof refusal), COTAN_OK)
            << refusal;
        return made;
    };
    EXPECT_NE(text("triangle,vertex"), text("triangle,fragment"));
    EXPECT_NE(text("triangle,vertex"), text("triangle"));
    std::size_t size = 0;
    const auto errorOf = [&](const char* language, const char* frame, const char* convention) {
        return cotan_shader_text(language, frame, convention, nullptr, &size, refusal, sizeof refusal);
    };
    expectRefused(errorOf("glsl", "triangle,pixel", "gltf"),
                  "stage: expected fragment, vertex, mesh or compute, found 'pixel'");
    expectRefused(errorOf("glsl", "triangle,", "gltf"), "stage: expected fragment, vertex, mesh or compute, found ''");
    expectRefused(errorOf("glsl", "tangent,vertex", "gltf"), "frame: expected a frame, found 'tangent'");
    expectRefused(errorOf("basic", "triangle", "gltf"), "language: expected ");
    expectRefused(errorOf("glsl", "triangle", "x"), "convention: ");
    expectRefused(errorOf(nullptr, "triangle", "gltf"), "language: expected a name, found null");
    expectRefused(errorOf("glsl", nullptr, "gltf"),
                  "frame: expected orthonormal for maps that were baked for MikkTSpace");
    expectRefused(errorOf("glsl", "triangle", nullptr), "convention: expected a name, found null");
    expectRefused(cotan_shader_text("glsl", "triangle", "gltf", nullptr, nullptr, refusal, sizeof refusal),
                  "text_size: expected a pointer");
    EXPECT_EQ(size, 0u);
}

} // namespace
