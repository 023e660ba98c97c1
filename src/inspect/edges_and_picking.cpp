// Draws edges over an image, and finds the triangle at a pixel.
#include "cotan/inspect.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <unordered_map>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

using glm::dvec3;

struct Eye : CameraAxes {
    double high;  // height of the image plane at depth 1, or of the orthographic view
    double scale; // pixels per unit on that plane
    bool orthographic;
    double width, height;
};

Eye eyeOf(const Camera& camera, int width, int height)
{
    const double high =
        camera.orthographic ? double(camera.verticalExtent) : 2 * std::tan(double(camera.verticalFieldOfView) / 2);
    return {cameraAxes(camera), high, height / high, camera.orthographic, double(width), double(height)};
}

// ---- edges ---------------------------------------------------------------------------------

using Key = std::array<std::uint32_t, 6>; // the bits of both ends, the lexicographically smaller end first

struct KeyHash {
    std::size_t operator()(const Key& key) const
    {
        return std::hash<std::string_view>()({reinterpret_cast<const char*>(key.data()), sizeof key});
    }
};

struct EdgeRecord {
    glm::vec2 uvA{0}, uvB{0};
    bool positive = true; // sign of the first triangle's area in uv
    std::size_t edge = 0;
    int triangles = 0;
};

bool before(const glm::vec3& a, const glm::vec3& b)
{
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

void addEdgesOf(const Mesh& mesh, const Texture& map, const glm::mat4& toWorld, std::vector<SurfaceEdge>& edges)
{
    const std::vector<glm::vec2> uv = textureUv(map, mesh);
    std::unordered_map<Key, EdgeRecord, KeyHash> known;
    known.reserve(mesh.indices.size() / 2);
    const auto placed = [&](std::size_t v) { return glm::vec3(toWorld * glm::vec4(mesh.positions[v], 1)); };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* v = &mesh.indices[i];
        const auto uvOf = [&](std::size_t k) { return uv.empty() ? glm::vec2(0) : uv[v[k]]; };
        const glm::vec2 e1 = uvOf(1) - uvOf(0), e2 = uvOf(2) - uvOf(0);
        const bool positive = e1.x * e2.y - e1.y * e2.x >= 0;
        for (std::size_t k = 0; k < 3; ++k) {
            std::size_t a = k, b = (k + 1) % 3;
            if (before(mesh.positions[v[b]], mesh.positions[v[a]]))
                std::swap(a, b);
            const glm::vec3 p = mesh.positions[v[a]] + 0.0f, q = mesh.positions[v[b]] + 0.0f; // no negative zeros
            if (p == q)
                continue;
            const auto [found, fresh] = known.try_emplace(std::bit_cast<Key>(std::array{p, q}));
            EdgeRecord& record = found->second;
            if (fresh) {
                record = {uvOf(a), uvOf(b), positive, edges.size(), 0};
                edges.push_back({placed(v[a]), placed(v[b]), EdgeKind::border});
            } else if (record.triangles == 1) {
                const bool continuous = record.uvA == uvOf(a) && record.uvB == uvOf(b) && record.positive == positive;
                edges[record.edge].kind = continuous ? EdgeKind::inner
                    : record.positive != positive    ? EdgeKind::mirroredSeam
                                                     : EdgeKind::seam;
            }
            ++record.triangles;
        }
    }
}

// Projects a camera-space point to pixels. z: 1 / depth, or the depth if orthographic, which is linear in image space.
dvec3 project(const Eye& e, const dvec3& v)
{
    const double scale = e.orthographic ? e.scale : e.scale / v.z;
    return {e.width / 2 + v.x * scale, e.height / 2 - v.y * scale, e.orthographic ? v.z : 1 / v.z};
}

void drawEdge(Image& image, const Image& depth, const Eye& e, const SurfaceEdge& edge, const std::array<int, 3>& color,
              double strength)
{
    constexpr double kNear = 1e-6, kSlack = 1.003;
    const auto inEye = [&](const glm::vec3& p) {
        const dvec3 d = dvec3(p) - e.eye;
        return dvec3(glm::dot(d, e.right), glm::dot(d, e.up), glm::dot(d, e.forward));
    };
    dvec3 a = inEye(edge.a), b = inEye(edge.b);
    if (!e.orthographic) {
        if (a.z < kNear && b.z < kNear)
            return;
        if (a.z < kNear)
            a += (b - a) * ((kNear - a.z) / (b.z - a.z));
        if (b.z < kNear)
            b += (a - b) * ((kNear - b.z) / (a.z - b.z));
    }
    const dvec3 from = project(e, a), to = project(e, b);
    // Clips the line to the image.
    double start = 0, end = 1;
    for (int axis = 0; axis < 2; ++axis) {
        const double size = axis == 0 ? e.width : e.height, d = to[axis] - from[axis];
        const double t0 = (0 - from[axis]) / d, t1 = (size - from[axis]) / d;
        if (d == 0 && (from[axis] < 0 || from[axis] >= size))
            return;
        if (d != 0) {
            start = std::max(start, std::min(t0, t1));
            end = std::min(end, std::max(t0, t1));
        }
    }
    if (!(start <= end))
        return;
    const double length = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y)) * (end - start);
    const int steps = int(std::min(length, 4.0 * (e.width + e.height))) + 1;
    for (int i = 0; i <= steps; ++i) {
        const dvec3 at = from + (to - from) * (start + (end - start) * i / steps);
        const int x = int(std::floor(at.x)), y = int(std::floor(at.y));
        if (x < 0 || y < 0 || x >= image.width || y >= image.height)
            continue;
        double behind = 0; // farthest depth around the pixel, since depth is discontinuous at edges
        for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            const int nx = std::clamp(x + dx, 0, image.width - 1), ny = std::clamp(y + dy, 0, image.height - 1);
            const float* d = depth.floats() + 4 * (std::size_t(ny) * std::size_t(depth.width) + std::size_t(nx));
            behind = std::max(behind, d[3] > 0 ? double(d[0]) : 1e30);
        }
        const double z = e.orthographic ? at.z : 1 / at.z;
        if (z > behind * kSlack)
            continue;
        std::uint8_t* p = image.bytes8() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = std::uint8_t(std::lround(p[c] + (color[c] - p[c]) * strength));
        p[3] = 255;
    }
}

} // namespace

