#include "compare.hpp"

#include "cotan/report/angles.hpp"

namespace cotan {

View normalView(const Camera& camera, Frame frame, int side)
{
    View view;
    view.width = view.height = side;
    view.camera = camera;
    view.frame = frame;
    view.output = Output::normal;
    return view;
}

void ViewComparison::add(const Image& expected, const Image& drawn)
{
    std::vector<float> degrees = interiorAngles(expected, drawn);
    if (!result_.mapped)
        degrees.assign(degrees.size(), -1.0f); // no frame has a part in these normals
    result_.views.push_back({angleStatistics(degrees), directionsAsColor(expected), directionsAsColor(drawn),
                             heatMap(degrees, drawn.width, drawn.height)});
    for (const float d : degrees)
        if (d >= 0)
            all_.push_back(d);
}

ComparedViews ViewComparison::finish()
{
    result_.all = statisticsOf(std::move(all_));
    return std::move(result_);
}

} // namespace cotan
