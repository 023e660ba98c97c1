// Decompresses the geometry of a glTF file. Draco streams are decoded in a child process if LoadLimits requests it.
#include <algorithm>
#include <optional>
#include <set>

#include "core/one_line.hpp"
#include "elements.hpp"
#include "files/sandbox/reader_process.hpp"
#include "gltf/draco.hpp"
#include "gltf/json/lookup.hpp"
#include "gltf_file.hpp"

namespace cotan {

using gltf::Json;

namespace {

// Copies elements of `elementBytes` bytes so that each starts at a multiple of four.
std::vector<std::byte> padElements(const std::vector<std::byte>& packed, std::size_t elementBytes)
{
    std::vector<std::byte> out(packed.size() / elementBytes * gltf::aligned(elementBytes));
    for (std::size_t from = 0, to = 0; from < packed.size(); from += elementBytes, to += gltf::aligned(elementBytes))
        std::copy_n(packed.begin() + std::ptrdiff_t(from), elementBytes, out.begin() + std::ptrdiff_t(to));
    return out;
}

// Whether the decoded arrays have the requested sizes.
bool fits(const std::vector<DracoGeometry>& meshes, const std::vector<DracoJob>& jobs)
{
    return std::ranges::equal(meshes, jobs, [](const DracoGeometry& mesh, const DracoJob& job) {
        const auto sized = [&](const std::vector<std::byte>& values, const DracoAttribute& a) {
            return values.size() == job.vertices * a.components * gltf::componentSize(a.componentType);
        };
        return mesh.indices.size() == job.indices * gltf::componentSize(job.indexType)
            && std::ranges::equal(mesh.attributes, job.attributes, sized);
    });
}

// Decodes in this process or, if the limits name a program, in a child process.
Result<std::vector<DracoGeometry>> decodeDraco(const std::vector<DracoJob>& jobs, const LoadLimits& limits)
{
    if (limits.sandbox.program.empty())
        return decodeDracoHere(jobs);
    std::size_t bytes = 0;
    for (const DracoJob& job : jobs)
        bytes += job.bytes.size();
    auto process =
        ReaderProcess::start({.kind = ReaderKind::draco, .name = kDracoExtension, .fileBytes = bytes, .limits = limits},
                             [&](WireOut& question) { exchangeDracoJobs(question, jobs); });
    if (!process)
        return process.error();
    std::vector<DracoGeometry> meshes;
    exchangeDracoGeometry((*process)->answer(), meshes);
    if ((*process)->answer().good() && !fits(meshes, jobs))
        (*process)->answer().refuse();
    if (!(*process)->answer().good())
        return (*process)->failure();
    return meshes;
}

class Unpacker {
public:
    Unpacker(GltfFile& file, const LoadLimits& limits) : file_(file), limits_(limits) {}

    void run()
    {
        for (const char* const name : kMeshoptExtensions)
            unpackViews(name);
        readDracoJobs();
        unpackPrimitives();
        for (const char* const name : {kMeshoptExtensions[0], kMeshoptExtensions[1], kDracoExtension}) {
            const Json* const required = gltf::member(file_.json, "extensionsRequired");
            if (required && std::find(required->begin(), required->end(), name) != required->end())
                file_.packed.required.emplace_back(name);
            takeOffExtension(file_.json, name);
        }
    }

private:
    // Counts bytes before they are decoded. Values are below 2^60.
    void take(std::uint64_t bytes, const std::string& field)
    {
        takeBytes(file_.unpacked, bytes, limits_.geometryBytes + 64 * std::uint64_t(file_.size),
                  "decoded geometry takes", file_.size, field);
    }

    // Adds a buffer with these bytes; returns the JSON of a view of all of it.
    Json viewOf(std::vector<std::byte> bytes)
    {
        Json& buffers = file_.json["buffers"];
        const Json view = {{"buffer", buffers.size()}, {"byteLength", bytes.size()}};
        buffers.push_back({{"byteLength", bytes.size()}});
        file_.buffers.push_back(file_.unpackedBytes.emplace_back(std::move(bytes)));
        return view;
    }

