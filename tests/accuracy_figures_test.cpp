// The committed errors in docs/accuracy.csv may only decrease.
#include <gtest/gtest.h>

#include "report/measurements.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

std::vector<Measurement> committed()
{
    const auto rows = measurementsFromCsv(test::readWhole(COTAN_SOURCE_DIR "/docs/accuracy.csv"), "docs/accuracy.csv");
    EXPECT_TRUE(rows) << rows.error().message;
    return rows ? *rows : std::vector<Measurement>{};
}

Measurement row(double mean, double invalid = 0, const char* arithmetic = "double")
{
    return {"flat", "a, \"quoted\" scene", "setting", "cotangent", "S", arithmetic, 100, mean, 2 * mean, 3 * mean,
            invalid};
}

TEST(AccuracyFigures, noCommittedFigureHasBecomeWorse)
{
    const auto before = committed();
    std::vector<Measurement> now;
    for (const AccuracyTable& table : accuracyTables()) {
        AccuracySelection selection;
        if (table.name == "curved" || table.name == "facets")
            selection.scene = "spout"; // all surfaces take minutes in unoptimised builds
        for (Measurement& m : table.measure(selection))
            now.push_back(std::move(m));
    }
    std::size_t compared = 0;
    for (const Worsening& w : worsenings(before, now, compared))
        ADD_FAILURE() << w.now.table << ", " << w.now.scene << ", " << w.now.setting << ", " << w.now.frame << ", "
                      << w.now.truth << ", " << w.now.arithmetic << ": " << w.what;
    EXPECT_EQ(compared, now.size()); // every figure is in the file
}

TEST(AccuracyFigures, csvRoundTrips)
{
    const std::vector<Measurement> rows = {row(0.4719), row(1.25e-11, 0.5, "float")};
    const auto back = measurementsFromCsv(toCsv(rows), "memory");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->size(), 2u);
    EXPECT_EQ((*back)[0].scene, rows[0].scene);
    EXPECT_EQ((*back)[0].samples, 100u);
    EXPECT_DOUBLE_EQ((*back)[0].mean, 0.4719);
    EXPECT_DOUBLE_EQ((*back)[1].mean, 1.25e-11);
    EXPECT_EQ((*back)[1].arithmetic, "float");
    EXPECT_DOUBLE_EQ((*back)[1].invalid, 0.5);
}

TEST(AccuracyFigures, brokenCsvIsReportedWithItsLine)
{
    EXPECT_FALSE(measurementsFromCsv("", "x"));
    EXPECT_FALSE(measurementsFromCsv("table,mean\n", "x"));
    const std::string good = toCsv({row(1)});
    const auto shortLine = measurementsFromCsv(good + "flat,scene\n", "x");
    ASSERT_FALSE(shortLine);
    EXPECT_EQ(shortLine.error().message, "x: line 3: expected 11 fields; found 2");
    const auto word = measurementsFromCsv(good + "a,b,c,d,e,f,1,many,0,0,0\n", "x");
    ASSERT_FALSE(word);
    EXPECT_EQ(word.error().message, "x: line 3: expected numbers in columns 7 to 11");
}

TEST(AccuracyFigures, worseMeansBeyondSamplingAndRoundingErrors)
{
    std::size_t compared = 0;
    EXPECT_TRUE(worsenings({row(1)}, {row(1.019)}, compared).empty());
    EXPECT_EQ(compared, 1u);
    EXPECT_EQ(worsenings({row(1)}, {row(1.03)}, compared).size(), 1u);
    EXPECT_TRUE(worsenings({row(1)}, {row(0.5)}, compared).empty());
    EXPECT_TRUE(worsenings({row(1e-12)}, {row(5e-10)}, compared).empty()); // below the rounding of double
    EXPECT_EQ(worsenings({row(1e-12)}, {row(5e-9)}, compared).size(), 1u);
    EXPECT_EQ(worsenings({row(1)}, {row(1, 0.01)}, compared).size(), 1u);      // a fraction of results is not finite
    EXPECT_TRUE(worsenings({row(1)}, {row(9, 0, "float")}, compared).empty()); // another figure: a different arithmetic
    EXPECT_EQ(compared, 0u);
}

TEST(AccuracyFigures, textGivesEachFrameALineAndEachSettingAColumn)
{
    Measurement a = row(1), b = row(2);
    b.setting = "other";
    const std::string text = toText({a, b});
    EXPECT_NE(text.find("| frame | setting | other |"), std::string::npos) << text;
    EXPECT_NE(text.find("| cotangent | 1 / 2 / 3 | 2 / 4 / 6 |"), std::string::npos) << text;
}

} // namespace
} // namespace cotan
