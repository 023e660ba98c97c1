#include "cotan/render.hpp"

#include "cotan/view.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

Result<Image> drawView(Scene scene, const View& view, const std::string& device, int threads)
{
    const auto painter = openPainter(device, threads);
    if (!painter)
        return painter.error();
    if (const Status sound = checkScene(scene, "scene", {.finite = false, .pixels = false}); !sound)
        return sound.error();
    if (isFrame(int(view.frame))) // others are for the painter to refuse
        deriveVertexFrames(scene, view.frame, TangentOrigin::stored);
    if (const Status loaded = (*painter)->load(scene); !loaded)
        return loaded.error();
    return (*painter)->draw(view);
}

} // namespace cotan
