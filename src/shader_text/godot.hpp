// What stands around the functions in a spatial shader of Godot.
#pragma once

#include "cotan/shader_text.hpp"

namespace cotan::shader_text {

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

} // namespace cotan::shader_text
