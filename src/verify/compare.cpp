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

std::vector<float> mappedAngles(std::vector<float> degrees, bool mapped)
{
    if (!mapped)
        degrees.assign(degrees.size(), -1.0f);
    return degrees;
}

void ViewComparison::add(const Image& expected, const Image& drawn)
{
    const std::vector<float> degrees = mappedAngles(interiorAngles(expected, drawn), result_.mapped);
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
