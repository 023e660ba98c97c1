// What the tool offers for the laboratory's commands is what the laboratory has.
#include <string>
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
    std::vector<std::string> names;
    for (const cost::Row& row : cost::rows())
        names.emplace_back(row.name);
    EXPECT_EQ(costRowNames(), names);
}
#endif

} // namespace cotan::app
