// Which detailed meshes belong to which simple mesh: the rule of every program that bakes by name.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bake/name_pairs.hpp"

namespace cotan {
namespace {

using Names = std::vector<std::string>;

// For each simple mesh the detailed ones that it sees, as "name < detail detail".
Names seen(const Names& low, const Names& high)
{
    const NamePairs pairs = pairNames(low, high);
    Names lines;
    for (std::size_t i = 0; i < low.size(); ++i) {
        lines.push_back(low[i] + " <");
        for (std::size_t k = 0; k < high.size() && pairs.low[i] >= 0; ++k)
            if (pairs.high[k] == pairs.low[i])
                lines.back() += " " + high[k];
    }
    return lines;
}

TEST(NamePairs, numbersOfBlenderPairMeshesOfOneName)
{
    const Names expected{"wall_low < wall_high", "wall_low.001 < wall_high.001", "wall_low.012 < wall_high.012"};
    EXPECT_EQ(seen({"wall_low", "wall_low.001", "wall_low.012"}, {"wall_high.012", "wall_high", "wall_high.001"}),
              expected);
    // The number may stand before the word on either side.
    EXPECT_EQ(seen({"wall_low", "wall.001_low"}, {"wall_high", "wall.001_high"}),
              (Names{"wall_low < wall_high", "wall.001_low < wall.001_high"}));
    EXPECT_EQ(seen({"wall_low", "wall_low.001"}, {"wall.001_high", "wall_high"}),
              (Names{"wall_low < wall_high", "wall_low.001 < wall.001_high"}));
    EXPECT_TRUE(pairNames({"wall_low", "wall_low.001"}, {"wall_high.001", "wall_high"}).notes.empty());
}

TEST(NamePairs, severalDetailedMeshesBelongToOneSimpleMesh)
{
    EXPECT_EQ(seen({"vent_low", "plate_low"}, {"vent_high_slats", "plate_high", "vent_high", "vent_high.001"}),
              (Names{"vent_low < vent_high_slats vent_high vent_high.001", "plate_low < plate_high"}));
    // An ending goes to the simple mesh that has it, and "a1" is not the ending "a" with more behind it.
    EXPECT_EQ(seen({"w_low", "w_low_a"}, {"w_high", "w_high_a", "w_high_a_bolt", "w_high_a1", "w_high_b"}),
              (Names{"w_low < w_high w_high_a1 w_high_b", "w_low_a < w_high_a w_high_a_bolt"}));
    EXPECT_TRUE(pairNames({"vent_low"}, {"vent_high_slats", "vent_high"}).notes.empty());
}

TEST(NamePairs, wordsAreFoundInAnyCaseBetweenSeparatorsAndAtCapitals)
{
    for (const auto& [low, high] : {std::pair("door_low", "door_high"),
                                    {"Door_LOW", "dOOR_High"},
                                    {"door.lo", "door-hi"},
                                    {"door lp", "door_hp"},
                                    {"doorLow", "DoorHigh"},
                                    {"door_lowpoly", "door_HighPoly"},
                                    {"low_door", "high_door"},
                                    {"door2low", "door2high"},
                                    {"door_low1", "door_high1"},
                                    {"pillow_low", "pillow_high"},
                                    {"yellow_flower_low", "yellow_flower_high"},
                                    {"highway_low", "highway_high"},
                                    {"high_rise_low", "high_rise_high"},
                                    {"door", "door_high"},
                                    {"door", "door"},
                                    {"t\xC3\xBCr_low", "t\xC3\xBCr_high"},
                                    {"low", "high"},
                                    {"", ""}})
        EXPECT_EQ(seen({low}, {high}), Names{std::string(low) + " < " + high}) << low;
    for (const auto& [low, high] : {std::pair("pillow", "pil_high"), // no word in it
                                    {"door_low", "doors_high"},
                                    {"door_low", "door_frame_high"},
                                    {"door_slow", "door_high"}})
        EXPECT_EQ(seen({low}, {high}), Names{std::string(low) + " <"}) << low;
}

TEST(NamePairs, rolesAreTheLastWord)
{
    EXPECT_EQ(roleOfName("door_low"), NameRole::low);
    EXPECT_EQ(roleOfName("LP-door.003"), NameRole::low);
    EXPECT_EQ(roleOfName("tower_high_rise_lo"), NameRole::low);
    EXPECT_EQ(roleOfName("doorHiBolts"), NameRole::high);
    EXPECT_EQ(roleOfName("door.Cage"), NameRole::cage);
    for (const char* none : {"", "pillow", "shigh", "highway", "lowe", "Cube.001", "._-"})
        EXPECT_EQ(roleOfName(none), NameRole::none) << none;
}

TEST(NamePairs, whatTheNamesLeaveOpenIsSaidOrRefused)
{
    // One detailed mesh for two simple ones is used for both, with a note.
    EXPECT_EQ(seen({"wall_low", "wall_low.001"}, {"wall_high"}),
              (Names{"wall_low < wall_high", "wall_low.001 < wall_high"}));
    EXPECT_EQ(pairNames({"wall_low", "wall_low.001"}, {"wall_high"}).notes,
              Names{"no high mesh is named for 'wall_low.001' alone: those of similar names are used"});
    EXPECT_EQ(seen({"wall_low.001"}, {"wall_high.002"}), Names{"wall_low.001 < wall_high.002"});
    EXPECT_EQ(pairNames({"wall_low.001"}, {"wall_high.002"}).notes.size(), 1u);
    // Of two, neither is chosen.
    EXPECT_EQ(seen({"wall_low", "wall_low.001", "wall_low.002"}, {"wall_high", "wall_high.001"}).back(),
              "wall_low.002 <");
    // Names that differ only in case.
    EXPECT_EQ(seen({"Wall_low", "wall_low"}, {"wall_high"}), (Names{"Wall_low < wall_high", "wall_low < wall_high"}));
    EXPECT_EQ(pairNames({"Wall_low", "wall_low"}, {"wall_high"}).notes,
              Names{"no high mesh is named for 'wall_low' alone: those of similar names are used"});
    // Detail that belongs to no simple mesh, named at most three times.
    EXPECT_EQ(pairNames({"a_low"}, {"a_high", "b_high", "c", "d_high", "e_high", "b_high"}).notes,
              Names{"no low mesh has the name of 'b_high', 'c', 'd_high' and 1 more: not baked"});
    EXPECT_EQ(pairNames({"a_low.001"}, {"a_high.001", "a_high.002"}).notes,
              Names{"no low mesh has the name of 'a_high.002': not baked"});
    // Of one file that has all meshes, simple ones and cages are no detail.
    const Names all{"a_low", "a_high", "a_cage"};
    EXPECT_EQ(seen({"a_low"}, all), Names{"a_low < a_high"});
    EXPECT_TRUE(pairNames({"a_low"}, all).notes.empty());
}

TEST(NamePairs, onlyNamesThatLeaveNothingOpenSuggestToPair)
{
    EXPECT_EQ(pairNames({"a_low", "b_low"}, {"b_high", "a_high"}).example, "'a_low' with 'a_high'");
    EXPECT_EQ(pairNames({"a_low"}, {"a_high"}).example, "") << "nothing to keep apart";
    EXPECT_EQ(pairNames({"a_low", "b_low"}, {"a_high"}).example, "");
    EXPECT_EQ(pairNames({"a_low", "b_low"}, {"a_high", "b_high", "c_high"}).example, "");
    EXPECT_EQ(pairNames({"a", "b"}, {"a", "b"}).example, "");
    EXPECT_EQ(pairNames({"a_low", "a_low"}, {"a_high"}).example, "");
}

TEST(NamePairs, thousandsOfNamesTakeNoTime)
{
    Names low, high;
    for (int i = 0; i < 20000; ++i) {
        low.push_back("part" + std::to_string(i) + "_low");
        high.push_back("part" + std::to_string(i) + "_high" + std::string(50, '_'));
    }
    const NamePairs pairs = pairNames(low, high);
    EXPECT_EQ(pairs.low, pairs.high);
}

} // namespace
} // namespace cotan
