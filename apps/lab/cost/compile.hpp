// Compiles one stage after another on one device.
#pragma once

#include <vector>

#include "cost/machine_code.hpp"
#include "pipeline.hpp"

namespace cotan::cost {

// All stages that a device is asked for, in one order: rows, then vertex stages, then the others.
std::size_t stageCount(const std::vector<const Row*>& rows);

// The place of stage k in `code`, whose vectors are as long as they will be.
StageCode& stageAt(DeviceCode& code, std::size_t k);

// Empty vectors of all stages, named.
void prepareStages(DeviceCode& code, const std::vector<const Row*>& rows);

// Compiles stage k and asks for its numbers, by the driver's names. Throws what Vulkan throws.
StageCode compileStage(const Device& device, const Layout& layout, const std::vector<const Row*>& rows, std::size_t k);

} // namespace cotan::cost
