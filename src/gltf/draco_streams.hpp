// Draco's decoder itself, or its absence.
#pragma once

#include "gltf/draco.hpp"

namespace cotan::gltf {

// In this process.
Result<std::vector<DracoGeometry>> decodeDracoHere(const std::vector<DracoJob>& jobs);

} // namespace cotan::gltf