    void unpackViews(const std::string& name)
    {
        const auto views = file_.json.find("bufferViews");
        for (std::size_t i = 0; views != file_.json.end() && i < views->size(); ++i) {
            Json& view = (*views)[i];
            const Json* const packed = gltf::extension(view, name);
            if (!packed)
                continue;
            if (isGltfFallback(file_.json["buffers"][view["buffer"].get<std::size_t>()]))
                unpackView(i, *packed, fmt::format("bufferViews[{}].extensions.{}", i, name));
            takeOut(view, "extensions", name);
        }
        if (const auto buffers = file_.json.find("buffers"); buffers != file_.json.end())
            for (Json& buffer : *buffers)
                takeOut(buffer, "extensions", name);
    }

    void unpackView(std::size_t index, const Json& packed, const std::string& field)
    {
        Json& view = file_.json["bufferViews"][index];
        const gltf::BufferView stored = gltf::readBufferView(packed); // has the same members as a view
        MeshoptView from{gltfViewBytes(file_, stored, field), packed["count"].get<std::size_t>(), stored.stride,
                         packed["mode"].get<std::string>(), gltf::valueOr(packed, "filter", std::string("NONE"))};
        const std::uint64_t decoded = std::uint64_t(from.count) * from.stride;
        if (decoded != view["byteLength"].get<std::uint64_t>())
            failGltf("{}: expected {} bytes, as the view has, found {} elements of {} bytes", field,
                     view["byteLength"].get<std::uint64_t>(), from.count, from.stride);
        take(decoded, field);
        file_.packed.views.emplace(index, view);
        const Json plain = viewOf(decodeMeshopt(from, field));
        view["buffer"] = plain["buffer"];
        view.erase("byteOffset");
    }

    // ---- Draco ----------------------------------------------------------------------------------------------------

    Json& accessor(int index) { return file_.json["accessors"][std::size_t(index)]; }

    // The decoding job of a primitive; nothing if the file has all its data uncompressed too.
    std::optional<DracoJob> jobOf(const Json& primitive, const Json& draco, const std::string& field)
    {
        DracoJob job{field + ".extensions." + kDracoExtension, {}, 0, 0, 0, {}};
        if (gltf::valueOr(primitive, "mode", gltf::kTriangles) != gltf::kTriangles)
            failGltf("{}: expected mode 4, triangles, found {}", job.field, primitive["mode"].get<int>());
        std::vector<int>& targets = targets_.emplace_back();
        bool plain = true;
        const auto add = [&](int target) {
            const gltf::Accessor a = gltf::readAccessor(accessor(target));
            if (a.sparse)
                failGltf("{}: accessors[{}] has sparse values, which compression forbids", job.field, target);
            plain = plain && a.view >= 0;
            targets.push_back(target);
            take(std::uint64_t(a.count) * gltf::elementSize(a), job.field);
            return a;
        };
        for (const auto& [name, id] : draco["attributes"].items()) {
            const int target = gltf::valueOr(primitive["attributes"], name, -1);
            if (target < 0 || !id.is_number_unsigned() || id.get<std::uint64_t>() > 0xffffffff)
                failGltf("{}.attributes.{}: expected the id of an attribute that the primitive has, found {}",
                         job.field, oneLine(name), oneLine(id.dump()));
            if (std::find(targets.begin(), targets.end(), target) != targets.end())
                continue; // several names for one accessor: the first determines the values
            const gltf::Accessor a = add(target);
            if (job.attributes.empty())
                job.vertices = a.count;
            else if (job.vertices != a.count)
                failGltf("{}.attributes.{}: expected {} elements, found {}", job.field, oneLine(name), job.vertices,
                         a.count);
            job.attributes.push_back(
                {id.get<std::uint32_t>(), a.componentType, std::uint32_t(gltf::componentCount(a.type))});
        }
        if (job.vertices == 0)
            failGltf("{}.attributes: expected at least one, with vertices", job.field);
        const int indices = gltf::valueOr(primitive, "indices", -1);
        if (indices < 0)
            failGltf("{}.indices: missing; required for compressed triangles", field);
        const gltf::Accessor a = add(indices);
        gltf::expectIndices(a, {indices, field + ".indices"});
        job.indices = a.count;
        job.indexType = a.componentType;
        if (plain)
            return std::nullopt;
        const gltf::BufferView view =
            gltf::readBufferView(file_.json["bufferViews"][draco["bufferView"].get<std::size_t>()]);
        const auto bytes = gltfViewBytes(file_, view, job.field);
        job.bytes.assign(bytes.begin(), bytes.end());
        return job;
    }

