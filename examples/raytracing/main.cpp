// Normal mapping without tangents in a ray tracer: raytracing picture.ppm [normals.pfm] A ray has no screen
// derivatives, but a ray tracer knows the triangle, and the frame `exact` uses its edges. Draws two sheets with sheared
// texture coordinates, mirrored on the left half, one from the front and one from behind. cotan.hpp is the output of
// `cotan shader --lang cpp --frame exact`.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "cotan.hpp"

using Vec2 = cotan_shader::cotan_vec2;
using Vec3 = cotan_shader::cotan_vec3;

constexpr unsigned kWidth = 480, kHeight = 240;
constexpr float kZoom = 2.2f;

struct Mesh {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> corners; // three per triangle
};

// A sheet of two by two units around `middle`, rotated about y.
void addSheet(Mesh& mesh, Vec3 middle, float angle)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const float c = std::cos(angle), s = std::sin(angle);
    for (int x = -1; x <= 1; ++x)
        for (int y = 1; y >= -1; y -= 2) {
            const float fx = float(x), fy = float(y);
            mesh.positions.push_back(middle + Vec3{c * fx, fy, -s * fx});
            mesh.normals.push_back({s, 0, c});
            mesh.uvs.push_back({std::fabs(fx) + 0.5f * (1 - fy), 1 - fy}); // v runs down
        }
    for (std::uint32_t corner : {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5})
        mesh.corners.push_back(first + corner);
}

// A texel of a glTF normal map of four domes: red along +u, green up the image.
Vec3 sampleDomes(Vec2 uv)
{
    const float x = std::fmod(uv.x * 4, 2.0f) - 1, down = std::fmod(uv.y * 4, 2.0f) - 1;
    const float z2 = 1 - x * x - down * down;
    const Vec3 m = z2 > 0.36f ? Vec3{x, -down, std::sqrt(z2)} : Vec3{0, 0, 1};
    return {(127 * m.x + 128) / 255, (127 * m.y + 128) / 255, (127 * m.z + 128) / 255};
}

// The shading normal at the barycentric coordinates u and v of a triangle.
Vec3 shadingNormal(const Mesh& mesh, const RTCRayHit& r)
{
    const std::uint32_t* c = &mesh.corners[3 * std::size_t(r.hit.primID)];
    const float w = 1 - r.hit.u - r.hit.v;
    const Vec3 normal = mesh.normals[c[0]] * w + mesh.normals[c[1]] * r.hit.u + mesh.normals[c[2]] * r.hit.v;
    const Vec2 uv0 = mesh.uvs[c[0]], uv1 = mesh.uvs[c[1]], uv2 = mesh.uvs[c[2]];
    const Vec2 edge1{uv1.x - uv0.x, uv1.y - uv0.y}, edge2{uv2.x - uv0.x, uv2.y - uv0.y};
    const Vec2 uv{uv0.x + edge1.x * r.hit.u + edge2.x * r.hit.v, uv0.y + edge1.y * r.hit.u + edge2.y * r.hit.v};
    const Vec3 p0 = mesh.positions[c[0]];
    const Vec3 n = cotan_shader::cotan_perturb_normal_from_edges(
        normal, mesh.positions[c[1]] - p0, mesh.positions[c[2]] - p0, edge1, edge2, sampleDomes(uv));
    // For a thin sheet a bump in front is a dent behind.
    const bool behind = dot(normal, Vec3{r.ray.dir_x, r.ray.dir_y, r.ray.dir_z}) > 0;
    return n * (behind ? -1.0f : 1.0f);
}

int main(int count, char** words)
{
    if (count < 2)
        return std::fprintf(stderr, "usage: raytracing picture.ppm [normals.pfm]\n"), 1;
    Mesh mesh;
    addSheet(mesh, {-1.2f, 0, 0}, 0.4f);
    addSheet(mesh, {1.2f, 0, 0}, 3.14159265f - 0.4f);

    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads beyond the last element, so the data is copied to buffers that Embree pads.
    auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                sizeof(Vec3), mesh.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.corners.size() / 3));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        vertices[i] = mesh.positions[i];
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
        indices[i] = mesh.corners[i];
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);

    std::vector<Vec3> normals(kWidth * kHeight, Vec3{0, 0, 0}); // rows from the top; zero where nothing was hit
    for (unsigned row = 0; row < kHeight; ++row)
        for (unsigned column = 0; column < kWidth; ++column) {
            RTCRayHit r{};
            r.ray.org_z = 4;
            r.ray.dir_x = (2 * (float(column) + 0.5f) / kWidth - 1) * (float(kWidth) / kHeight) / kZoom;
            r.ray.dir_y = (1 - 2 * (float(row) + 0.5f) / kHeight) / kZoom;
            r.ray.dir_z = -1;
            r.ray.tfar = std::numeric_limits<float>::infinity();
            r.ray.mask = ~0u;
            r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
            rtcIntersect1(scene, &r);
#else
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            rtcIntersect1(scene, &context, &r);
#endif
            if (r.hit.geomID != RTC_INVALID_GEOMETRY_ID)
                normals[row * kWidth + column] = shadingNormal(mesh, r);
        }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);

    std::FILE* picture = std::fopen(words[1], "wb");
    if (!picture)
        return std::perror(words[1]), 4;
    std::fprintf(picture, "P6\n%u %u\n255\n", kWidth, kHeight);
    for (const Vec3& n : normals) {
        const bool hit = dot(n, n) > 0;
        const float light = std::fmax(0.0f, dot(n, Vec3{-0.4264f, 0.6396f, 0.6396f}));
        const int grey = hit ? int(255 * std::pow(0.1f + 0.9f * light, 1 / 2.2f)) : 34;
        for (int channel = 0; channel < 3; ++channel)
            std::fputc(grey, picture);
    }
    std::fclose(picture);
    if (std::FILE* out = count > 2 ? std::fopen(words[2], "wb") : nullptr) {
        std::fprintf(out, "PF\n%u %u\n-1.0\n", kWidth, kHeight);
        for (unsigned row = kHeight; row-- > 0;) // PFM stores rows from the bottom
            std::fwrite(&normals[row * kWidth], sizeof(Vec3), kWidth, out);
        std::fclose(out);
    }
}
