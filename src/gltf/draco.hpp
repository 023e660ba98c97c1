// Decodes Draco meshes in this process or, if LoadLimits::sandbox names a program, in a child process: the decoder
// allocates memory by numbers of the stream that cannot be checked beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// One requested attribute.
struct DracoAttribute {
    std::uint32_t id = 0;           // the unique id in the stream
    std::int32_t componentType = 0; // glTF component type of the output
    std::uint32_t components = 0;   // 1 to 16
};

// A stream with its expected content.
struct DracoJob {
    std::string field; // for messages
    std::vector<std::byte> bytes;
    std::uint64_t vertices = 0, indices = 0;
    std::int32_t indexType = 0; // glTF component type
    std::vector<DracoAttribute> attributes;
};

struct DracoGeometry {
    std::vector<std::byte> indices;
    std::vector<std::vector<std::byte>> attributes; // tightly packed, in the order of the job
};

// Decodes in this process. Errors: ErrorKind::input for streams that are damaged or have other content;
// ErrorKind::unavailable if this build lacks Draco.
Result<std::vector<DracoGeometry>> decodeDracoHere(const std::vector<DracoJob>& jobs);

// The wire format between the two processes.
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
