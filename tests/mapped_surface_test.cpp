// The mesh under a normal map: transformed values, missing values, and the values of each corner.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <tuple>

#include "cotan/tangents.hpp"
#include "judgement_cases.hpp"

namespace cotan {
namespace {

using namespace test;

TEST(MappedSurface, nonFiniteUvComponentsAreZero)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    Mesh mesh = meshOf({{{0, 0, 0}, {nan, 0.25f}}, {{1, 0, 0}, {0.5f, inf}}, {{0, 1, 0}, {-inf, -nan}}});
    const MappedSurface s = makeSurface(mesh, Texture{});
    EXPECT_EQ(s.uv(0), glm::dvec2(0, 0.25));
    EXPECT_EQ(s.uv(1), glm::dvec2(0.5, 0));
    EXPECT_EQ(s.uv(2), glm::dvec2(0, 0));
    mesh.texcoords[0][0] = {-1e29f, 1e29f}; // finite values are kept
    EXPECT_EQ(makeSurface(mesh, Texture{}).uv(0), glm::dvec2(glm::vec2(-1e29f, 1e29f)));
    mesh.texcoords[0].pop_back(); // fewer than vertices: ignored
    EXPECT_FALSE(makeSurface(mesh, Texture{}).hasUv());
    EXPECT_EQ(edgesOf(makeSurface(mesh, Texture{}), 0).uv1, glm::dvec2(0));
    EXPECT_EQ(edgesOf(makeSurface(mesh, Texture{}), 0).p2, glm::dvec3(0, 1, 0));
}

TEST(MappedSurface, tangentsAndNormalsFollowTheTransformAndMirroringFlipsW)
{
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    mesh.tangents.assign(6, glm::vec4(1, 0, 0, 1));
    mesh.normals.assign(6, glm::normalize(glm::vec3(0.5f, 0, 1)));
    const glm::dmat3 stretched({2, 0, 0}, {0, 1, 0}, {0, 0, 1}), mirrored({0, -3, 0}, {-1, 0, 0}, {0, 0, 1}),
        turned({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
    ASSERT_LT(glm::determinant(mirrored), 0);
    const double plain = makeSurface(mesh, Texture{}).stored(0).w; // w along v, which runs down: the opposite of glTF's
    EXPECT_EQ(plain, -1);
    for (const auto& [linear, direction, w] : {std::tuple(stretched, glm::dvec3(1, 0, 0), plain),
                                               {mirrored, {0, -1, 0}, -plain},
                                               {turned, {0, 1, 0}, plain}}) {
        const MappedSurface s = makeSurface(mesh, Texture{}, linear);
        for (std::size_t corner = 0; corner < 6; ++corner) {
            EXPECT_EQ(s.stored(corner), glm::dvec4(direction, w));
            EXPECT_LT(glm::length(s.position(corner) - linear * glm::dvec3(mesh.positions[corner])), 1e-12);
        }
        const glm::dvec3 n = glm::normalize(glm::inverse(glm::transpose(linear)) * glm::dvec3(mesh.normals[0]));
        EXPECT_LT(glm::length(s.normal(0) - n), 1e-6); // the normal still points outwards
    }
    const MappedSurface flat = makeSurface(mesh, Texture{}, glm::dmat3({0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
    EXPECT_EQ(flat.normal(0), glm::dvec3(0));
    EXPECT_EQ(glm::dvec3(flat.stored(0)), glm::dvec3(0));
    mesh.tangents.pop_back(); // fewer than vertices: ignored
    EXPECT_FALSE(makeSurface(mesh, Texture{}).hasStored());
    EXPECT_FALSE(MappedSurface{}.hasStored() || MappedSurface{}.hasUv());
    EXPECT_EQ(MappedSurface{}.triangleCount(), 0u);
}

// A fan around one vertex, whose corners there have about a hundred different tangents; parts of it are mirrored.
Mesh fanOfManyTangents()
{
    constexpr std::uint32_t kSides = 150;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    Mesh mesh;
    mesh.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const float a = 6.2831853f * float(i) / kSides;
        mesh.positions.push_back({std::cos(a), std::sin(a), 0.2f * unit(random)});
        mesh.indices.insert(mesh.indices.end(), {0, i + 1, (i + 1) % kSides + 1});
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        mesh.normals.push_back({0, 0, 1});
        mesh.texcoords[0].push_back({unit(random), unit(random)}); // mirrors about every second triangle
    }
    return mesh;
}

TEST(MappedSurface, eachCornerHasItsGeneratedTangent)
{
    const Mesh mesh = fanOfManyTangents();
    const MappedSurface s = makeSurface(mesh, Texture{});
    for (const FrameInfo& info : frames()) {
        if (!readsTangents(info.frame))
            continue;
        const auto expected =
            generateTangents(info.frame, {mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices});
        ASSERT_EQ(expected.size(), mesh.indices.size());
        std::size_t different = 0;
        for (std::size_t corner = 0; corner < expected.size(); ++corner) {
            const glm::dvec4 found = s.generated(info.frame, corner);
            EXPECT_LT(glm::length(glm::dvec3(found) - glm::dvec3(expected[corner])), 1e-6) << corner;
            EXPECT_EQ(found.w, -double(expected[corner].w)) << corner; // along v, the opposite of glTF's
            different += corner % 3 == 0 && expected[corner] != expected[0];
        }
        if (info.frame == Frame::mikktspace) {
            EXPECT_GT(different, 20u); // at the shared vertex
        }
    }
    const MappedSurface none = makeSurface(mesh, Texture{}, glm::dmat3(1), FrameSet());
    EXPECT_FALSE(none.hasGenerated(Frame::mikktspace));
    const f64::cotan_frame without = frameAt(none, Frame::smooth, TangentOrigin::generated, 0, {0.2, 0.3, 0.5});
    EXPECT_EQ(without.t, glm::dvec3(0));
    EXPECT_EQ(without.b, glm::dvec3(0));
}

TEST(MappedSurface, smoothCotangentsDoNotMixMirroredSides)
{
    // Mirrored and unmirrored triangles are separate; the values at each vertex are those of splitSmoothCotangents.
    const Mesh mesh = fanOfManyTangents();
    const MappedSurface s = makeSurface(mesh, Texture{});
    const SplitCotangents made = splitSmoothCotangents({mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices});
    for (std::size_t t = 0; t < mesh.triangleCount(); t += 7) {
        const glm::dvec3 weights(0.5, 0.2, 0.3);
        glm::dvec3 u(0), v(0);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t index = made.split.indices[3 * t + std::size_t(k)];
            u += weights[k] * glm::dvec3(made.cotangents.u[index]);
            v += weights[k] * glm::dvec3(made.cotangents.v[index]);
        }
        const f64::cotan_frame expected = evaluateCotangents(Frame::smooth, glm::dvec3(0, 0, 1), u, v);
        const f64::cotan_frame found = frameAt(s, Frame::smooth, TangentOrigin::generated, t, weights);
        EXPECT_LT(glm::length(found.t - expected.t), 1e-9) << t;
        EXPECT_LT(glm::length(found.b - expected.b), 1e-9) << t;
    }
}

TEST(MappedSurface, coatWithOtherUvHasNoFramesAtVertices)
{
    auto mesh = std::make_shared<Mesh>(fanOfManyTangents());
    mesh->texcoords[1] = mesh->texcoords[0];
    for (glm::vec2& uv : mesh->texcoords[1])
        uv = {2 * uv.y, uv.x};
    const Texture own, other{.image = 0, .texcoord = 1, .sampler = {}};
    const MappedSurface surface = makeSurface(mesh, own, glm::dmat3(1), kAllFrames),
                        same = makeCoatSurface(mesh, own, own, kAllFrames),
                        coat = makeCoatSurface(mesh, own, other, kAllFrames);
    const glm::dvec3 at(0.2, 0.3, 0.5);
    const auto frame = [&](const MappedSurface& s, Frame f) {
        return frameAt(s, f, TangentOrigin::generated, 4, at).t;
    };
    EXPECT_EQ(frame(same, Frame::smooth), frame(surface, Frame::smooth));
    EXPECT_EQ(frame(coat, Frame::smooth), frame(coat, Frame::cotangent));
    EXPECT_NE(frame(coat, Frame::cotangent), frame(surface, Frame::cotangent));
    EXPECT_EQ(frame(same, Frame::mikktspace), frame(surface, Frame::mikktspace));
    for (const Frame reads : {Frame::mikktspace, Frame::vertex})
        EXPECT_EQ(frame(coat, reads), frame(coat, Frame::orthonormal));
    EXPECT_NE(frame(coat, Frame::orthonormal), frame(surface, Frame::orthonormal));
    EXPECT_EQ(coat.uv(5), glm::dvec2(mesh->texcoords[1][mesh->indices[5]]));
}

TEST(MappedSurface, nonFiniteAreasAreZero)
{
    EXPECT_EQ(areaOf(surfaceOf({{{0, 0, 0}, {}}, {{3, 0, 0}, {}}, {{0, 4, 0}, {}}}), 0), 6);
    const float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(areaOf(surfaceOf({{{0, 0, 0}, {}}, {{inf, 0, 0}, {}}, {{0, 4, 0}, {}}}), 0), 0);
}

TEST(MappedSurface, orientationIsThatSeenFromTheNormals)
{
    // v runs down on the unmirrored rectangle.
    const glm::vec3 up(0, 0, 1), down(0, 0, -1);
    const auto signOf = [](std::vector<Corner> corners, std::array<glm::vec3, 3> normals) {
        for (std::size_t k = 0; k < 3; ++k)
            corners[k].normal = normals[k];
        return orientationOf(surfaceOf(corners), 0);
    };
    const auto plain = rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}), mirrored = rectangle({0, 0}, {1, 1}, {1, 0}, {0, 1}),
               line = rectangle({0, 0}, {1, 1}, {0.5f, 0}, {0.5f, 1});
    EXPECT_EQ(signOf(plain, {up, up, up}), 1);
    EXPECT_EQ(signOf(plain, {down, down, down}), -1);
    EXPECT_EQ(signOf(mirrored, {up, up, up}), -1);
    EXPECT_EQ(signOf(mirrored, {down, down, down}), 1);
    EXPECT_EQ(signOf(line, {up, up, up}), 0);
    for (std::size_t odd = 0; odd < 3; ++odd) { // two of three decide
        std::array<glm::vec3, 3> most{up, up, up}, few{down, down, down};
        most[odd] = down;
        few[odd] = up;
        EXPECT_EQ(signOf(plain, most), 1) << odd;
        EXPECT_EQ(signOf(plain, few), -1) << odd;
    }
    EXPECT_EQ(signOf(plain, {glm::vec3(0), glm::vec3(0), glm::vec3(0)}), 1); // no normals: the winding decides
    Mesh bare = meshOf(plain);
    bare.texcoords[0].clear();
    EXPECT_EQ(orientationOf(makeSurface(bare, Texture{}), 0), 0);
}

TEST(MappedSurface, bytesCountValuesAndTheLargestGenerator)
{
    const auto bytes = [](std::initializer_list<Frame> frames) {
        FrameSet set;
        for (const Frame f : frames)
            set.set(std::size_t(f));
        return surfaceBytes(1000, 300, set);
    };
    // uv: two floats per vertex; gradients of u and v: six; tangents: four.
    EXPECT_EQ(bytes({}).kept, 8000u);
    EXPECT_EQ(bytes({}).making, 0u);
    EXPECT_EQ(bytes({Frame::smooth}).kept, 8000u + 24000u);
    EXPECT_EQ(bytes({Frame::mikktspace}).kept, 8000u + 16000u);
    EXPECT_EQ(bytes({Frame::mikktspace, Frame::vertex, Frame::smooth}).kept, 8000u + 2 * 16000u + 24000u);
    EXPECT_EQ(bytes({Frame::cotangent, Frame::orthonormal}).kept, 8000u); // do not read vertex values
    // Generators run one after the other: the maximum counts.
    const std::size_t smooth = bytes({Frame::smooth}).making, tangents = bytes({Frame::mikktspace}).making;
    EXPECT_GT(smooth, 0u);
    EXPECT_GT(tangents, smooth);
    EXPECT_EQ(bytes({Frame::mikktspace, Frame::vertex, Frame::smooth}).making, tangents);
}

} // namespace
} // namespace cotan
