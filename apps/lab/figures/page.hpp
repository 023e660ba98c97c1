// A page of images as one HTML file, which needs no other file and no network.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace cotan {

struct PagePanel {
    std::string file;    // name of the PNG beside the page
    std::string label;   // a few words; also the alternative text of the image
    std::string caption; // one or two sentences; may be empty
    std::string png;     // the bytes of the PNG
    int width = 0;       // pixels
    int height = 0;      // pixels
};

struct PageTable {
    std::string caption;
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows; // each as long as head
};

struct PageFigure {
    std::string name; // unique in the page
    std::string title;
    std::vector<std::string> text; // paragraphs
    std::string command;           // the command line that makes the figure
    std::vector<PagePanel> panels;
    std::vector<std::pair<std::size_t, std::size_t>> sliders; // pairs of panels of one size: before, after
    std::vector<PageTable> tables;
};

struct Page {
    std::string title;
    std::vector<std::string> text;
    std::vector<PageFigure> figures;
    std::string footer;
};

// Returns the page. It contains each image once, as a data URI. A short script makes a before-and-after slider from
// pairs of images; without scripts the images are shown side by side.
std::string toHtml(const Page& page);

} // namespace cotan
