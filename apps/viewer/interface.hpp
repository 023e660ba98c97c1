// What the window shows beside the picture, as plain values: the window draws them, and knows nothing of what they
// mean. What is chosen in it comes back as the text of a command.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cotan::viewer {

struct MenuItem {
    std::string label, key; // the key that does the same, for people; may be empty
    std::string command;    // empty: a line between others
    bool on = false;        // has a tick
    bool usable = true;
    std::string submenu{}; // items beside each other with the same one stand in it; empty: in the menu itself
};

struct Menu {
    std::string title;
    std::vector<MenuItem> items;
};

struct Slider {
    std::string label, command; // with the value behind it
    std::string unit;
    double value = 0, low = 0, high = 1;
    bool logarithmic = false;
};

struct Line2D { // on the picture, pixels
    glm::vec2 from, to;
    glm::vec3 color{1, 1, 1};
    std::string label; // at its end
};

struct Choice { // of a list
    std::string text, command;
};

struct Interface {
    bool shown = true; // menus and panels
    bool dark = true;  // its look
    float scale = 0;   // of its text; 0: as the screen asks for
    bool cheatSheet = false;
    std::vector<Menu> menus;
    std::vector<Slider> sliders;
    bool slidersShown = false;
    std::string status;            // one line at the bottom: the model, the device, degrees
    std::string problem;           // one line that stays until something else happens
    float progress = -1;           // of loading, 0 to 1; below 0: nothing is loading
    std::string doing;             // what is loading
    std::vector<std::string> card; // what is under the pointer, line by line
    glm::vec2 cardAt{0, 0};
    std::vector<Line2D> lines;
    float divider = -1; // pixels from the left; below 0: none
    std::string leftName, rightName;
    std::vector<std::pair<double, glm::vec3>> scaleBar; // degrees and their colours
    bool problemAreasShown = false;
    std::vector<Choice> problemAreas;
    std::vector<std::pair<std::string, std::string>> sheet; // key, what it does and how it stands; a title without key
};

} // namespace cotan::viewer
