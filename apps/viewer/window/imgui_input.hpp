// Keys and the pointer for Dear ImGui: as events from 1.89 on, as plain states in older versions.
#pragma once

#include <array>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <glm/vec2.hpp>

namespace cotan::viewer {

#if IMGUI_VERSION_NUM >= 18900
// Returns ImGuiKey_None for keys that the interface does not use.
inline ImGuiKey imGuiKeyOf(int glfwKey)
{
    if (glfwKey >= GLFW_KEY_A && glfwKey <= GLFW_KEY_Z)
        return ImGuiKey(ImGuiKey_A + (glfwKey - GLFW_KEY_A));
    if (glfwKey >= GLFW_KEY_0 && glfwKey <= GLFW_KEY_9)
        return ImGuiKey(ImGuiKey_0 + (glfwKey - GLFW_KEY_0));
    switch (glfwKey) {
    case GLFW_KEY_TAB: return ImGuiKey_Tab;
    case GLFW_KEY_LEFT: return ImGuiKey_LeftArrow;
    case GLFW_KEY_RIGHT: return ImGuiKey_RightArrow;
    case GLFW_KEY_UP: return ImGuiKey_UpArrow;
    case GLFW_KEY_DOWN: return ImGuiKey_DownArrow;
    case GLFW_KEY_PAGE_UP: return ImGuiKey_PageUp;
    case GLFW_KEY_PAGE_DOWN: return ImGuiKey_PageDown;
    case GLFW_KEY_HOME: return ImGuiKey_Home;
    case GLFW_KEY_END: return ImGuiKey_End;
    case GLFW_KEY_INSERT: return ImGuiKey_Insert;
    case GLFW_KEY_DELETE: return ImGuiKey_Delete;
    case GLFW_KEY_BACKSPACE: return ImGuiKey_Backspace;
    case GLFW_KEY_SPACE: return ImGuiKey_Space;
    case GLFW_KEY_ENTER: return ImGuiKey_Enter;
    case GLFW_KEY_KP_ENTER: return ImGuiKey_KeypadEnter;
    case GLFW_KEY_ESCAPE: return ImGuiKey_Escape;
    default: return ImGuiKey_None;
    }
}
#endif

// Reports a pressed or released key, by its GLFW number, with the modifiers held.
inline void tellImGuiKey(int glfwKey, bool down, bool ctrl, bool shift, bool alt)
{
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
    io.ConfigInputTrickleEventQueue = false; // a frame handles all earlier events
    io.AddKeyEvent(ImGuiMod_Ctrl, ctrl);
    io.AddKeyEvent(ImGuiMod_Shift, shift);
    io.AddKeyEvent(ImGuiMod_Alt, alt);
    if (const ImGuiKey key = imGuiKeyOf(glfwKey); key != ImGuiKey_None)
        io.AddKeyEvent(key, down);
#else
    if (glfwKey >= 0 && glfwKey < IM_ARRAYSIZE(io.KeysDown))
        io.KeysDown[glfwKey] = down;
    io.KeyCtrl = ctrl;
    io.KeyShift = shift;
    io.KeyAlt = alt;
#endif
}

// Reports the pointer position in pixels, the buttons that are down, and the wheel motion since the last frame. Call it
// after the backend's NewFrame, which sets its own pointer.
inline void tellImGuiPointer(glm::vec2 position, const std::array<bool, 3>& buttons, glm::vec2 wheel)
{
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
    io.ConfigInputTrickleEventQueue = false;
    io.AddMousePosEvent(position.x, position.y);
    for (int i = 0; i < int(buttons.size()); ++i)
        io.AddMouseButtonEvent(i, buttons[std::size_t(i)]);
    io.AddMouseWheelEvent(wheel.x, wheel.y);
#else
    io.MousePos = {position.x, position.y};
    for (std::size_t i = 0; i < buttons.size(); ++i)
        io.MouseDown[i] = buttons[i];
    io.MouseWheelH = wheel.x;
    io.MouseWheel = wheel.y;
#endif
}

} // namespace cotan::viewer
