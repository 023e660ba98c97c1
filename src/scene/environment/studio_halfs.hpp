// The studio's atlas as the program holds it.
#pragma once

#include <cstddef>

#include "cotan/view.hpp"
#include "scene/environment_map.hpp"

namespace cotan::environment {

inline constexpr int kChannels = 3;
inline constexpr std::size_t kStudioHalfs =
    std::size_t(kChannels) * COTAN_ENVIRONMENT_WIDTH * COTAN_ENVIRONMENT_HEIGHT; // rows first

inline EnvironmentMap makeBuiltin(const std::string& name, const Radiance& radiance, const EnvironmentOptions& options)
{
    EnvironmentMap map = makeEnvironment(radiance, 1, options);
    map.name = name;
    return map;
}

} // namespace cotan::environment
