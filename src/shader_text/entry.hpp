// What is put around the portable text: the function that a caller uses, the comment at the top, and a spatial shader
// of Godot; and what they are written with.
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

// The entry's name for a frame.
std::string entryOf(Frame frame);
// And for a choice, which may leave that one out.
std::string entryOf(const Choice& choice);

// The entry, and with screen derivatives where the choice and the language have them the short function over it.
std::string entryText(const Choice& choice, Form form);

// Whether the choice has the function that takes derivatives itself.
bool hasScreenEntry(const Choice& choice);

// The comment at the top: what it is, what it needs, how it is called, its limits, whom to thank.
std::string introduction(const Choice& choice, Form form);

inline bool hasSet(const Choice& choice, Set set) { return std::ranges::find(choice.sets, set) != choice.sets.end(); }

// ---- Godot ----------------------------------------------------------------------------------

// Whether the choice is the whole shader, not its functions alone.
bool isGodotShader(const Choice& choice);

// Errors (usage): what Godot's shaders cannot see.
Status checkGodot(const Choice& choice, Form form);

// What light() calls.
std::vector<std::string> functionsOfLight();

// The part "Needs" of the comment at the top.
std::string godotNeeds(const Choice& choice);

// The functions with what is before and after them.
std::string godotShader(const Choice& choice, const std::string& functions);

// ---- text with gaps -------------------------------------------------------------------------

// Not fmt: this part builds with a compiler and GLM.
inline std::string textOf(std::string_view text) { return std::string(text); }
inline std::string textOf(int number) { return std::to_string(number); }

// The pattern with its gaps filled: each "{}" by the next value, each "{N}" by value N below 10. "{{" and "}}" are
// braces.
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
