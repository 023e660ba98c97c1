// Render targets whose rows run up or down, and the sign that the frame of 2013 leaves out.
#include <fmt/format.h>

#include "figure.hpp"
#include "stage.hpp"
#include "truth.hpp"

namespace cotan::figures {

Figure makeTargetsFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Targets with y up and y down";
    figure.text = {
        "The same scene drawn into a target whose rows run down (Vulkan, Direct3D) and into one whose rows run up "
        "(OpenGL); the images are shown upright. The cotangent frame as printed in 2013 reverses t and b with "
        "the sign of the y derivative: right on one kind of target, and on the other every bump is a dent. The frame "
        "cotangent carries the sign of n . (dpdx x dpdy) and is the same on both."};
    figure.measured = "Angles to the normals from whole triangles (frame exact) on the same target.";
    Scene scene = builtinScene();
    for (Material& material : scene.materials) {
        material.metallic = 0; // reflections make bumps and dents hard to tell apart
        material.baseColor *= glm::vec4(0.6f, 0.6f, 0.6f, 1);
    }
    studio.show(scene);
    scene.cameras[0].verticalFieldOfView *= 1.25f; // the built-in camera is for wider images
    View view = wideView(studio, scene.cameras[0]);
    view.lights = scene.lights;
    view.shading = Shading::pbr;
    view.shadows = true;
    for (Frame frame : {Frame::cotangent2013, Frame::cotangent})
        for (bool up : {false, true}) {
            view.rowsUpward = up;
            const std::string rows = up ? "up" : "down";
            figure.panels.push_back({fmt::format("{}-y-{}", name(frame), rows),
                                     fmt::format("{}, y {}", name(frame), rows), "", studio.shaded(view, frame)});
            figure.measures.push_back(
                {fmt::format("{}, y {}", name(frame), rows),
                 compareNormals(studio.normals(view, frame), studio.normals(view, Frame::exact)).degrees});
        }
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
        addError(figure, i, figure.panels[i].label);
    figure.sliders = {{0, 1}, {2, 3}};
    return figure;
}

} // namespace cotan::figures
