// Meshes compressed with Draco, decoded in this process or, where LoadLimits::sandbox names a program, in its own: the
// decoder takes memory by numbers of the stream that nothing in front of it can check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// One attribute as it is wanted.
struct DracoAttribute {
    std::uint32_t id = 0;           // the unique id in the stream
    std::int32_t componentType = 0; // glTF's number of what the values shall be
    std::uint32_t components = 0;   // 1 to 16
};

// A stream, and what it has to hold.
struct DracoJob {
    std::string field; // for messages
    std::vector<std::byte> bytes;
    std::uint64_t vertices = 0, indices = 0;
    std::int32_t indexType = 0; // glTF's number
    std::vector<DracoAttribute> attributes;
};

struct DracoGeometry {
    std::vector<std::byte> indices;
    std::vector<std::vector<std::byte>> attributes; // packed, in the order of the job
};

// In this process. Errors: ErrorKind::input for streams that are damaged or hold something else; ErrorKind::unavailable
// where this build lacks Draco.
Result<std::vector<DracoGeometry>> decodeDracoHere(const std::vector<DracoJob>& jobs);

// What the two processes say to each other.
template<class W, class T> void exchangeDracoJobs(W& w, T& jobs)
{
    w.list(jobs, [](auto& wire, auto& job) {
        wire.array(job.field);
        wire.array(job.bytes);
        wire.number(job.vertices);
        wire.number(job.indices);
        wire.number(job.indexType);
        wire.array(job.attributes);
    });
}

template<class W, class T> void exchangeDracoGeometry(W& w, T& meshes)
{
    w.list(meshes, [](auto& wire, auto& mesh) {
        wire.array(mesh.indices);
        wire.list(mesh.attributes, [](auto& inner, auto& values) { inner.array(values); });
    });
}

} // namespace cotan
