// Which detailed meshes belong to which simple mesh, by their names, for every program that bakes.
//
// A name is a base, a word and an ending: "door_low", "Door.HIGH.001", "doorHigh_bolts", "lp-door". The words are low,
// lo, lp, lowpoly, high, hi, hp, highpoly and cage in any case, between separators, digits or a change from lower to
// upper case; the last one counts. A detailed mesh belongs to the simple mesh of the same base with
// - the same number of Blender (".001", which may also stand before the word), or else without number;
// - of these, the longest ending that begins its own: "door_high_bolts" belongs to "door_low" if there is no
//   "door_low_bolts".
// A name without a word is a base. Detailed meshes without the word high do not count where others of their base have
// it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cotan {

enum class NameRole { none, low, high, cage };

// What the name says that the mesh is.
NameRole roleOfName(std::string_view name);

struct NamePairs {
    // A group for each name: a simple mesh sees the detailed meshes of its group. -1: the mesh has no counterpart.
    std::vector<std::int64_t> low, high;
    // One line each: simple meshes that share detail, detailed meshes without a simple one.
    std::vector<std::string> notes;
    std::string
        example; // "'door_low' with 'door_high'", if the words say so of two pairs or more, and no note is needed
};

// Pairs the names. A simple mesh that no detailed one fits gets the detail of its base, with a note, if that belongs to
// one other mesh at most.
NamePairs pairNames(const std::vector<std::string>& low, const std::vector<std::string>& high);

} // namespace cotan
