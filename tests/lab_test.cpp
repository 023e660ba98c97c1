// The options that the tool offers for the laboratory's commands match the laboratory's tables.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "figures/figures.hpp"
#include "lab_options.hpp"
#include "truth/measurement.hpp"
#ifdef COTAN_WITH_VULKAN
#include "cost/rows.hpp"
#endif

namespace cotan::app {

TEST(LabOptions, offerTheTablesOfTheLab)
{
    std::vector<std::string> names;
    for (const AccuracyTable& table : accuracyTables())
        names.emplace_back(table.name);
    names.emplace_back("rendered"); // drawn, not computed
    EXPECT_EQ(accuracyTableNames(), names);
}

TEST(LabOptions, offerTheFiguresOfTheLab)
{
    const auto figures = figures::figureNames();
    EXPECT_EQ(figureOptionNames(), std::vector<std::string>(figures.begin(), figures.end()));
}

#ifdef COTAN_WITH_VULKAN
TEST(LabOptions, offerTheRowsOfTheLab)
{
    std::set<std::string_view> names;
    for (const cost::Row& row : cost::rows())
        names.insert(row.name);
    const std::vector<std::string> offered = costRowNames();
    EXPECT_EQ(std::set<std::string_view>(offered.begin(), offered.end()), names);
    EXPECT_EQ(offered.size(), names.size());
}
#endif

} // namespace cotan::app
