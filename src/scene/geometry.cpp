// Cameras that frame a scene, default lights, and checks of what is drawn.
#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

using glm::dvec3;

// ---- cameras: axes ---------------------------------------------------------------------------

constexpr double kShortest = 1e-30; // minimum length of a vector that has a direction
constexpr double kParallel = 1e-6;  // sine of the angle below which `up` counts as parallel to forward

// ---- cameras: from the right and above -------------------------------------------------------

constexpr float kMargin = 0.94f;   // fraction of the half image that the box may fill
constexpr float kFlatness = 0.05f; // ratio of depth to width or height below which a box is flat
const glm::vec3 kFrontRightAbove{0.40f, 0.35f, 1.0f};

// The minimum distance along `back` from the centre at which the image, less the margin, shows all corners of the box.
float distanceToSee(glm::vec3 halfSize, glm::vec3 back, float tanX, float tanY)
{
    const CameraAxes axes = axesAlong(-glm::dvec3(back), glm::dvec3(0, 1, 0));
    const glm::vec3 right(axes.right), up(axes.up);
    float distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = halfSize * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const float beside = std::max(std::abs(glm::dot(p, right)) / tanX, std::abs(glm::dot(p, up)) / tanY);
        distance = std::max(distance, glm::dot(p, back) + beside / kMargin);
    }
    return distance;
}

// ---- cameras: as close as the framed points allow --------------------------------------------

constexpr double kFieldOfView = 0.523599; // 30 degrees
constexpr double kRadians = std::numbers::pi / 180;
constexpr double kFilledFraction = 0.92; // fraction of the image: leaves a margin of 4 % on each side

// A point seen along one image axis: its offset from the view axis, and its depth from the eye.
struct Extreme {
    double offset = 0, depth = 1;
};

// Moves the eye sideways until the outermost points on both sides are equally far from the image's middle, and likewise
// up and down. What was inside the image stays inside. axes: of the camera, with its target as their eye.
void centreCamera(const Scene& scene, const CameraAxes& axes, double distance, double& x, double& y)
{
    for (int round = 0; round < 4; ++round) {
        std::array<Extreme, 4> furthest; // east, west, north, south
        std::array<double, 4> slope;
        slope.fill(-std::numeric_limits<double>::infinity());
        forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
            const dvec3 p = dvec3(glm::dmat4(toWorld) * glm::dvec4(dvec3(point), 1)) - axes.eye;
            const double depth = distance + glm::dot(p, axes.forward);
            const double right = glm::dot(p, axes.right), up = glm::dot(p, axes.up);
            if (!(depth > 0) || !std::isfinite(right) || !std::isfinite(up))
                return;
            const std::array<double, 4> slopes{(right - x) / depth, (x - right) / depth, (up - y) / depth,
                                               (y - up) / depth};
            for (std::size_t i = 0; i < 4; ++i)
                if (slopes[i] > slope[i]) {
                    slope[i] = slopes[i];
                    furthest[i] = {i < 2 ? right : up, depth};
                }
        });
        if (!std::isfinite(slope[0]))
            return;
        const auto between = [](const Extreme& a, const Extreme& b) {
            return (a.offset * b.depth + b.offset * a.depth) / (a.depth + b.depth);
        };
        x = between(furthest[0], furthest[1]);
        y = between(furthest[2], furthest[3]);
    }
}

// Returns the closest camera that looks against `back` and frames the whole scene. A scene without finite points gives
// the default eye and target.
Camera framedCamera(const char* name, const Scene& scene, const Bounds& box, const dvec3& back, const glm::vec3& upward,
                    int width, int height)
{
    Camera camera;
    camera.name = name;
    camera.verticalFieldOfView = float(kFieldOfView);
    if (box.empty())
        return camera;
    camera.up = upward;
    CameraAxes axes = axesAlong(-back, dvec3(upward));
    axes.eye = dvec3(box.low) * 0.5 + dvec3(box.high) * 0.5;
    const dvec3 right = axes.right, up = axes.up, middle = axes.eye;

    // A point (x, y, z) along these axes is inside while |x - eye.x| <= tanX (eye.z - z), and likewise for y: four
    // planes.
    const double tanY = std::tan(kFieldOfView / 2) * kFilledFraction;
    const double tanX = tanY * (width > 0 && height > 0 ? double(width) / height : 1.0);
    const double least = -std::numeric_limits<double>::infinity();
    double east = least, west = least, north = least, south = least, nearest = least;
    forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
        const dvec3 p = dvec3(glm::dmat4(toWorld) * glm::dvec4(dvec3(point), 1)) - middle;
        if (!isFinite(p))
            return;
        const double x = glm::dot(p, right), y = glm::dot(p, up), z = glm::dot(p, back);
        east = std::max(east, x + tanX * z);
        west = std::max(west, -x + tanX * z);
        north = std::max(north, y + tanY * z);
        south = std::max(south, -y + tanY * z);
        nearest = std::max(nearest, z);
    });
    double distance = std::max((east + west) / (2 * tanX), (north + south) / (2 * tanY));
    const double magnitude = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
    if (!(distance - nearest > 1e-3 * magnitude)) // nearly a point: keep a distance significant
        distance = nearest + std::max(1e-3 * magnitude, distance > nearest ? distance - nearest : 1.0);
    double x = (east - west) / 2, y = (north - south) / 2;
    centreCamera(scene, axes, distance, x, y);
    const dvec3 aim = middle + right * x + up * y;
    const glm::vec3 eye(aim + back * distance);
    if (!std::isfinite(distance) || !std::isfinite(eye.x + eye.y + eye.z))
        return camera;
    camera.target = glm::vec3(aim);
    camera.eye = eye;
    return camera;
}

