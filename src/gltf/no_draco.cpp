// KHR_draco_mesh_compression in builds without Draco.
#include "core/not_built.hpp"
#include "gltf/draco.hpp"

namespace cotan {

Result<std::vector<DracoGeometry>> decodeDracoHere(const std::vector<DracoJob>&)
{
    return notBuiltWith("Draco", "libdraco-dev");
}

} // namespace cotan
