// Part of the build: writes the studio's atlas to the file that builtin_environment.cpp embeds.
#include <cstdio>
#include <fstream>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "cotan/view.hpp"
#include "prefilter.hpp"

int main(int argc, char** argv)
{
    using namespace cotan;
    using namespace cotan::environment;
    if (argc != 2) {
        std::fputs("usage: cotan_store_studio FILE\n", stderr);
        return 1;
    }
    const EnvironmentMap map = makeEnvironment(*builtinRadiance("studio"), 1);
    std::vector<std::uint16_t> halfs;
    halfs.reserve(kStudioHalfs);
    for (std::size_t i = 0; i < map.atlas.pixelCount(); ++i)
        for (int c = 0; c < kChannels; ++c)
            halfs.push_back(glm::packHalf1x16(map.atlas.floats()[4 * i + std::size_t(c)]));
    std::ofstream file(argv[1], std::ios::binary);
    file.write(reinterpret_cast<const char*>(halfs.data()), std::streamsize(halfs.size() * sizeof halfs[0]));
    file.close();
    if (halfs.size() != kStudioHalfs || !file) {
        std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
        return 4;
    }
    return 0;
}
