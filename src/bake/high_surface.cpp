#include "bake/high_surface.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cotan/covector.hpp"
#include "high_state.hpp"
#include "scene/parts.hpp"

namespace cotan {

namespace {

// Files with normals may wind their triangles either way: the normals say where the outside is.
float frontOf(const Part& part)
{
    double agreement = 0;
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const std::uint32_t* c = &part.indices[i];
        const glm::vec3 p = part.positions[c[0]];
        const glm::vec3 area = glm::cross(part.positions[c[1]] - p, part.positions[c[2]] - p);
        agreement += double(glm::dot(area, part.normals[c[0]] + part.normals[c[1]] + part.normals[c[2]]));
    }
    return agreement < 0 ? -1.0f : 1.0f;
}

Part placed(const Mesh& mesh, const glm::mat4& toWorld)
{
    Part part;
    const glm::mat3 linear(toWorld);
    const LinearMap<float> map(linear);
    const glm::mat3 covectors = map.planeMatrix();
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        part.positions.push_back(glm::vec3(toWorld * glm::vec4(mesh.positions[v], 1)));
        const glm::vec3 n = covectors * mesh.normals[v];
        const float length = glm::length(n);
        part.normals.push_back(length > 0 ? n / length : n);
    }
    part.indices = mesh.indices;
    if (map.determinant() < 0)
        for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3)
            std::swap(part.indices[i + 1], part.indices[i + 2]);
    part.front = frontOf(part);
    return part;
}

// Which triangles lie on earlier ones, of any instance.
void findRepeated(std::vector<Part>& parts)
{
    std::vector<std::size_t> first; // triangle of each part
    std::size_t count = 0;
    for (const Part& part : parts) {
        first.push_back(count);
        count += part.indices.size() / 3;
    }
    const std::vector<std::uint8_t> repeated = repeatedTriangles(count, [&](std::size_t i) {
        const auto n = std::size_t(std::upper_bound(first.begin(), first.end(), i) - first.begin()) - 1;
        const std::uint32_t* const c = &parts[n].indices[3 * (i - first[n])];
        const std::vector<glm::vec3>& p = parts[n].positions;
        return CornersOfTriangle{{p[c[0]], p[c[1]], p[c[2]]}};
    });
    for (std::size_t n = 0; n < parts.size() && !repeated.empty(); ++n) {
        const auto from = repeated.begin() + std::ptrdiff_t(first[n]);
        parts[n].repeated.assign(from, from + std::ptrdiff_t(parts[n].indices.size() / 3));
    }
}

} // namespace

std::optional<Error> HighSurface::unavailable() { return std::nullopt; }

Result<HighSurface> HighSurface::make(const std::vector<Scene>& scenes, int threads, bool byInstance)
{
    auto state = std::make_unique<State>();
    for (const Scene& scene : scenes)
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            if (mesh.indices.empty())
                continue;
            state->parts.push_back(placed(mesh, instance.toWorld));
            state->fronts.push_back(state->parts.back().front);
            state->names.push_back(!instance.name.empty() ? instance.name : mesh.name);
            state->triangles += mesh.triangleCount();
            for (const glm::vec3& p : state->parts.back().positions) {
                state->low = glm::min(state->low, p);
                state->high = glm::max(state->high, p);
            }
        }
    if (state->triangles == 0)
        return inputError(fmt::format("{}: expected triangles; found none", scenes.empty() ? "" : scenes[0].name));
    state->device = rtcNewDevice(threads > 0 ? fmt::format("threads={}", threads).c_str() : nullptr);
    if (!state->device)
        return unavailableError("Embree: no device");
    state->scene = rtcNewScene(state->device);
    // Robust: rays along edges find one of the two triangles. Filters: packets.hpp.
    rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST | kFiltersInQueries);
    if (!byInstance) // else each is asked for its own
        findRepeated(state->parts);
    for (Part& part : state->parts)
        state->attach(part);
    rtcCommitScene(state->scene);
    if (rtcGetDeviceError(state->device) != RTC_ERROR_NONE)
        return unavailableError(fmt::format("Embree: cannot hold {} triangles", state->triangles));
    return HighSurface(std::move(state));
}

HighSurface::HighSurface(std::unique_ptr<State> state) : state_(std::move(state)) {}
HighSurface::HighSurface(HighSurface&&) noexcept = default;
HighSurface& HighSurface::operator=(HighSurface&&) noexcept = default;
HighSurface::~HighSurface() = default;

void HighSurface::curve(int threads)
{
    for (Part& part : state_->parts) // behind the positions is one more, for Embree
        part.shapes = shapeOperators({part.positions.data(), part.normals.size()}, part.normals, part.indices, threads);
}

HighSurface::Triangles HighSurface::triangles(std::size_t instance) const
{
    const Part& part = state_->parts[instance];
    return {{part.positions.data(), part.normals.size()}, part.normals, part.indices, part.repeated, part.front};
}

const std::vector<std::string>& HighSurface::names() const { return state_->names; }
std::size_t HighSurface::triangleCount() const { return state_->triangles; }
glm::vec3 HighSurface::low() const { return state_->low; }
glm::vec3 HighSurface::high() const { return state_->high; }

} // namespace cotan
