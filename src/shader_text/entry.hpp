// The text around the portable text: the function that callers use, the introductory comment, and a spatial shader for
// Godot; and the string formatting for these.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/shader_text.hpp"

namespace cotan::shader_text {

inline constexpr const char* kEntry = "cotan_perturb_normal_from_differences";
inline constexpr const char* kEdgeEntry = "cotan_perturb_normal_from_edges";
inline constexpr const char* kVertexEntry = "cotan_perturb_normal_from_vertices";
inline constexpr const char* kTangentEntry = "cotan_perturb_normal_from_gltf_tangent";
inline constexpr const char* kScreenEntry = "cotan_perturb_normal";

// Returns the name of the entry function for a frame.
std::string entryOf(Frame frame);
// Returns the name of the entry function for a choice; some choices replace the entry of the frame.
std::string entryOf(const Choice& choice);

// Returns the entry function and, if the choice and the language have screen derivatives, the short function that calls
// it.
std::string entryText(const Choice& choice, Form form);

// Whether the text includes the function that takes derivatives itself.
bool hasScreenEntry(const Choice& choice);

// Whether the text, for Godot, includes a function that draws meshes without the vertex data of the frame with another
// frame, from screen derivatives; and that frame: `orthonormal` reads maps for tangents, `cotangent` those for the
// others.
bool hasSubstitute(const Choice& choice, Form form);
Frame substituteOf(Frame frame);

// Returns the introductory comment: what the text is, what it needs, how to call it, its limits, and credits.
std::string introduction(const Choice& choice, Form form);

inline bool hasSet(const Choice& choice, Set set) { return std::ranges::find(choice.sets, set) != choice.sets.end(); }

// ---- Godot ----------------------------------------------------------------------------------

// Whether the choice is a whole shader, not only its functions.
bool isGodotShader(const Choice& choice);

// Errors (usage): features that are impossible in Godot's shaders.
Status checkGodot(const Choice& choice, Form form);

// Returns the functions that light() calls.
std::vector<std::string> functionsOfLight();

// Returns the part "Needs" of the introductory comment.
std::string godotNeeds(const Choice& choice, Form form);

// Returns the whole shader around the functions.
std::string godotShader(const Choice& choice, const std::string& functions);

// ---- text with placeholders -----------------------------------------------------------------

// Used instead of fmt, because this part is built with only a compiler and GLM.
inline std::string textOf(std::string_view text) { return std::string(text); }
inline std::string textOf(int number) { return std::to_string(number); }

// Returns the pattern with its placeholders replaced: each "{}" by the next value, each "{N}" by value N below 10. "{{"
// and "}}" give braces.
template<class... Values> std::string fill(std::string_view pattern, const Values&... values)
{
    const std::vector<std::string> texts{textOf(values)...};
    std::string filled;
    std::size_t next = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char c = pattern[i], after = i + 1 < pattern.size() ? pattern[i + 1] : '\0';
        if (c == '{' && after == '}') {
            filled += texts.at(next++);
            ++i;
        } else if (c == '{' && after >= '0' && after <= '9') {
            filled += texts.at(std::size_t(after - '0'));
            i += 2;
        } else {
            filled += c;
            i += (c == '{' || c == '}') && after == c;
        }
    }
    return filled;
}

} // namespace cotan::shader_text
