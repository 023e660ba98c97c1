// Draws a model, or the built-in scene, on the processor, without a stored tangent: draw [MODEL] PICTURE
#include <cstdio>

#include <cotan/image.hpp>
#include <cotan/model.hpp>
#include <cotan/render.hpp>
#include <cotan/scene.hpp>

int main(int argc, char** argv)
{
    using namespace cotan;
    const auto scene = argc > 2 ? loadScene(argv[1]) : Result<Scene>(builtinScene());
    if (!scene)
        return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 2;
    View view;
    view.width = 320;
    view.height = 240;
    view.camera = frontCamera(*scene, view.width, view.height);
    view.lights = defaultLights();
    const auto picture = renderReference(*scene, view);
    const auto written = picture ? writeImage(argv[argc - 1], *picture) : Status(picture.error());
    if (!written)
        return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 4;
}