// Exact at multiples of 90 degrees, so that sides are viewed straight on.
double sineOf(double degrees)
{
    const double quarters = degrees / 90;
    if (quarters == std::floor(quarters))
        return std::array<double, 4>{0, 1, 0, -1}[std::size_t(std::fmod(std::fmod(quarters, 4) + 4, 4))];
    return std::sin(degrees * kRadians);
}

// ---- what is drawn, and where ----------------------------------------------------------------

// Whether two linear maps differ only by a rotation, mirroring and uniform scale: their Gram matrices are proportional.
// All frames give the same result for both.
bool alikeForFrames(const glm::dmat3& a, const glm::dmat3& b)
{
    const glm::dmat3 ga = glm::transpose(a) * a, gb = glm::transpose(b) * b;
    const double ta = ga[0][0] + ga[1][1] + ga[2][2], tb = gb[0][0] + gb[1][1] + gb[2][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(ga[i][j] * tb - gb[i][j] * ta) <= 1e-5 * ta * tb))
                return false;
    return true;
}

glm::vec3 zUpToYUp(const glm::vec3& v) { return {v.x, v.z, -v.y}; }

} // namespace

CameraAxes axesAlong(const glm::dvec3& forward, const glm::dvec3& up)
{
    const glm::dvec3 other = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    glm::dvec3 side = glm::cross(forward, unitOr(up, other, kShortest));
    if (glm::length(side) < kParallel)
        side = glm::cross(forward, other);
    CameraAxes axes;
    axes.forward = forward;
    axes.right = side / glm::length(side);
    axes.up = glm::cross(axes.right, forward);
    return axes;
}

CameraAxes cameraAxes(const Camera& camera)
{
    const glm::dvec3 eye = isFinite(camera.eye) ? glm::dvec3(camera.eye) : glm::dvec3(0);
    CameraAxes axes = axesAlong(unitOr(glm::dvec3(camera.target) - eye, {0, 0, -1}, kShortest), glm::dvec3(camera.up));
    axes.eye = eye;
    return axes;
}

Camera fitCamera(const Bounds& box, int width, int height)
{
    Camera camera;
    camera.name = "fit";
    if (box.empty() || !isFinite(box.low) || !isFinite(box.high))
        return camera;

    // Halves before subtracting, so that the largest floats do not overflow.
    const glm::vec3 centre = box.low * 0.5f + box.high * 0.5f;
    const glm::vec3 halfSize = box.high * 0.5f - box.low * 0.5f;
    const bool flat = halfSize.z < kFlatness * std::max(halfSize.x, halfSize.y);
    const glm::vec3 back = flat ? glm::vec3(0, 0, 1) : glm::normalize(kFrontRightAbove);

    const float aspect = width > 0 && height > 0 ? float(width) / float(height) : 1.0f;
    const float tanY = std::tan(camera.verticalFieldOfView / 2);
    float distance = distanceToSee(halfSize, back, tanY * aspect, tanY);
    if (!(distance > 0)) { // a single point: any distance that is significant beside the coordinates
        const glm::vec3 size = glm::abs(centre);
        distance = std::max(1.0f, std::max({size.x, size.y, size.z}) * 1e-3f);
    }
    const glm::vec3 eye = centre + back * distance;
    if (!isFinite(eye)) // a box of nearly the largest floats
        return camera;
    camera.target = centre;
    camera.eye = eye;
    return camera;
}

Camera orbitedCamera(Camera camera, double angle)
{
    const glm::vec3 d = camera.eye - camera.target;
    const float c = float(std::cos(angle)), s = float(std::sin(angle));
    camera.eye = camera.target + glm::vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
    return camera;
}

std::vector<Light> defaultLights()
{
    return {Light{.kind = LightKind::directional, .direction = glm::normalize(glm::vec3(0.5f, -0.9f, -0.75f))}};
}

