#include "cotan/tangents.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "corner_groups.hpp"
#include "mikktspace_triangles.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

namespace {

Error expected(const std::string& array, const std::string& what, std::size_t found)
{
    return usageError(array + ": expected " + what + ", found " + std::to_string(found));
}

// Why a mesh is not usable; none where it is.
std::optional<Error> problemOf(const MeshView& mesh)
{
    const std::size_t count = mesh.positions.size(), indices = mesh.indices.size();
    const std::string oneEach = "one a position (" + std::to_string(count) + ")";
    if (count >= tangents::kNone)
        return expected("positions", "less than 4294967295", count);
    if (mesh.normals.size() != count)
        return expected("normals", oneEach, mesh.normals.size());
    if (mesh.texcoords.size() != count)
        return expected("texcoords", oneEach, mesh.texcoords.size());
    if (indices % 3 != 0 || indices >= tangents::kNone)
        return expected("indices", "three a triangle, less than 4294967295", indices);
    const auto outside = std::find_if(mesh.indices.begin(), mesh.indices.end(), [&](auto i) { return i >= count; });
    if (outside != mesh.indices.end())
        return expected("indices[" + std::to_string(outside - mesh.indices.begin()) + "]",
                        "a number below " + std::to_string(count), *outside);
    return std::nullopt;
}

Listener listenerOf(const Progress& progress)
{
    if (!progress)
        return {};
    return {[](const void* who, double share) { return (*static_cast<const Progress*>(who))(share); }, &progress};
}

template<class Made, class Make> Result<Made> made(const MeshView& mesh, const Progress& progress, const Make& make)
{
    if (const auto problem = problemOf(mesh))
        return *problem;
    Made all;
    if (!make(listenerOf(progress), all))
        return stoppedError();
    return all;
}

} // namespace

Result<std::vector<glm::vec4>> mikktspaceTangents(const MeshView& mesh, int threads, const Progress& progress)
{
    return made<std::vector<glm::vec4>>(mesh, progress, [&](const Listener& listener, auto& all) {
        return mikktspace::makeTangents(mesh, threads, listener, all);
    });
}

Result<Cotangents> smoothCotangents(const MeshView& mesh, int threads, const Progress& progress)
{
    return made<Cotangents>(mesh, progress, [&](const Listener& listener, auto& all) {
        return tangents::averageCotangents(mesh, threads, listener, all);
    });
}

} // namespace cotan
