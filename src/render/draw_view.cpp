#include "cotan/render.hpp"

#include "cotan/view.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

Result<Image> drawView(Scene scene, const View& view, const std::string& device, int threads)
{
    const auto renderer = openRenderer(device, threads);
    if (!renderer)
        return renderer.error();
    if (const Status sound = checkScene(scene, "scene", {.finite = false, .pixels = false}); !sound)
        return sound.error();
    if (isFrame(int(view.frame))) // others are for the renderer to refuse
        deriveVertexFrames(scene, view.frame, TangentOrigin::stored);
    if (const Status loaded = (*renderer)->load(scene); !loaded)
        return loaded.error();
    return (*renderer)->draw(view);
}

} // namespace cotan
