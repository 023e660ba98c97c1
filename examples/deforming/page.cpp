#include "page.hpp"
std::string figure(const Gpu& gpu)
{
    Measured tube(gpu, 48, 64);
    for (const Motion& motion : kMotions)
        for (const Normals normals : {Normals::carried, Normals::exact}) {
            for (int step = 0; step <= 4; ++step) {
                const Errors e = tube.at(motion, step / 4.0, normals);
                std::printf("%s %s %.2f:", motion.name, normals == Normals::carried ? "carried" : "exact", step / 4.0);
                for (std::size_t way = 0; way < kWays.size(); ++way)
                    std::printf(" %.2f", e.mean[way]);
                std::printf("\n");
            }
        }
    return "";
}
