// Draws the interface with Dear ImGui, between its NewFrame and Render.
#pragma once

#include <string>
#include <vector>

#include "../interface.hpp"

namespace cotan::viewer {

// Colours and sizes.
void setLook(bool dark, float scale);
// The font for a scale; throws the one of before away.
void setFont(float scale);

// Returns the commands that were chosen.
std::vector<std::string> drawInterface(const Interface& interface, float scale);

} // namespace cotan::viewer
