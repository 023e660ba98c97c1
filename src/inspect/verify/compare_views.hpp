// What both ways to verify share: a renderer that looks at a scene, the view that is drawn, and the comparison.
#pragma once

#include "bake/bake_surfaces.hpp"
#include "cotan/frame.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "inspect/statistics.hpp"

namespace cotan {

// Lets the renderer look at a scene while it lives.
class ShownScene {
public:
    ShownScene(Renderer& renderer, const Scene& scene) : renderer_(renderer), status_(renderer.load(scene)) {}
    ~ShownScene() { renderer_.forget(); }
    ShownScene(const ShownScene&) = delete;
    ShownScene& operator=(const ShownScene&) = delete;

    const Status& status() const { return status_; }

private:
    Renderer& renderer_;
    Status status_;
};

// A square picture of normals.
View normalView(const Camera& camera, Frame frame, int side);

// The angles as they are where a normal map is drawn; otherwise none, as no frame has a part in the normals.
std::vector<float> mappedAngles(std::vector<float> degrees, bool mapped);

// Collects views and, in the end, the statistics of all. mapped: see ComparedViews.
class ViewComparison {
public:
    explicit ViewComparison(bool mapped) { result_.mapped = mapped; }
    // Two pictures of directions of the same size.
    void add(const Image& expected, const Image& drawn);
    // The same for a bake: the high surface itself is shown, and pixels with another surface are magenta.
    void add(const Image& expected, const Image& drawn, const SeenHigh& seen);
    ComparedViews finish();

private:
    ComparedViews result_;
    AngleCounter all_;
};

} // namespace cotan
