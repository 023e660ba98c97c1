// vulkan.hpp in the form used here: objects own themselves, no linked loader. It compiles slowly;
// only the files that talk to the device include it.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_raii.hpp>