Camera frontCamera(const Scene& scene, int width, int height)
{
    const Bounds box = framedBounds(scene);
    const glm::vec3 size = box.high - box.low;
    const bool flat = size.z < kFlatness * std::max(size.x, size.y);
    const dvec3 back = flat ? dvec3(0, 0, 1) : glm::normalize(dvec3(0.36, 0.24, 1));
    return framedCamera("front", scene, box, back, {0, 1, 0}, width, height);
}

Camera orbitCamera(const Scene& scene, double azimuth, double elevation, int width, int height)
{
    const double sinA = sineOf(azimuth), cosA = sineOf(azimuth + 90);
    const double sinE = sineOf(elevation), cosE = sineOf(elevation + 90);
    const glm::vec3 up = cosE == 0 ? glm::vec3(dvec3(-sinA, 0, -cosA) * sinE) : glm::vec3(0, 1, 0);
    return framedCamera("orbit", scene, framedBounds(scene), {sinA * cosE, sinE, cosA * cosE}, up, width, height);
}

Status checkVertexAttributes(const Scene& scene, Frame ofView, bool framesOfMeshes)
{
    if (!readsVertices(ofView) && !framesOfMeshes)
        return Done{};
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh || mesh->triangleCount() == 0 || mesh->material < 0
            || std::size_t(mesh->material) >= scene.materials.size())
            continue;
        const Frame frame = frameOf(*mesh, ofView, framesOfMeshes);
        if (!readsVertices(frame))
            continue;
        const std::size_t vertices = mesh->vertexCount();
        const bool hasUv =
            mesh->texcoords[uvSetOf(frameTexture(scene.materials[std::size_t(mesh->material)]))].size() >= vertices;
        const bool has = readsTangents(frame)
            ? mesh->tangents.size() >= vertices
            : mesh->cotangentsU.size() >= vertices && mesh->cotangentsV.size() >= vertices;
        if (vertices > 0 && hasUv && !has)
            return usageError((scene.name.empty() ? "scene" : scene.name) + ": mesh '" + mesh->name + "': expected "
                              + (readsTangents(frame) ? "tangents" : "cotangents") + " for the frame "
                              + std::string(name(frame)) + "; found none (call deriveVertexFrames)");
    }
    return Done{};
}

bool drawsNormalMaps(const Scene& scene)
{
    return std::ranges::any_of(scene.instances, [&](const Instance& i) {
        const Mesh* mesh = meshPlacedBy(scene, i);
        if (!mesh || mesh->triangleCount() == 0)
            return false;
        const Texture& map = scene.materials[std::size_t(mesh->material)].normalMap;
        return map.present() && !mesh->texcoords[uvSetOf(map)].empty();
    });
}

void addDistinctLinearMap(std::vector<glm::dmat3>& known, const glm::dmat3& linear)
{
    if (std::ranges::none_of(known, [&](const glm::dmat3& k) { return alikeForFrames(k, linear); }))
        known.push_back(linear);
}

void addIdentityWhereEmpty(std::vector<std::vector<glm::dmat3>>& placings)
{
    for (auto& known : placings)
        if (known.empty())
            known.push_back(glm::dmat3(1));
}

void appendScene(Scene& scene, Scene more)
{
    const int images = int(scene.images.size()), materials = int(scene.materials.size()),
              meshes = int(scene.meshes.size());
    for (Material& m : more.materials) {
        m.copyOf = m.copyOf < 0 ? -1 : m.copyOf + materials;
        for (const auto& [texture, name] : texturesOf(m))
            texture->image = texture->present() ? texture->image + images : -1;
    }
    for (Mesh& mesh : more.meshes)
        mesh.material += materials;
    for (Instance& instance : more.instances)
        instance.mesh += meshes;
    const auto append = [](auto& to, auto& from) {
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    };
    append(scene.images, more.images);
    append(scene.materials, more.materials);
    append(scene.meshes, more.meshes);
    append(scene.instances, more.instances);
    append(scene.lights, more.lights);
    append(scene.cameras, more.cameras);
    append(scene.warnings, more.warnings);
}

void rotateZUpToYUp(Scene& scene)
{
    const glm::mat4 kZUpToYUp(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    for (Instance& instance : scene.instances)
        instance.toWorld = kZUpToYUp * instance.toWorld;
    for (Light& light : scene.lights) {
        light.position = zUpToYUp(light.position);
        light.direction = zUpToYUp(light.direction);
    }
    for (Camera& camera : scene.cameras) {
        camera.eye = zUpToYUp(camera.eye);
        camera.target = zUpToYUp(camera.target);
        camera.up = zUpToYUp(camera.up);
    }
    for (glm::vec3& point : scene.reach)
        point = zUpToYUp(point);
}

} // namespace cotan
