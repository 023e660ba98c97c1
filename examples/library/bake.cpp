// Bakes a normal map of a detailed model for a simple one, to be read without tangents: bake LOW HIGH PICTURE
#include <cstdio>

#include <cotan/bake.hpp>
#include <cotan/image.hpp>
#include <cotan/model.hpp>

int main(int argc, char** argv)
{
    using namespace cotan;
    auto low = loadScene(argc > 1 ? argv[1] : ""), high = loadScene(argc > 2 ? argv[2] : "");
    if (!low || !high)
        return std::fprintf(stderr, "%s\n", (low ? high : low).error().message.c_str()), 2;
    BakeModelOptions options;
    options.bake.frame = Frame::cotangent;
    options.bake.width = options.bake.height = 256;
    const auto baked = bakeModel(*low, {.scenes = {*std::move(high)}, .maps = {}}, options);
    const auto written =
        baked ? writeImage(argc > 3 ? argv[3] : "map.png", baked->maps[0].image) : Status(baked.error());
    if (!written)
        return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 2;
}
