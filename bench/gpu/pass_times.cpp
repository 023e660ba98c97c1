#include "pass_times.hpp"

#include "motion.hpp"
#include "passes.hpp"

namespace cotan::bench {

std::vector<PassTimes> timePasses(std::uint32_t around, std::uint32_t along, int repeats, std::string& device)
{
    const Gpu gpu = openGpu();
    device = gpu.physical.getProperties().deviceName.data();
    const ::Mesh rest = tube(around, along);
    Passes passes(gpu, rest, makeAdjacency(viewOf(rest)), makeNormalAdjacency(viewOf(rest)));
    const ::Mesh pose = posed(rest, kMotions[0], 1, Normals::exact);
    passes.pose(pose.positions, pose.normals);
    constexpr Pass kPasses[] = {Pass::triangles, Pass::smooth, Pass::tangents, Pass::normals};
    std::vector<PassTimes> times = {
        {"triangles.comp", "U and V of `triangle`, six halfs: at load, or for each pose", {}},
        {"smooth.comp", "t and b of `smooth`, 8 bytes per vertex", {}},
        {"tangents.comp", "orthonormal tangents, 8 bytes per vertex", {}},
        {"normals.comp", "unit normals", {}}};
    const double millions = double(rest.indices.size() / 3) * 1e-6;
    for (int repeat = -1; repeat < repeats; ++repeat) // the first is a warm-up
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double milliseconds = passes.run(kPasses[i]);
            if (repeat >= 0)
                times[i].nanoseconds.push_back(milliseconds * 1e6 / millions);
        }
    return times;
}

} // namespace cotan::bench
