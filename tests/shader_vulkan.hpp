// The device on which the parity tests compute and draw.
#pragma once

#include <string>

#include "devices.hpp"
#include "shader_cases.hpp"

namespace cotan::test {

// Runs work(device, results), which adds the values of cases, on the first device with all features that bench/gpu
// needs. Without such a device, results.skipped says why.
template<class Work> Results onFirstDevice(shader_text::Language language, const Work& work)
{
    Results results{std::string(shader_text::name(language)), "no Vulkan device", {}};
    try {
        const cost::Instance instance = cost::openInstance();
        for (cost::Device& device : cost::listDevices(instance)) {
            if (!device.missing.empty())
                continue;
            cost::open(device);
            results.skipped.clear();
            work(*device.opened, results);
            return results;
        }
    } catch (const vk::SystemError& e) {
        results.skipped = reason(e);
    }
    return results;
}

} // namespace cotan::test
