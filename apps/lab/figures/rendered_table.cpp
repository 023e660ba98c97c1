#include "figures/rendered_table.hpp"

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/view.hpp"
#include "truth/painted.hpp"
#include "truth/patch.hpp"

namespace cotan::figures {

namespace {

constexpr int kSide = 384; // image side in pixels

// A surface and its tessellations: flat patches of two cells, curved surfaces in three densities.
struct Subject {
    Surface surface;
    std::vector<int> segments;
};

std::vector<Subject> subjects(const AccuracySelection& selection)
{
    std::vector<Subject> list;
    for (const Layout& layout : kLayouts)
        list.push_back({patchSurface(layout), {2}});
    for (const Surface& surface : surfaces())
        list.push_back({surface, {16, 32, 64}});
    std::erase_if(list, [&](const Subject& s) { return !selection.wantsScene(s.surface.name); });
    return list;
}

// Frames drawn with one upload of the scene. `vertex` and `mikktspace` use the same attribute, so they are in different
// groups; `gradient` needs another strength of the map.
using FrameGroup = std::vector<Frame>;

std::vector<FrameGroup> frameGroups(const AccuracySelection& selection)
{
    FrameGroup others, vertex, gradient;
    for (const FrameInfo& f : frames())
        if (selection.wants(f.frame))
            (f.frame == Frame::vertex ? vertex : f.frame == Frame::gradient ? gradient : others).push_back(f.frame);
    std::vector<FrameGroup> groups;
    for (FrameGroup* group : {&others, &vertex, &gradient})
        if (!group->empty())
            groups.push_back(std::move(*group));
    return groups;
}

// Angles of one frame over all cameras.
Result<Measurement> drawn(Renderer& renderer, const PaintedScene& painted, Frame frame, Measurement names)
{
    AngleCollector angles;
    for (const Camera& camera : painted.cameras) {
        View view;
        view.width = view.height = kSide;
        view.camera = camera;
        view.frame = frame;
        view.output = Output::normal;
        const auto normals = renderer.draw(view);
        view.output = Output::uv;
        const auto uv = renderer.draw(view);
        if (!normals)
            return normals.error();
        if (!uv)
            return uv.error();
        addPaintedAngles(painted, frame, *normals, *uv, angles);
    }
    return angles.finish(std::move(names));
}

Scene sceneFor(const PaintedScene& painted, const FrameGroup& group)
{
    PaintedScene copy = painted;
    setStrengthFor(copy, group.front());
    for (Frame frame : group)
        deriveVertexFrames(copy.scene, frame, TangentOrigin::generated);
    return std::move(copy.scene);
}

} // namespace

Result<std::vector<Measurement>> measureRendered(Renderer& renderer, const AccuracySelection& selection,
                                                 const Progress& progress)
{
    const std::string arithmetic = renderer.device() == "reference" ? "reference" : "vulkan";
    std::vector<Measurement> rows;
    const std::vector<Subject> list = subjects(selection);
    CountedSteps steps(progress, list.size());
    for (const Subject& subject : list) {
        for (int segments : subject.segments) {
            const PaintedScene painted = paintedScene(subject.surface, segments);
            for (const FrameGroup& group : frameGroups(selection)) {
                const Scene scene = sceneFor(painted, group);
                COTAN_CHECK(renderer.load(scene));
                for (Frame frame : group) {
                    const char* truth = frame == Frame::gradient ? "E" : "S";
                    COTAN_TRY(row,
                              drawn(renderer, painted, frame,
                                    {"rendered", subject.surface.name, fmt::format("{}", segments),
                                     std::string(name(frame)), truth, arithmetic}));
                    rows.push_back(*row);
                }
            }
        }
        if (!steps.step())
            return stoppedError();
    }
    return rows;
}

} // namespace cotan::figures
