// Draws with the frame `triangle`, provided to the pixel stage in five ways, and with `smooth` in three:
// triangle_example WAY picture.ppm [normals.pfm] [sheets|teapot|MODEL]
// WAY: provoking, read, smooth, mesh, mesh-smooth, ring, visibility, visibility-read; derivatives for comparison.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <span>
#include <string>

#include <cotan/gpu_meshes.hpp>
#include <cotan/triangle.hpp>

#include "derivatives.frag.h"
#include "flat.frag.h"
#include "flat_mesh.frag.h"
#include "gpu.hpp"
#include "mesh.hpp"
#include "meshlet.mesh.h"
#include "meshlet_smooth.mesh.h"
#include "plain.vert.h"
#include "provoking.vert.h"
#include "read.frag.h"
#include "ring.comp.h"
#include "smooth.frag.h"
#include "smooth.vert.h"
#include "visibility.comp.h"
#include "visibility.frag.h"
#include "visibility_read.comp.h"

namespace {

constexpr vk::Extent2D kSize(480, 240);
constexpr std::size_t kPixels = kSize.width * kSize.height;

// The push constants of common.glsl.
struct Draw {
    std::uint64_t positions, normals, texcoords, corners, sources, packed, ids, result;
    std::uint64_t meshlets, meshletVertices, meshletTriangles, ringBegin, ring;
    std::uint32_t triangles, width = kSize.width, height = kSize.height, spare = 0;
};

struct Way {
    const char* name;
    std::vector<Stage> stages;
    bool meshShader = false;
    std::span<const std::uint32_t> resolve{}; // compute shader that resolves the visibility buffer
    bool ring = false; // uses meshlets with their rings; ring.comp computes the frames if there is no mesh shader
};

using S = vk::ShaderStageFlagBits;

const std::vector<Way>& ways()
{
    static const std::vector<Way> list = {
        {"provoking", {{S::eVertex, provoking_vert}, {S::eFragment, flat_frag}}},
        {"read", {{S::eVertex, plain_vert}, {S::eFragment, read_frag}}},
        {"smooth", {{S::eVertex, smooth_vert}, {S::eFragment, smooth_frag}}},
        {"mesh", {{S::eMeshEXT, meshlet_mesh}, {S::eFragment, flat_mesh_frag}}, true},
        {"mesh-smooth", {{S::eMeshEXT, meshlet_smooth_mesh}, {S::eFragment, smooth_frag}}, true, {}, true},
        {"ring", {{S::eVertex, smooth_vert}, {S::eFragment, smooth_frag}}, false, {}, true},
        {"visibility", {{S::eVertex, plain_vert}, {S::eFragment, visibility_frag}}, false, visibility_comp},
        {"visibility-read", {{S::eVertex, plain_vert}, {S::eFragment, visibility_frag}}, false, visibility_read_comp},
        {"derivatives", {{S::eVertex, plain_vert}, {S::eFragment, derivatives_frag}}},
    };
    return list;
}

// The buffers of a mesh on the device.
struct Prepared {
    Buffer positions, normals, texcoords, corners, sources, packed, indices;
    Buffer meshlets, meshletVertices, meshletTriangles, ringBegin, ring;
    std::uint32_t indexCount = 0, groups = 0; // groups: work groups of a mesh shader, one per meshlet
};

Prepared prepare(const Gpu& gpu, const Way& way, const Mesh& given)
{
    const std::string name = way.name;
    const Mesh mesh = name == "smooth" || way.ring ? splitAtMirrors(given) : given;
    const cotan::MeshView view{mesh.positions, mesh.normals, mesh.texcoords, mesh.indices};
    Prepared p;
    p.positions = makeBuffer(gpu, mesh.positions);
    p.normals = makeBuffer(gpu, mesh.normals);
    p.texcoords = makeBuffer(gpu, mesh.texcoords);
    p.corners = makeBuffer(gpu, mesh.indices);
    p.indices = makeBuffer(gpu, mesh.indices);
    p.sources = makeBuffer(gpu, nullptr, 0);
    p.packed = makeBuffer(gpu, nullptr, 0);
    p.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
    p.groups = (p.indexCount / 3 + 31) / 32; // meshlet.mesh draws 32 triangles per work group
    cotan::RingMeshlets cut;
    if (way.ring) {
        cut = cotan::ringMeshlets(view);
        p.groups = static_cast<std::uint32_t>(cut.meshlets.size());
        p.sources = makeBuffer(gpu, nullptr, mesh.positions.size() * 8);
        std::printf("meshlets: %zu of %zu triangles; %zu vertices, %.2f times as many as the mesh\n",
                    cut.meshlets.size(), cut.triangles.size(), cut.vertices.size(),
                    double(cut.vertices.size()) / double(mesh.positions.size()));
    }
    p.meshlets = makeBuffer(gpu, cut.meshlets);
    p.meshletVertices = makeBuffer(gpu, cut.vertices);
    p.meshletTriangles = makeBuffer(gpu, cut.triangles);
    p.ringBegin = makeBuffer(gpu, cut.ringBegin);
    p.ring = makeBuffer(gpu, cut.corners);
    if (name == "provoking") {
        const cotan::ProvokingMesh own =
            cotan::provokingMesh(mesh.indices, mesh.positions.size(), cotan::ProvokingVertex::first);
        p.corners = makeBuffer(gpu, own.corners);
        p.sources = makeBuffer(gpu, own.sources);
        p.indices = makeBuffer(gpu, own.indices);
        std::printf("vertices: %zu, and %zu with a provoking one for each of %zu triangles\n", mesh.positions.size(),
                    own.sources.size(), mesh.indices.size() / 3);
    } else if (name == "read" || name == "visibility-read") {
        p.packed = makeBuffer(gpu, cotan::packTriangles(cotan::triangleVectors(view)));
    } else if (name == "smooth") {
        p.sources = makeBuffer(gpu, cotan::packSmooth8(mesh.normals, cotan::smoothCotangents(view)));
    }
    return p;
}

void draw(const Gpu& gpu, const Way& way, const Mesh& mesh, std::vector<float>& pixels)
{
    const Prepared p = prepare(gpu, way, mesh);
    const bool visibility = !way.resolve.empty();
    const vk::Format format = visibility ? vk::Format::eR32Uint : vk::Format::eR32G32B32A32Sfloat;
    using U = vk::ImageUsageFlagBits;
    using A = vk::ImageAspectFlagBits;
    using L = vk::ImageLayout;
    const Target color = makeTarget(gpu, format, kSize, U::eColorAttachment | U::eTransferSrc, A::eColor);
    const Target depth = makeTarget(gpu, vk::Format::eD32Sfloat, kSize, U::eDepthStencilAttachment, A::eDepth);
    const Buffer ids = makeBuffer(gpu, nullptr, kPixels * 4), result = makeBuffer(gpu, nullptr, kPixels * 16);

    const vk::ShaderStageFlags everywhere = vk::ShaderStageFlagBits::eAll;
    const vk::PushConstantRange range(everywhere, 0, sizeof(Draw));
    const vk::raii::PipelineLayout layout(gpu.device, vk::PipelineLayoutCreateInfo({}, {}, range));
    const vk::raii::Pipeline pipeline = makePipeline(gpu, *layout, way.stages, format, kSize);
    vk::raii::Pipeline resolve{nullptr};
    if (visibility)
        resolve = makePipeline(gpu, *layout, std::array{Stage{S::eCompute, way.resolve}}, format, kSize);
    vk::raii::Pipeline derive{nullptr};
    if (way.ring && !way.meshShader)
        derive = makePipeline(gpu, *layout, std::array{Stage{S::eCompute, ring_comp}}, format, kSize);

    const Draw constants{p.positions.address,
                         p.normals.address,
                         p.texcoords.address,
                         p.corners.address,
                         p.sources.address,
                         p.packed.address,
                         ids.address,
                         result.address,
                         p.meshlets.address,
                         p.meshletVertices.address,
                         p.meshletTriangles.address,
                         p.ringBegin.address,
                         p.ring.address,
                         static_cast<std::uint32_t>(mesh.indices.size() / 3)};
    const vk::raii::CommandBuffers list(gpu.device, {*gpu.pool, vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = list.front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    commands.pushConstants<Draw>(*layout, everywhere, 0, constants);
    if (way.ring && !way.meshShader) {
        using P = vk::PipelineStageFlagBits2;
        const vk::MemoryBarrier2 made(P::eComputeShader, vk::AccessFlagBits2::eShaderStorageWrite, P::eVertexShader,
                                      vk::AccessFlagBits2::eShaderStorageRead);
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *derive);
        commands.dispatch(p.groups, 1, 1);
        commands.pipelineBarrier2(vk::DependencyInfo({}, made));
    }
    barrier(commands, *color.image, A::eColor, L::eUndefined, L::eColorAttachmentOptimal);
    barrier(commands, *depth.image, A::eDepth, L::eUndefined, L::eDepthAttachmentOptimal);
    const vk::RenderingAttachmentInfo colorInfo(*color.view, L::eColorAttachmentOptimal, {}, {}, {},
                                                vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore);
    const vk::RenderingAttachmentInfo depthInfo(*depth.view, L::eDepthAttachmentOptimal, {}, {}, {},
                                                vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eDontCare,
                                                vk::ClearDepthStencilValue(1, 0));
    commands.beginRendering(vk::RenderingInfo({}, vk::Rect2D({0, 0}, kSize), 1, 0, colorInfo, &depthInfo));
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
    if (way.meshShader) {
        commands.drawMeshTasksEXT(p.groups, 1, 1);
    } else {
        commands.bindIndexBuffer(*p.indices.buffer, 0, vk::IndexType::eUint32);
        commands.drawIndexed(p.indexCount, 1, 0, 0, 0);
    }
    commands.endRendering();
    barrier(commands, *color.image, A::eColor, L::eColorAttachmentOptimal, L::eTransferSrcOptimal);
    const vk::BufferImageCopy region(0, 0, 0, {A::eColor, 0, 0, 1}, {}, {kSize.width, kSize.height, 1});
    commands.copyImageToBuffer(*color.image, L::eTransferSrcOptimal, visibility ? *ids.buffer : *result.buffer, region);
    if (visibility) {
        using P = vk::PipelineStageFlagBits2;
        const vk::MemoryBarrier2 written(P::eTransfer, vk::AccessFlagBits2::eTransferWrite, P::eComputeShader,
                                         vk::AccessFlagBits2::eShaderStorageRead);
        commands.pipelineBarrier2(vk::DependencyInfo({}, written));
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *resolve);
        commands.dispatch((kSize.width + 7) / 8, (kSize.height + 7) / 8, 1);
    }
    commands.end();
    gpu.queue.submit(vk::SubmitInfo({}, {}, *commands));
    gpu.queue.waitIdle();
    pixels.resize(kPixels * 4);
    std::memcpy(pixels.data(), result.data, kPixels * 16);
}

bool write(const char* file, const float* pixels, bool picture)
{
    std::FILE* out = std::fopen(file, "wb");
    if (!out)
        return std::perror(file), false;
    std::fprintf(out, picture ? "P6\n%u %u\n255\n" : "PF\n%u %u\n-1.0\n", kSize.width, kSize.height);
    for (std::uint32_t row = 0; row < kSize.height; ++row)
        for (std::uint32_t column = 0; column < kSize.width; ++column) {
            const float* n = pixels
                + 4 * ((picture ? row : kSize.height - 1 - row) * kSize.width + column); // PFM starts at the bottom
            const float light = std::max(0.0f, -0.4264f * n[0] + 0.6396f * n[1] + 0.6396f * n[2]);
            const auto grey = static_cast<unsigned char>(n[3] > 0 ? 255 * std::pow(0.1f + 0.9f * light, 1 / 2.2f) : 34);
            const unsigned char rgb[3] = {grey, grey, grey};
            std::fwrite(picture ? static_cast<const void*>(rgb) : n, picture ? 1 : 4, 3, out);
        }
    return std::fclose(out) == 0;
}

} // namespace

int main(int count, char** words)
try {
    const Way* way = nullptr;
    for (const Way& w : ways())
        if (count > 2 && std::string(words[1]) == w.name)
            way = &w;
    if (!way)
        return std::fprintf(
                   stderr,
                   "usage: triangle_example provoking|read|smooth|mesh|mesh-smooth|ring|visibility|visibility-read|"
                   "derivatives picture.ppm [normals.pfm] [sheets|teapot|MODEL]\n"),
               1;
    const std::string what = count > 4 ? words[4] : "sheets";
    const Mesh mesh = what == "sheets" ? sheets() : what == "teapot" ? teapot() : model(what);
    const Gpu gpu = openGpu();
    if (way->meshShader && !gpu.meshShaders)
        return std::fprintf(stderr, "triangle_example: this device has no VK_EXT_mesh_shader\n"), 3;
    std::vector<float> pixels;
    draw(gpu, *way, mesh, pixels);
    return write(words[2], pixels.data(), true) && (count < 4 || write(words[3], pixels.data(), false)) ? 0 : 4;
} catch (const std::exception& e) {
    return std::fprintf(stderr, "triangle_example: %s\n", e.what()), 3;
}
