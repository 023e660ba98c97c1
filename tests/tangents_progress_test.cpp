// Tangents and cotangents with progress, a way to stop, and the reason where there are none.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>

#include "cotan/tangents.hpp"
#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;

// flatBelow: triangles without area in uv take MikkTSpace's other way.
Arrays wavy(float flatBelow)
{
    return gridOf(400, [&](float x, float y) {
        const float u = y < flatBelow ? 0 : x;
        return Vertex{{x, -y, 0.1f * std::sin(9 * x * y)}, {0, 0, 1}, {u, y}};
    });
}

struct Heard {
    std::mutex mutex;
    std::vector<double> shares;
    std::size_t most = 1000; // then it says to stop

    cotan::Progress progress()
    {
        return [this](double share) {
            const std::lock_guard lock(mutex);
            shares.push_back(share);
            return shares.size() < most;
        };
    }
};

TEST(TangentsProgress, isTheResultWithoutItAndEndsWithTheWhole)
{
    for (const float flatBelow : {0.0f, 0.2f}) {
        const Arrays a = wavy(flatBelow);
        for (const int threads : {1, 3}) {
            Heard mikktspace, smooth;
            const auto tangents = cotan::mikktspaceTangents(a.view(), threads, mikktspace.progress());
            const auto cotangents = cotan::smoothCotangents(a.view(), threads, smooth.progress());
            ASSERT_TRUE(tangents && cotangents);
            EXPECT_EQ(*tangents, cotan::mikktspaceTangents(a.view(), threads));
            EXPECT_EQ(cotangents->u, cotan::smoothCotangents(a.view(), threads).u);
            for (const Heard* heard : {&mikktspace, &smooth}) {
                EXPECT_GE(heard->shares.size(), 4u);
                EXPECT_EQ(*std::max_element(heard->shares.begin(), heard->shares.end()), 1);
                EXPECT_LT(heard->shares.front(), 0.5);
            }
        }
    }
}

TEST(TangentsProgress, stopsAtEveryStep)
{
    for (const float flatBelow : {0.0f, 0.2f}) {
        const Arrays a = wavy(flatBelow);
        Heard whole;
        ASSERT_TRUE(cotan::mikktspaceTangents(a.view(), 1, whole.progress()));
        for (std::size_t most = 1; most <= whole.shares.size(); ++most) {
            Heard heard;
            heard.most = most;
            const auto tangents = cotan::mikktspaceTangents(a.view(), 1, heard.progress());
            ASSERT_FALSE(tangents) << most;
            EXPECT_EQ(tangents.error().kind, cotan::ErrorKind::stopped);
            EXPECT_EQ(heard.shares.size(), most);
        }
    }
    const Arrays a = wavy(0);
    for (std::size_t most = 1; most <= 3; ++most) {
        Heard heard;
        heard.most = most;
        const auto cotangents = cotan::smoothCotangents(a.view(), 1, heard.progress());
        ASSERT_FALSE(cotangents) << most;
        EXPECT_EQ(cotangents.error().kind, cotan::ErrorKind::stopped);
        EXPECT_EQ(heard.shares.size(), most);
    }
}

TEST(TangentsProgress, saysWhatIsWrongWithAMesh)
{
    const Arrays good = gridOf(1, [](float x, float y) { return Vertex{{x, -y, 0}, {0, 0, 1}, {x, y}}; });
    const auto problemOf = [&](const auto& change) {
        Arrays a = good;
        change(a);
        const auto tangents = cotan::mikktspaceTangents(a.view(), 1, {});
        const auto cotangents = cotan::smoothCotangents(a.view(), 1, {});
        EXPECT_FALSE(tangents || cotangents);
        EXPECT_TRUE(cotan::mikktspaceTangents(a.view()).empty());
        if (tangents || cotangents)
            return std::string();
        EXPECT_EQ(tangents.error().kind, cotan::ErrorKind::usage);
        EXPECT_EQ(tangents.error().message, cotangents.error().message);
        return tangents.error().message;
    };
    EXPECT_EQ(problemOf([](Arrays& a) { a.normals.pop_back(); }), "normals: expected one a position (4), found 3");
    EXPECT_EQ(problemOf([](Arrays& a) { a.texcoords.clear(); }), "texcoords: expected one a position (4), found 0");
    EXPECT_EQ(problemOf([](Arrays& a) { a.indices.pop_back(); }),
              "indices: expected three a triangle, less than 4294967295, found 5");
    EXPECT_EQ(problemOf([](Arrays& a) { a.indices[4] = 9; }), "indices[4]: expected a number below 4, found 9");
    EXPECT_TRUE(cotan::mikktspaceTangents({}, 1, {}));
    // More vertices than an index can name: refused by the sizes alone, nothing is read.
    const std::size_t most = 4294967294;
    for (const auto& [count, expected] :
         {std::pair(most + 1, "positions: expected less than 4294967295, found 4294967295"),
          {most, "normals: expected one a position (4294967294), found 4"}}) {
        cotan::MeshView mesh = good.view();
        mesh.positions = {good.positions.data(), count};
        const auto refused = cotan::mikktspaceTangents(mesh, 1, {});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().message, expected);
    }
}

} // namespace
