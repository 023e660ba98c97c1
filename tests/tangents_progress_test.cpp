// Progress and cancellation of tangents and cotangents, and errors for invalid meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "cotan/tangents.hpp"
#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;

// A mesh whose triangles have no area in uv where y < flatBelow; MikkTSpace treats these separately.
Arrays wavy(float flatBelow)
{
    return gridOf(400, [&](float x, float y) {
        const float u = y < flatBelow ? 0 : x;
        return Vertex{{x, -y, 0.1f * std::sin(9 * x * y)}, {0, 0, 1}, {u, y}};
    });
}

struct ProgressLog {
    std::mutex mutex;
    std::vector<double> fractions;
    std::size_t limit = 1000; // number of calls until the callback requests a stop

    cotan::Progress progress()
    {
        return [this](double fraction) {
            const std::lock_guard lock(mutex);
            fractions.push_back(fraction);
            return fractions.size() < limit;
        };
    }
};

TEST(TangentsProgress, doesNotChangeTheResultAndEndsAtOne)
{
    for (const float flatBelow : {0.0f, 0.2f}) {
        const Arrays a = wavy(flatBelow);
        for (const int threads : {1, 3}) {
            ProgressLog mikktspace, smooth;
            const auto tangents = cotan::mikktspaceTangents(a.view(), threads, mikktspace.progress());
            const auto cotangents = cotan::smoothCotangents(a.view(), threads, smooth.progress());
            ASSERT_TRUE(tangents && cotangents);
            EXPECT_EQ(*tangents, cotan::mikktspaceTangents(a.view(), threads));
            EXPECT_EQ(cotangents->u, cotan::smoothCotangents(a.view(), threads).u);
            for (const ProgressLog* log : {&mikktspace, &smooth}) {
                EXPECT_GE(log->fractions.size(), 4u);
                EXPECT_EQ(*std::max_element(log->fractions.begin(), log->fractions.end()), 1);
                EXPECT_LT(log->fractions.front(), 0.5);
            }
        }
    }
}

TEST(TangentsProgress, stopsAtEveryStep)
{
    for (const float flatBelow : {0.0f, 0.2f}) {
        const Arrays a = wavy(flatBelow);
        ProgressLog whole;
        ASSERT_TRUE(cotan::mikktspaceTangents(a.view(), 1, whole.progress()));
        for (std::size_t limit = 1; limit <= whole.fractions.size(); ++limit) {
            ProgressLog log;
            log.limit = limit;
            const auto tangents = cotan::mikktspaceTangents(a.view(), 1, log.progress());
            ASSERT_FALSE(tangents) << limit;
            EXPECT_EQ(tangents.error().kind, cotan::ErrorKind::stopped);
            EXPECT_EQ(log.fractions.size(), limit);
        }
    }
    const Arrays a = wavy(0);
    for (std::size_t limit = 1; limit <= 3; ++limit) {
        ProgressLog log;
        log.limit = limit;
        const auto cotangents = cotan::smoothCotangents(a.view(), 1, log.progress());
        ASSERT_FALSE(cotangents) << limit;
        EXPECT_EQ(cotangents.error().kind, cotan::ErrorKind::stopped);
        EXPECT_EQ(log.fractions.size(), limit);
    }
}

TEST(TangentsProgress, errorsNameTheFaultOfTheMesh)
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
    EXPECT_EQ(problemOf([](Arrays& a) { a.normals.pop_back(); }), "normals: expected one per position (4), found 3");
    EXPECT_EQ(problemOf([](Arrays& a) { a.texcoords.clear(); }), "texcoords: expected one per position (4), found 0");
    EXPECT_EQ(problemOf([](Arrays& a) { a.indices.pop_back(); }),
              "indices: expected three per triangle, less than 4294967295, found 5");
    EXPECT_EQ(problemOf([](Arrays& a) { a.indices[4] = 9; }), "indices[4]: expected a number below 4, found 9");
    EXPECT_TRUE(cotan::mikktspaceTangents({}, 1, {}));
    // More vertices than an index can address are refused by the array sizes; nothing is read.
    const std::size_t limit = 4294967294;
    for (const auto& [count, expected] :
         {std::pair(limit + 1, "positions: expected less than 4294967295, found 4294967295"),
          {limit, "normals: expected one per position (4294967294), found 4"}}) {
        cotan::MeshView mesh = good.view();
        mesh.positions = {good.positions.data(), count};
        const auto refused = cotan::mikktspaceTangents(mesh, 1, {});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().message, expected);
    }
}

} // namespace
