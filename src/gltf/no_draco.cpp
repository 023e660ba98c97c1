// KHR_draco_mesh_compression where there is no Draco.
#include "core/not_built.hpp"
#include "gltf/draco.hpp"

namespace cotan {

Result<std::vector<DracoGeometry>> decodeDracoHere(const std::vector<DracoJob>&)
{
    return notBuiltWith("Draco", "libdraco-dev");
}

} // namespace cotan
