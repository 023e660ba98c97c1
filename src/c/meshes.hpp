// Meshes of cotan.h, looked at before they are used.
#pragma once

#include "call.hpp"

namespace cotan::c {

inline const cotan_mesh& checkedMesh(const cotan_mesh* given, const std::string& name, bool needsUv)
{
    const cotan_mesh& m = checked(given, name.c_str());
    if (m.vertex_count != 0 && !(m.positions && m.normals && (m.texcoords || !needsUv)))
        fail(ErrorKind::usage,
             name + ": expected positions, normals" + (needsUv ? " and texcoords" : "") + ", found null");
    if (m.index_count % 3 != 0)
        fail(ErrorKind::usage, name + ".index_count: expected a multiple of 3");
    if (m.index_count != 0 && !m.indices)
        fail(ErrorKind::usage, name + ".indices: expected an array, found null");
    for (std::size_t i = 0; i < m.index_count; ++i)
        if (m.indices[i] >= m.vertex_count)
            fail(ErrorKind::input,
                 name + ".indices[" + std::to_string(i) + "]: expected less than " + std::to_string(m.vertex_count)
                     + ", found " + std::to_string(m.indices[i]));
    return m;
}

} // namespace cotan::c
