// Fields of reports that have new names. Their old names stay beside them, with equal values, in version 0.3 only; then
// this file is deleted.
#pragma once

#include <string_view>

#include "files/json.hpp"

namespace cotan {

struct RenamedField {
    std::string_view name, old;
};

constexpr RenamedField kRenamedFields[] = {
    {"fraction", "share"}, // in problem_areas, so before it
    {"problem_areas", "hot_spots"},
    {"fraction_over_1_degree", "share_over_1_degree"},
    {"fraction_over_5_degrees", "share_over_5_degrees"},
    {"residual_fraction", "residual_share"},
    {"rotated", "turned"},
    {"reversed", "turned"},
    {"rotated_degrees", "turned_degrees"},
    {"texels_overlapped", "texels_in_several_places"},
    {"length_deviation", "length_spread"},
    {"image_files", "pictures"},
    {"images_drawn", "pictures"},
    {"first_image", "first_picture"},
};

inline void addOldFields(Json& json)
{
    if (!json.is_structured())
        return;
    for (Json& member : json)
        addOldFields(member);
    if (json.is_object())
        for (const RenamedField& field : kRenamedFields)
            if (const auto found = json.find(field.name); found != json.end()) {
                Json value = *found; // adding a member moves the others
                json[std::string(field.old)] = std::move(value);
            }
}

} // namespace cotan
