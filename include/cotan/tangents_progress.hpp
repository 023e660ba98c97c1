// Tangents and cotangents of large meshes, with progress, a way to stop, and the reason where there are none.
#pragma once

#include "cotan/progress.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

// What mikktspaceTangents(mesh, threads) and smoothCotangents(mesh, threads) return, to the bit. progress is told from
// any of the threads, at least after each step (a hundred milliseconds for a million triangles) and after each 65536
// vertices of the last one.
// Errors: ErrorKind::usage with the array of MeshView, what was expected of it and what was found;
// ErrorKind::stopped where `progress` said so.
Result<std::vector<packed::vec4>> mikktspaceTangents(const MeshView& mesh, int threads, const Progress& progress);
Result<Cotangents> smoothCotangents(const MeshView& mesh, int threads, const Progress& progress);

} // namespace cotan
