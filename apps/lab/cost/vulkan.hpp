// Includes vulkan.hpp as used here: RAII objects, loader opened at run time. It compiles slowly, so only files that
// talk to the device include it.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_raii.hpp>
