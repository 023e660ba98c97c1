// The function that a caller uses, as portable text; and the comment at the top.
#pragma once

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

// What a frame is called in function names: '-' is '_'.
std::string functionWord(Frame frame);

// The entry, and with screen derivatives where the choice and the language have them the short
// function over it.
std::string entryText(const Choice& choice, Form form);

// Whether the choice has the function that takes derivatives itself.
bool hasScreenEntry(const Choice& choice);

// The comment at the top: what it is, what it needs, how it is called, its limits, whom to thank.
std::string introduction(const Choice& choice, Form form);

} // namespace cotan::shader_text
