// The model formats: one table for the loader, the viewer, batch, bake and the help.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/named_values.hpp"
#include "files/bytes.hpp"

namespace cotan {

struct ModelFormat {
    std::string_view name;   // in the help
    std::string_view ending; // in lower case
    bool assimp = false;     // read by Assimp
    bool upUnknown = false;  // files have z up as often as y, and do not say which
};

inline constexpr ModelFormat kModelFormats[] = {
    {"glTF", ".gltf"},           {"GLB", ".glb"},           {"OBJ", ".obj"},       {"PLY", ".ply", true, true},
    {"STL", ".stl", true, true}, {"COLLADA", ".dae", true}, {"FBX", ".fbx", true}, {"3DS", ".3ds", true}};

// Null if the file's ending is none of these.
inline const ModelFormat* modelFormatOf(const std::filesystem::path& file)
{
    const auto found = std::ranges::find(kModelFormats, lowerExtension(file), &ModelFormat::ending);
    return found == std::end(kModelFormats) ? nullptr : found;
}

// "glTF, GLB, ... or 3DS"; with `endings`: ".gltf, .glb, ... or .3ds".
inline std::string modelFormats(bool endings = false)
{
    std::vector<std::string> words;
    for (const ModelFormat& format : kModelFormats)
        words.emplace_back(endings ? format.ending : format.name);
    return eitherOf(words);
}

} // namespace cotan
