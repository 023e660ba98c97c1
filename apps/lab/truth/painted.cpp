#include "truth/painted.hpp"

#include <algorithm>
#include <cmath>

#include "cotan/portable.hpp"
#include "truth/quad.hpp"
#include "truth/tessellation.hpp"

namespace cotan {

namespace {

std::uint16_t toWord(double component)
{
    return std::uint16_t(std::lround(f64::cotan_compress(component, COTAN_EXPAND_EXACT16) * 65535));
}

Image slopeMap(glm::dvec2 origin, double side, int pixels)
{
    Image image = makeImage(pixels, pixels, PixelType::unorm16, "relief");
    std::uint16_t* word = image.words();
    for (int j = 0; j < pixels; ++j)
        for (int i = 0; i < pixels; ++i) {
            const glm::dvec2 uv = origin + glm::dvec2(i + 0.5, j + 0.5) * (side / pixels);
            const glm::dvec3 m = texelOf(Waves{}.at(uv.x, uv.y));
            for (double component : {m.x, m.y, m.z})
                *word++ = toWord(component);
            *word++ = 65535;
        }
    return image;
}

std::vector<Camera> camerasAround(const std::vector<glm::vec3>& positions)
{
    glm::vec3 low(positions.front()), high(low);
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    std::vector<Camera> cameras;
    for (glm::vec3 from : {glm::vec3(0.3f, -1, 0.4f), {-1, 0.5f, 0.3f}, {0.6f, 0.7f, 1.2f}}) {
        Camera camera;
        camera.target = (low + high) * 0.5f;
        camera.eye = camera.target + glm::normalize(from) * (1.5f * glm::length(high - low));
        camera.up = {0.1f, 0.2f, 1};
        cameras.push_back(camera);
    }
    return cameras;
}

} // namespace

PaintedScene paintedScene(const Surface& surface, int segments, int texelsPerUnit)
{
    PaintedScene painted;
    painted.surface = surface;
    painted.unitsPerUv = surface.unitsPerUv();
    const Tessellation shape = tessellate(surface, segments, false, false);
    glm::dvec2 low(shape.texcoords.front()), high(low);
    for (const glm::vec2& uv : shape.texcoords) {
        low = glm::min(low, glm::dvec2(uv));
        high = glm::max(high, glm::dvec2(uv));
    }
    // u and v need the same scale: the frame is built from the map's coordinates, which must not be stretched.
    const double margin = 4.0 / texelsPerUnit;
    painted.mapOrigin = low - margin;
    painted.mapSide = std::max(high.x - low.x, high.y - low.y) + 2 * margin;

    Scene& scene = painted.scene;
    scene.name = surface.name;
    scene.images.push_back(
        slopeMap(painted.mapOrigin, painted.mapSide, int(std::ceil(painted.mapSide * texelsPerUnit))));
    Material material;
    material.normalFormat.greenUp = false;
    material.normalMap.image = 0;
    material.normalMap.sampler.mip = MipFilter::none;
    material.normalMap.sampler.wrapU = material.normalMap.sampler.wrapV = Wrap::clamp;
    const float scale = float(1 / painted.mapSide);
    material.normalMap.uRow = {scale, 0, -float(painted.mapOrigin.x) * scale};
    material.normalMap.vRow = {0, scale, -float(painted.mapOrigin.y) * scale};
    scene.materials.push_back(material);
    Mesh mesh;
    mesh.positions = shape.positions;
    mesh.normals = shape.normals;
    mesh.texcoords[0] = shape.texcoords;
    mesh.indices = shape.indices;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({});
    painted.cameras = camerasAround(shape.positions);
    return painted;
}

void setStrengthFor(PaintedScene& painted, Frame frame)
{
    // The gradients of the map coordinates are those of uv divided by mapSide.
    const double metric = painted.unitsPerUv * painted.mapSide;
    painted.scene.materials.front().normalScale = frame == Frame::gradient ? float(metric) : 1.0f;
}

void addPaintedAngles(const PaintedScene& painted, Frame frame, const Image& normals, const Image& uv,
                      AngleCollector& angles)
{
    const float* n = normals.floats();
    const float* c = uv.floats();
    for (std::size_t i = 0; i < normals.pixelCount(); ++i, n += 4, c += 4) {
        if (n[3] == 0)
            continue;
        const glm::dvec2 texcoords = glm::dvec2(c[0], c[1]) * painted.mapSide + painted.mapOrigin;
        const SurfacePoint p = painted.surface.at(painted.surface.parameters(texcoords));
        const ReliefSample relief = Waves{}.at(texcoords.x, texcoords.y);
        const glm::dvec3 truth = frame == Frame::gradient
            ? painted.surface.displacedNormal(p, relief, painted.unitsPerUv)
            : truthS(p, texelOf(relief));
        angles.add(degreesBetween(glm::dvec3(n[0], n[1], n[2]), truth));
    }
}

} // namespace cotan
