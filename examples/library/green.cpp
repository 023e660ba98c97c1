// Prints which way green of a normal map points: green FILE
#include <cstdio>

#include <cotan/image.hpp>
#include <cotan/maps.hpp>

int main(int argc, char** argv)
{
    const auto map = cotan::readImage(argc > 1 ? argv[1] : "");
    if (!map)
        return std::fprintf(stderr, "%s\n", map.error().message.c_str()), 2;
    const cotan::maps::GreenVerdict verdict = cotan::maps::greenOf(*map);
    std::printf("green points %s (%s): %s\n", name(verdict.green), name(verdict.confidence), verdict.reason.c_str());
}
