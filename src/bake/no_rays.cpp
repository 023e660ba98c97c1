// The detailed surface where there is no Embree to find it: nobody can make one.
#include "cotan/bake/high_surface.hpp"
#include "cotan/not_built.hpp"

namespace cotan {

struct HighSurface::State {
    std::vector<std::string> names;
};

std::optional<Error> HighSurface::unavailable() { return notBuiltWith("Embree", "libembree-dev"); }
Result<HighSurface> HighSurface::make(const std::vector<Scene>&, int) { return *unavailable(); }

HighSurface::HighSurface(std::unique_ptr<State> state) : state_(std::move(state)) {}
HighSurface::HighSurface(HighSurface&&) noexcept = default;
HighSurface& HighSurface::operator=(HighSurface&&) noexcept = default;
HighSurface::~HighSurface() = default;

void HighSurface::curve(int) {}
glm::vec3 HighSurface::normalOf(const Hit&, HighNormals, glm::vec3) const { return glm::vec3(0); }
Hit HighSurface::trace(const Ray&) const { return {}; }
void HighSurface::nearest(const Probes&, float, HighNormals, Hits&) const {}
void HighSurface::outermost(const Probes&, float, HighNormals, Hits&) const {}
bool HighSurface::blocked(const Ray&) const { return false; }
const std::vector<std::string>& HighSurface::names() const { return state_->names; }
std::size_t HighSurface::triangleCount() const { return 0; }
glm::vec3 HighSurface::low() const { return glm::vec3(0); }
glm::vec3 HighSurface::high() const { return glm::vec3(0); }

} // namespace cotan
