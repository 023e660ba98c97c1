// The Assimp reader in builds without Assimp.
#include "core/not_built.hpp"
#include "cotan/model.hpp"

namespace cotan {

Result<Scene> loadWithAssimp(const std::filesystem::path& file, const LoadLimits&)
{
    Error error = notBuiltWith("Assimp", "libassimp-dev");
    error.message = file.string() + ": " + error.message + "; or convert the file to glTF or OBJ";
    return error;
}

} // namespace cotan
