// Compiles one shader stage at a time on a device.
#pragma once

#include <vector>

#include "cost/machine_code.hpp"
#include "pipeline.hpp"

namespace cotan::cost {

// Number of stages compiled for a device. Stage indices run through the rows, then the vertex stages, then the others.
std::size_t stageCount(const std::vector<const Row*>& rows);

// Returns stage k of `code`, which prepareStages has filled.
StageCode& stageAt(DeviceCode& code, std::size_t k);

// Appends an empty, named entry for each stage.
void prepareStages(DeviceCode& code, const std::vector<const Row*>& rows);

// Compiles stage k and returns its statistics under the driver's names. Throws Vulkan's exceptions.
StageCode compileStage(const Device& device, const Layout& layout, const std::vector<const Row*>& rows, std::size_t k);

} // namespace cotan::cost
