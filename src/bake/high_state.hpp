// What a HighSurface holds.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

#include "bake/high_surface.hpp"
#include "curved_normals.hpp"
#include "embree.hpp"

namespace cotan {

struct Part { // one instance, in world space
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint8_t> repeated; // one a triangle: not 0 where it lies on an earlier one; empty: none does
    std::vector<std::uint32_t> seen;    // indices as rays see them, where some are left out
    std::vector<ShapeOperator> shapes;  // of the vertices; empty: not prepared
    float front = 1; // -1: most of the triangles are wound against their vertices' normals, which count
};

struct HighSurface::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<Part> parts;
    std::vector<std::string> names;
    std::size_t triangles = 0;
    glm::vec3 low{1e30f}, high{-1e30f};
    std::vector<float> fronts; // Part::front of each

    ~State()
    {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }

    // The interpolated normals of hits, of any length. Where the corners are is asked for all before the first is used,
    // so that the waits for memory overlap.
    void interpolateNormals(std::size_t count, Hits& hits) const
    {
        Lanes<const std::uint32_t*> corners;
        Lanes<const glm::vec3*> normals;
        for (std::size_t i = 0; i < count; ++i) {
            const Part& part = parts[hits.found(i) ? hits.instance[i] : 0];
            corners[i] = &part.indices[hits.found(i) ? 3 * std::size_t(hits.triangle[i]) : 0];
            normals[i] = part.normals.data();
            __builtin_prefetch(corners[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const float b1 = hits.b1[i], b2 = hits.b2[i];
            const std::uint32_t* c = corners[i];
            const glm::vec3* n = normals[i];
            hits.normal.set(i, n[c[0]] * (1 - b1 - b2) + n[c[1]] * b1 + n[c[2]] * b2);
        }
    }
    // Zero where there is none.
    glm::vec3 curvedNormal(std::uint32_t instance, std::uint32_t triangle, float b1, float b2,
                           glm::vec3 direction) const
    {
        const Part& part = parts[instance];
        if (part.shapes.empty())
            return glm::vec3(0);
        CurvedTriangle corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = part.indices[3 * std::size_t(triangle) + i];
            corners.positions[i] = part.positions[v];
            corners.normals[i] = part.normals[v];
            corners.shapes[i] = part.shapes[v];
        }
        return cotan::curvedNormal(corners, b1, b2, direction);
    }
    // The normals of hits that are complete otherwise.
    void findNormals(const Probes& probes, HighNormals normals, Hits& hits) const
    {
        if (normals != HighNormals::face)
            interpolateNormals(probes.count, hits);
        // Longer than this, the interpolated normal counts.
        const float least = normals == HighNormals::face ? std::numeric_limits<float>::infinity() : 1e-6f;
        // All lanes, so that they go side by side: nobody reads those where nothing was found.
        for (std::size_t i = 0; i < kLanes; ++i) {
            const glm::vec3 n = hits.normal.at(i), face = glm::normalize(hits.face.at(i));
            const float length = glm::length(n);
            hits.normal.set(i, length > least ? n / length : face);
        }
        if (normals == HighNormals::curved)
            for (std::size_t i = 0; i < probes.count; ++i)
                if (hits.found(i)) {
                    const glm::vec3 n = curvedNormal(hits.instance[i], hits.triangle[i], hits.b1[i], hits.b2[i],
                                                     probes.direction.at(i));
                    if (glm::dot(n, n) > 0)
                        hits.normal.set(i, n);
                }
    }

    // Rays see the first of triangles that lie on one another: repeated ones get corners that are not finite, which
    // Embree leaves out, so that the others keep their numbers.
    void leaveOutRepeated(Part& part)
    {
        part.seen = part.indices;
        for (std::size_t f = 0; f < part.repeated.size(); ++f)
            if (part.repeated[f])
                std::fill_n(part.seen.begin() + std::ptrdiff_t(3 * f), 3, std::uint32_t(part.positions.size()));
        part.positions.emplace_back(std::numeric_limits<float>::quiet_NaN());
    }

    void attach(Part& part)
    {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at every vertex: one more at the end is needed.
        if (!part.repeated.empty())
            leaveOutRepeated(part);
        const std::vector<std::uint32_t>& indices = part.repeated.empty() ? part.indices : part.seen;
        part.positions.emplace_back(0.0f);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, part.positions.data(), 0,
                                   sizeof(glm::vec3), part.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                                   3 * sizeof(std::uint32_t), indices.size() / 3);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry); // ids count up from 0
        rtcReleaseGeometry(geometry);
    }
};

} // namespace cotan
