// Converts the normal maps of a glTF model to the frame `smooth` and drops its tangents: convert IN OUT
#include <cstdio>

#include <cotan/convert.hpp>

int main(int argc, char** argv)
{
    const char* out = argc > 2 ? argv[2] : "smooth.glb";
    auto document = cotan::openGltfDocument(argc > 1 ? argv[1] : "");
    if (!document)
        return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
    const auto done = cotan::convertModel(*document, {.frames = {cotan::Frame::mikktspace, cotan::Frame::smooth}});
    if (!done)
        return std::fprintf(stderr, "%s\n", done.error().message.c_str()), 2;
    for (const cotan::ConvertedMap& map : done->maps)
        std::printf("%s: %s\n", map.name.c_str(), map.kept ? "stays as it is" : "converted");
    if (const auto written = cotan::writeGltf(*document, out); !written)
        return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 4;
}
