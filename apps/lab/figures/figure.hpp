// The figures: each a function that draws and measures, in a table by name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cotan/scene.hpp"
#include "inspect/angles.hpp"

namespace cotan::figures {

class FigureRenderer;

struct Panel {
    std::string file; // the PNG's name without the figure's, as in "a-square"
    std::string label;
    std::string caption;
    Image image; // unorm8
};

// A set of angles, in degrees. What they are between is said once in the figure.
struct Measure {
    std::string name;
    AngleStatistics degrees;
};

// Another number, whose name says what it counts.
struct Number {
    std::string name;
    double value = 0;
};

struct Figure {
    std::string title;
    std::vector<std::string> text; // what it shows, in paragraphs
    std::vector<Panel> panels;
    std::vector<std::pair<std::size_t, std::size_t>> sliders; // panels: before, after
    std::string measured;                                     // what the angles are between
    std::vector<Measure> measures;
    std::vector<Number> numbers;
    std::pair<std::size_t, std::size_t> overview{0, 1}; // the two panels that stand for it
};

Figure makeTeapotFigure(FigureRenderer& studio);
Figure makePatchFigure(FigureRenderer& studio);
Figure makePlaneFigure(FigureRenderer& studio);
Figure makeTutorialFigure(FigureRenderer& studio);
Figure makeNormalMatrixFigure(FigureRenderer& studio);
Figure makeMirroredFigure(FigureRenderer& studio);
Figure makeTargetsFigure(FigureRenderer& studio);
Figure makeDecodeFigure(FigureRenderer& studio);
Figure makeFacetingFigure(FigureRenderer& studio);
Figure makeFurnaceFigure(FigureRenderer& studio);
Figure makeSparkleFigure(FigureRenderer& studio);

} // namespace cotan::figures
