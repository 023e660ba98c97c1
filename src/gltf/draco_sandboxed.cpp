// Draco streams decoded in a process of their own.
#include "codes.hpp"
#include "draco_streams.hpp"
#include "files/sandbox/process.hpp"
#include "gltf/json/views.hpp"
#include "problem.hpp"

namespace cotan {

namespace {

// Whether an answer has the sizes that were asked for.
bool fits(const std::vector<DracoGeometry>& meshes, const std::vector<DracoJob>& jobs)
{
    if (meshes.size() != jobs.size())
        return false;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (meshes[i].indices.size() != jobs[i].indices * gltf::componentSize(jobs[i].indexType)
            || meshes[i].attributes.size() != jobs[i].attributes.size())
            return false;
        for (std::size_t k = 0; k < jobs[i].attributes.size(); ++k) {
            const DracoAttribute& a = jobs[i].attributes[k];
            if (meshes[i].attributes[k].size()
                != jobs[i].vertices * a.components * gltf::componentSize(a.componentType))
                return false;
        }
    }
    return true;
}

} // namespace

Result<std::vector<DracoGeometry>> decodeDraco(const std::vector<DracoJob>& jobs, const std::string& name,
                                               const LoadLimits& limits)
{
    if (limits.sandbox.program.empty())
        return gltf::decodeDracoHere(jobs);
    std::size_t bytes = 0;
    for (const DracoJob& job : jobs)
        bytes += job.bytes.size();
    auto process =
        ReaderProcess::start({.kind = ReaderKind::draco, .name = name, .fileBytes = bytes, .limits = limits});
    if (!process)
        return process.error();
    exchangeDracoJobs((*process)->question(), jobs);
    (*process)->question().flush(); // a failure shows in the answer
    if (Status found = (*process)->await(); !found)
        return found.error();
    std::vector<DracoGeometry> meshes;
    exchangeDracoGeometry((*process)->answer(), meshes);
    if ((*process)->answer().good() && !fits(meshes, jobs))
        (*process)->answer().refuse();
    if (!(*process)->answer().good())
        return (*process)->failure();
    return meshes;
}

} // namespace cotan
