// What is wrong with the normal maps of a scene as files.
#pragma once

#include <string>
#include <vector>

#include "cotan/scene/scene.hpp"

namespace cotan {

// A sentence for each normal map that was saved as a colour, has channels exchanged or is broken otherwise, by name,
// with the command that mends it; green that points down where it is declared up counts, too. Empty where all are good.
// Each map is looked at once: a second for 4096 x 4096 texels.
std::vector<std::string> mapFaults(const Scene& scene);

} // namespace cotan
