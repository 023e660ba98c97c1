// Draws the interface with Dear ImGui, between its NewFrame and Render.
#pragma once

#include <string>
#include <vector>

#include "../interface.hpp"

namespace cotan::viewer {

// Sets colours and sizes.
void setLook(bool dark, float scale);
// Sets the font for a scale and discards the previous one.
void setFont(float scale);

// Returns the chosen commands.
std::vector<std::string> drawInterface(const Interface& interface, float scale);

} // namespace cotan::viewer