std::vector<SurfaceEdge> surfaceEdges(const Scene& scene)
{
    std::vector<SurfaceEdge> edges;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        addEdgesOf(mesh, frameTexture(scene.materials[std::size_t(mesh.material)]), instance.toWorld, edges);
    }
    return edges;
}

void drawEdges(Image& image, const Image& depth, const Camera& camera, std::span<const SurfaceEdge> edges,
               EdgesShown shown)
{
    if (image.width != depth.width || image.height != depth.height || !hasPixels(image) || !hasPixels(depth))
        return;
    const Eye eye = eyeOf(camera, image.width, image.height);
    if (shown.triangles)
        for (const SurfaceEdge& edge : edges)
            drawEdge(image, depth, eye, edge, {20, 20, 24}, 0.6);
    constexpr std::array<std::array<int, 3>, 4> kColors = {{{0, 0, 0}, {255, 215, 40}, {255, 60, 220}, {60, 220, 255}}};
    if (shown.seams)
        for (const SurfaceEdge& edge : edges)
            if (edge.kind != EdgeKind::inner)
                drawEdge(image, depth, eye, edge, kColors[std::size_t(edge.kind)], 1);
}

// ---- what is at a pixel --------------------------------------------------------------------

namespace {

struct Ray {
    dvec3 from, along; // `along` has unit depth, not unit length
};

// The ray through a point of the image; along . forward is 1, so its parameter is the depth.
Ray rayAt(const Camera& camera, glm::ivec2 size, glm::vec2 point)
{
    const Eye e = eyeOf(camera, size.x, size.y);
    const double x = (double(point.x) - size.x * 0.5) * e.high / size.y,
                 y = (size.y * 0.5 - double(point.y)) * e.high / size.y;
    const dvec3 aside = e.right * x + e.up * y;
    return camera.orthographic ? Ray{e.eye + aside, e.forward} : Ray{e.eye, e.forward + aside};
}

// Moeller-Trumbore intersection. A positive determinant means that the ray hits the front.
bool intersect(const Ray& ray, const dvec3& a, const dvec3& b, const dvec3& c, bool bothSides, double& t,
               glm::dvec2& weights)
{
    const dvec3 e1 = b - a, e2 = c - a, p = glm::cross(ray.along, e2);
    const double determinant = glm::dot(e1, p);
    if (!(std::abs(determinant) > 0) || (determinant < 0 && !bothSides))
        return false;
    const dvec3 s = ray.from - a;
    const double u = glm::dot(s, p) / determinant;
    const dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(ray.along, q) / determinant;
    t = glm::dot(e2, q) / determinant;
    weights = {u, v};
    return u >= 0 && v >= 0 && u + v <= 1;
}

} // namespace

std::optional<PickedPoint> pick(const Scene& scene, const Camera& camera, glm::ivec2 size, glm::vec2 point)
{
    std::optional<PickedPoint> nearest;
    if (size.x < 1 || size.y < 1)
        return nearest;
    const Ray ray = rayAt(camera, size, point);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::dmat4 toWorld(instance.toWorld);
        const glm::dmat4 toMesh = glm::inverse(toWorld);
        const Ray local{dvec3(toMesh * glm::dvec4(ray.from, 1)), dvec3(toMesh * glm::dvec4(ray.along, 0))};
        const bool bothSides = scene.materials[std::size_t(mesh.material)].doubleSided;
        for (std::size_t triangle = 0; triangle < mesh.triangleCount(); ++triangle) {
            const auto corner = [&](std::size_t k) { return dvec3(mesh.positions[mesh.indices[3 * triangle + k]]); };
            double t = 0;
            glm::dvec2 weights{0};
            if (!intersect(local, corner(0), corner(1), corner(2), bothSides, t, weights) || !(t > 0) || !(t < best))
                continue;
            best = t;
            nearest = PickedPoint{int(i),
                                  instance.mesh,
                                  triangle,
                                  {1 - weights.x - weights.y, weights.x, weights.y},
                                  glm::vec3(ray.from + ray.along * t),
                                  float(t)};
        }
    }
    return nearest;
}

} // namespace cotan
