// The built-in surroundings, ready to light a scene.
#pragma once

#include <optional>
#include <string>

#include "cotan/environment/environment.hpp"

namespace cotan {

// The atlas of a built-in one, see environmentNames; nothing for another name. The studio as it is, not turned and not
// dimmed, was made while Cotan was built and is only read: to the byte what makeEnvironment makes of it, without the
// quarter of a second of processor that this takes. The others are made by the call.
std::optional<EnvironmentMap> builtinEnvironment(const std::string& name, const EnvironmentOptions& options = {});

} // namespace cotan
