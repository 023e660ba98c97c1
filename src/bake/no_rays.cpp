// HighSurface and LowTree for builds without Embree: neither can be made.
#include "bake/high_surface.hpp"
#include "bake/low_tree.hpp"
#include "core/not_built.hpp"

namespace cotan {

struct HighSurface::State {
    Bounds box;
};

std::optional<Error> HighSurface::unavailable() { return notBuiltWith("Embree", "libembree-dev"); }
Result<HighSurface> HighSurface::make(const std::vector<Scene>&, int, bool) { return *unavailable(); }

void HighSurface::setGroups(std::vector<std::uint32_t>) {}
std::uint32_t HighSurface::groupOf(std::size_t) const { return 0; }
void HighSurface::curve(int) {}
bool HighSurface::isCurved() const { return false; }
float HighSurface::curvatureAt(const Hits&, std::size_t) const { return 0; }
glm::vec3 HighSurface::normalOf(const Hit&, HighNormals, glm::vec3) const { return glm::vec3(0); }
Hit HighSurface::trace(const Ray&) const { return {}; }
void HighSurface::nearest(const Probes&, float, HighNormals, Hits&) const {}
void HighSurface::outermost(const Probes&, HighNormals, Hits&) const {}
void HighSurface::anyBetween(const Probes&, Lanes<int>&, bool) const {}
void HighSurface::distances(const Probes&, Lanes<float>&) const {}
bool HighSurface::blocked(const Ray&) const { return false; }
std::size_t HighSurface::countHits(const Ray&) const { return 0; }
HighSurface::Triangles HighSurface::triangles(std::size_t) const { return {}; }
std::size_t HighSurface::instanceCount() const { return 0; }
std::size_t HighSurface::triangleCount() const { return 0; }
const Bounds& HighSurface::box() const { return state_->box; }

struct LowTree::State {};

Result<LowTree> LowTree::make(std::vector<glm::vec3>, std::vector<std::uint32_t>, std::vector<std::int64_t>, int)
{
    return *HighSurface::unavailable();
}
LowTree::Nearest LowTree::nearest(glm::vec3, float, const std::function<bool(std::uint32_t)>&) const { return {}; }
LowTree::TreeHit LowTree::first(const Ray&) const { return {}; }
LowTree::TreeHit LowTree::firstBeside(std::uint32_t, Ray) const { return {}; }
glm::vec3 LowTree::face(std::uint32_t) const { return glm::vec3(0); }

} // namespace cotan
