#include "compile.hpp"

namespace cotan::cost {

namespace {

using Flags = vk::ShaderStageFlagBits;

double number(const vk::PipelineExecutableStatisticKHR& s)
{
    using F = vk::PipelineExecutableStatisticFormatKHR;
    switch (s.format) {
    case F::eBool32: return s.value.b32 ? 1 : 0;
    case F::eInt64: return double(s.value.i64);
    case F::eUint64: return double(s.value.u64);
    case F::eFloat64: return s.value.f64;
    }
    return 0;
}

StageCode readStage(const Device& device, const vk::raii::Pipeline& pipeline, Flags stage)
{
    StageCode code;
    const auto executables = device.opened->device.getPipelineExecutablePropertiesKHR(vk::PipelineInfoKHR(*pipeline));
    for (std::uint32_t i = 0; i < executables.size(); ++i) {
        if (!(executables[i].stages & stage))
            continue;
        for (const auto& s : device.opened->device.getPipelineExecutableStatisticsKHR({*pipeline, i}))
            code.all.emplace_back(s.name.data(), number(s));
        break; // some drivers compile a stage for several widths and list the first one first
    }
    return code;
}

} // namespace

std::size_t stageCount(const std::vector<const Row*>& rows)
{
    return rows.size() + vertexStages().size() + otherStages().size();
}

StageCode& stageAt(DeviceCode& code, std::size_t k)
{
    if (k < code.rows.size())
        return code.rows[k].fragment;
    k -= code.rows.size();
    return k < code.vertices.size() ? code.vertices[k].vertex : code.others[k - code.vertices.size()].code;
}

void prepareStages(DeviceCode& code, const std::vector<const Row*>& rows)
{
    for (const Row* row : rows)
        code.rows.push_back({row->name, {}});
    for (const VertexStage& v : vertexStages())
        code.vertices.push_back({v.stored, {}});
    for (const Stage& s : otherStages())
        code.others.push_back({&s, {}});
}

StageCode compileStage(const Device& device, const Layout& layout, const std::vector<const Row*>& rows, std::size_t k)
{
    if (k < rows.size()) {
        const Row& row = *rows[k];
        return readStage(device,
                         makePipeline(device, layout, row.stored, vertexStage(row.stored).vertex, row.fragment, true),
                         Flags::eFragment);
    }
    k -= rows.size();
    if (k < vertexStages().size()) {
        const VertexStage& v = vertexStages()[k];
        return readStage(device, makePipeline(device, layout, v.stored, v.vertex, v.consumer, true), Flags::eVertex);
    }
    const Stage& s = otherStages()[k - vertexStages().size()];
    if (s.kind == StageKind::beyond)
        return readStage(
            device, makePipeline(device, layout, Stored::nothing, vertexStage(Stored::nothing).vertex, s.words, true),
            Flags::eFragment);
    if (s.kind != StageKind::mesh)
        return readStage(device, makePassPipeline(device, layout, s.words), Flags::eCompute);
    return device.meshShaders
        ? readStage(device, makeMeshPipeline(device, layout, s.words, s.consumer), Flags::eMeshEXT)
        : StageCode{};
}

} // namespace cotan::cost
