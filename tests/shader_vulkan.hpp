// The device that the parity test computes and draws on.
#pragma once

#include <string>

#include "devices.hpp"
#include "shader_cases.hpp"

namespace cotan::test {

// The values of cases on the first device that has what pricing needs: work(device, results) adds them. Without one,
// results say why they were skipped.
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
            work(device, results);
            return results;
        }
    } catch (const vk::SystemError& e) {
        results.skipped = cost::reason(e);
    }
    return results;
}

} // namespace cotan::test
