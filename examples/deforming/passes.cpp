#include "passes.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include <glm/packing.hpp>

#include "normals.comp.h"
#include "smooth.comp.h"
#include "tangents.comp.h"
#include "triangles.comp.h"

namespace {

// The push constants of common.glsl.
struct Derive {
    std::uint64_t positions, normals, texcoords, indices, vertexBegin, vertices, cornerBegin, corners, frames,
        triangles;
    std::uint32_t count, firstMirrored;
};

constexpr std::uint32_t kGroupSize = 64;
constexpr std::uint32_t kMaxInARow = 65535; // the minimum that Vulkan guarantees

} // namespace

Passes::Groups Passes::upload(const Gpu& gpu, const cotan::Adjacency& a)
{
    return {a.groups(),
            a.firstMirrored,
            makeBuffer(gpu, a.vertexBegin),
            makeBuffer(gpu, a.vertices),
            makeBuffer(gpu, a.cornerBegin),
            makeBuffer(gpu, a.corners)};
}

Passes::Passes(const Gpu& gpu, const Mesh& rest, const cotan::Adjacency& adjacency,
               const cotan::Adjacency& normalAdjacency)
    : gpu_(gpu), vertexCount_(rest.positions.size()), triangleCount_(rest.indices.size() / 3),
      frameGroups_(upload(gpu, adjacency)), normalGroups_(upload(gpu, normalAdjacency)),
      positions_(makeBuffer(gpu, rest.positions)), normals_(makeBuffer(gpu, rest.normals)),
      texcoords_(makeBuffer(gpu, rest.texcoords)), indices_(makeBuffer(gpu, rest.indices)),
      frames_(makeBuffer(gpu, nullptr, 8 * vertexCount_)), triangles_(makeBuffer(gpu, nullptr, 12 * triangleCount_))
{
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, sizeof(Derive));
    layout_ = vk::raii::PipelineLayout(gpu.device, vk::PipelineLayoutCreateInfo({}, {}, range));
    times_ = vk::raii::QueryPool(gpu.device, {{}, vk::QueryType::eTimestamp, 2});
    using Code = std::span<const std::uint32_t>;
    for (const Code code : {Code(normals_comp), Code(smooth_comp), Code(tangents_comp), Code(triangles_comp)})
        pipelines_.push_back(
            makePipeline(gpu, *layout_, std::array{Stage{vk::ShaderStageFlagBits::eCompute, code}}, {}, {}));
}

void Passes::pose(const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals)
{
    std::memcpy(positions_.data, positions.data(), positions.size() * sizeof(glm::vec3));
    std::memcpy(normals_.data, normals.data(), normals.size() * sizeof(glm::vec3));
}

double Passes::run(Pass pass)
{
    const Groups& groups = pass == Pass::normals ? normalGroups_ : frameGroups_;
    const auto count = pass == Pass::triangles ? static_cast<std::uint32_t>(triangleCount_) : groups.count;
    const Derive constants{positions_.address,
                           normals_.address,
                           texcoords_.address,
                           indices_.address,
                           groups.vertexBegin.address,
                           groups.vertices.address,
                           groups.cornerBegin.address,
                           groups.corners.address,
                           frames_.address,
                           triangles_.address,
                           count,
                           groups.firstMirrored};
    const vk::raii::CommandBuffers list(gpu_.device, {*gpu_.pool, vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = list.front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    commands.pushConstants<Derive>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, constants);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipelines_[static_cast<std::size_t>(pass)]);
    const std::uint32_t workGroups = (count + kGroupSize - 1) / kGroupSize,
                        row = std::clamp(workGroups, 1u, kMaxInARow);
    commands.resetQueryPool(*times_, 0, 2);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *times_, 0);
    commands.dispatch(row, (workGroups + row - 1) / row, 1);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *times_, 1);
    // An application needs a barrier to the vertex or fragment stage that reads the result instead.
    const vk::MemoryBarrier2 written(vk::PipelineStageFlagBits2::eComputeShader,
                                     vk::AccessFlagBits2::eShaderStorageWrite, vk::PipelineStageFlagBits2::eHost,
                                     vk::AccessFlagBits2::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, written));
    commands.end();
    gpu_.queue.submit(vk::SubmitInfo({}, {}, *commands));
    gpu_.queue.waitIdle();
    if (gpu_.physical.getQueueFamilyProperties()[0].timestampValidBits == 0)
        return std::numeric_limits<double>::quiet_NaN();
    [[maybe_unused]] const auto [result, ticks] =
        times_.getResults<std::uint64_t>(0, 2, 16, 8, vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    return double(ticks[1] - ticks[0]) * double(gpu_.physical.getProperties().limits.timestampPeriod) * 1e-6;
}

std::vector<glm::vec3> Passes::normals() const
{
    std::vector<glm::vec3> out(vertexCount_);
    std::memcpy(out.data(), normals_.data, out.size() * sizeof(out[0]));
    return out;
}

std::vector<glm::vec4> Passes::frames() const
{
    std::vector<std::uint32_t> words(2 * vertexCount_);
    std::memcpy(words.data(), frames_.data, words.size() * sizeof(words[0])); // one copy: reads can be slow
    std::vector<glm::vec4> out;
    for (std::size_t v = 0; v < vertexCount_; ++v) {
        const glm::vec2 low = glm::unpackSnorm2x16(words[2 * v]), high = glm::unpackSnorm2x16(words[2 * v + 1]);
        out.emplace_back(low.x, low.y, high.x, high.y);
    }
    return out;
}

std::vector<std::array<std::uint32_t, 3>> Passes::triangles() const
{
    std::vector<std::array<std::uint32_t, 3>> out(triangleCount_);
    std::memcpy(out.data(), triangles_.data, out.size() * sizeof(out[0]));
    return out;
}
