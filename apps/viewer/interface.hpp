// What the window shows besides the image, as plain values. The window draws them without knowing their meaning;
// choices come back as the text of a command.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cotan::viewer {

struct MenuItem {
    std::string label, key; // key is the displayed shortcut; may be empty
    std::string command;    // empty: a separator
    bool on = false;        // ticked
    bool usable = true;
    std::string submenu{}; // adjacent items with the same name share a submenu; empty: in the menu itself
};

struct Menu {
    std::string title;
    std::vector<MenuItem> items;
};

struct Slider {
    std::string label, command; // the value is appended to the command
    std::string unit;
    double value = 0, low = 0, high = 1;
    bool logarithmic = false;
};

struct Line2D { // in pixels of the image
    glm::vec2 from, to;
    glm::vec3 color{1, 1, 1};
    std::string label; // at its end
};

struct Choice { // an entry of a list
    std::string text, command;
};

struct Interface {
    bool shown = true; // menus and panels
    bool dark = true;  // colour scheme
    float scale = 0;   // of the text; 0: the scale of the screen
    bool cheatSheet = false;
    std::vector<Menu> menus;
    std::vector<Slider> sliders;
    bool slidersShown = false;
    std::string status;            // one line at the bottom: the model, the device, degrees
    std::string problem;           // one line, shown until something else happens
    float progress = -1;           // of loading, 0 to 1; negative: nothing is loading
    std::string doing;             // what is loading
    std::vector<std::string> card; // lines about the surface under the pointer
    glm::vec2 cardAt{0, 0};
    std::vector<Line2D> lines;
    float divider = -1; // pixels from the left; negative: none
    std::string leftName, rightName;
    std::vector<std::pair<double, glm::vec3>> scaleBar;    // degrees and their colours
    std::vector<std::pair<std::string, glm::vec3>> legend; // of other colours
    bool resultShown = false;                              // of a task
    std::string resultTitle;
    std::vector<std::string> resultLines;
    bool problemAreasShown = false;
    std::vector<Choice> problemAreas;
    std::vector<std::pair<std::string, std::string>> sheet; // key, and action with its value; titles have no key
};

} // namespace cotan::viewer
