// EXT_meshopt_compression where there is no libmeshoptimizer.
#include "core/not_built.hpp"
#include "problem.hpp"
#include "unpack.hpp"

namespace cotan::gltf {

std::vector<std::byte> decodeMeshopt(const MeshoptView&, const std::string& field)
{
    throw GltfProblem{field + ": " + notBuiltWith("meshoptimizer", "libmeshoptimizer-dev").message,
                      ErrorKind::unavailable};
}

} // namespace cotan::gltf
