// EXT_meshopt_compression in builds without libmeshoptimizer.
#include "core/not_built.hpp"
#include "gltf_file.hpp"

namespace cotan {

std::vector<std::byte> decodeMeshopt(const MeshoptView&, const std::string& field)
{
    const Error missing = notBuiltWith("meshoptimizer", "libmeshoptimizer-dev");
    throw GltfProblem{reworded(missing, field + ": " + missing.message)};
}

} // namespace cotan