    void readDracoJobs()
    {
        const auto meshes = file_.json.find("meshes");
        for (std::size_t m = 0; meshes != file_.json.end() && m < meshes->size(); ++m)
            for (std::size_t p = 0; p < (*meshes)[m]["primitives"].size(); ++p) {
                Json& primitive = (*meshes)[m]["primitives"][p];
                const Json* const draco = gltf::extension(primitive, kDracoExtension);
                if (!draco)
                    continue;
                auto job = jobOf(primitive, *draco, primitiveField(m, p));
                if (job)
                    file_.packed.primitives.push_back(
                        {m, p, *draco, primitive["indices"].get<int>(), primitive["attributes"]});
                takeOut(primitive, "extensions", kDracoExtension);
                // Primitives may share a stream and its accessors.
                if (job && made_.insert(targets_.back()).second)
                    jobs_.push_back(std::move(*job));
                else
                    targets_.pop_back();
            }
    }

    void unpackPrimitives()
    {
        if (jobs_.empty())
            return;
        auto meshes = decodeDraco(jobs_, limits_);
        if (!meshes)
            throw GltfProblem{meshes.error()};
        std::set<int> filled;
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            std::vector<std::vector<std::byte>>& arrays = (*meshes)[i].attributes;
            arrays.push_back(std::move((*meshes)[i].indices));
            for (std::size_t k = 0; k < arrays.size(); ++k) {
                if (!filled.insert(targets_[i][k]).second)
                    failGltf("{}: accessors[{}] also belongs to another compressed primitive", jobs_[i].field,
                             targets_[i][k]);
                Json& target = accessor(targets_[i][k]);
                file_.packed.accessors.emplace(targets_[i][k], target);
                target["bufferView"] = file_.json["bufferViews"].size();
                target.erase("byteOffset");
                const std::size_t elementBytes = k + 1 < arrays.size() ? arrays[k].size() / jobs_[i].vertices : 4;
                Json view = viewOf(elementBytes % 4 == 0 ? std::move(arrays[k]) : padElements(arrays[k], elementBytes));
                if (elementBytes % 4 != 0)
                    view["byteStride"] = gltf::aligned(elementBytes);
                file_.json["bufferViews"].push_back(std::move(view));
                // Quantisation changes the bounds.
                const gltf::Accessor a = gltf::readAccessor(target);
                const std::vector<std::byte>& bytes = file_.unpackedBytes.back();
                if (a.count > 0)
                    gltf::renewBounds(target, {a, {bytes.data(), bytes.size() / a.count, a.count}, {}, {}});
            }
        }
    }

    GltfFile& file_;
    const LoadLimits& limits_;
    std::vector<DracoJob> jobs_;
    std::vector<std::vector<int>> targets_; // accessors of each job: attributes, then indices
    std::set<std::vector<int>> made_;       // accessor lists that have a job
};

} // namespace

void unpackGltf(GltfFile& file, const LoadLimits& limits) { Unpacker(file, limits).run(); }

} // namespace cotan
