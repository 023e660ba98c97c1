#include "compare_views.hpp"

#include <algorithm>
#include <cstdint>

#include "inspect/angles.hpp"

namespace cotan {

namespace {

constexpr std::uint8_t kOtherColor[4] = {255, 0, 255, 255};

} // namespace

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
        all_.add(d);
}

void ViewComparison::add(const Image& expected, const Image& drawn, const SeenHigh& seen)
{
    add(expected, drawn);
    ComparedView& view = result_.views.back();
    view.expected = directionsAsColor(seen.normals);
    view.others = seen.others;
    view.pixels = seen.compared;
    for (std::size_t i = 0; i < seen.other.size(); ++i)
        if (seen.other[i])
            std::copy_n(kOtherColor, 4, view.difference.bytes8() + 4 * i);
    result_.others += seen.others;
    result_.pixels += seen.compared;
}

ComparedViews ViewComparison::finish()
{
    result_.all = all_.statistics();
    return std::move(result_);
}

} // namespace cotan
