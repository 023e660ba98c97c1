// The figures, each made by a function that draws and measures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cotan/scene.hpp"
#include "inspect/angles.hpp"

namespace cotan::figures {

class FigureRenderer;

struct Panel {
    std::string file; // name of the PNG without the figure's name, such as "a-square"
    std::string label;
    std::string caption;
    Image image; // unorm8
};

// Statistics of a set of angles in degrees; Figure::measured says between which directions.
struct Measure {
    std::string name;
    AngleStatistics degrees;
};

// Another number; the name says what it counts.
struct Number {
    std::string name;
    double value = 0;
};

struct Figure {
    std::string title;
    std::vector<std::string> text; // description, in paragraphs
    std::vector<Panel> panels;
    std::vector<std::pair<std::size_t, std::size_t>> sliders; // pairs of panels: before, after
    std::string measured;                                     // what the angles are between
    std::vector<Measure> measures;
    std::vector<Number> numbers;
    std::pair<std::size_t, std::size_t> overview{0, 1}; // the two panels of the overview sheet
};

Figure makeTeapotFigure(FigureRenderer& studio);
Figure makePatchFigure(FigureRenderer& studio);
Figure makePlaneFigure(FigureRenderer& studio);
Figure makeMirroredFigure(FigureRenderer& studio);
Figure makeFacetingFigure(FigureRenderer& studio);
Figure makeSparkleFigure(FigureRenderer& studio);
Figure makeFlickerFigure(FigureRenderer& studio);
Figure makeParallaxFigure(FigureRenderer& studio);
Figure makeDecalFigure(FigureRenderer& studio);
Figure makeTriplanarFigure(FigureRenderer& studio);
Figure makeGroovesFigure(FigureRenderer& studio);
Figure makeIsolinesFigure(FigureRenderer& studio);

} // namespace cotan::figures
