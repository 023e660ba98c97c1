// Reads models through Assimp, with checks before, during and after.
#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <assimp/BaseImporter.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/defs.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "assimp_convert.hpp"
#include "core/locale_of_c.hpp"
#include "core/one_line.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "scene/scene_check.hpp"
#include "source_material.hpp"

// Debian's build of Assimp keeps its assertions, and a failed one ends the process. This replaces the library's
// function, so that a file that fails an assertion is refused like any other invalid file.
namespace Assimp {

ASSIMP_API void aiAssertViolation(const char* expression, const char* file, int line);

void aiAssertViolation(const char* expression, const char*, int)
{
    throw std::runtime_error(std::string("broken or unsupported model; expected ") + expression);
}

} // namespace Assimp

namespace cotan {

namespace fs = std::filesystem;

namespace {

// A model while it is read.
struct Job {
    fs::path file; // as passed
    const LoadLimits& limits;
    fs::path canonical{};
    fs::path folder{};       // canonical
    std::string extension{}; // lower case, with the dot
    std::vector<std::byte> bytes{};
    std::vector<std::string> outside{}; // requested files that were refused because they are outside the model's folder
    std::vector<std::string> tooLarge{}; // requested files that were refused because they exceed the size limit
    Scene scene{};
};

// ---- files -----------------------------------------------------------------------------------

class BytesStream : public Assimp::MemoryIOStream {
public:
    explicit BytesStream(std::vector<std::byte> bytes)
        : MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), bytes_(std::move(bytes))
    {
    }

private:
    std::vector<std::byte> bytes_; // moving keeps the address
};

void addOnce(std::vector<std::string>& list, const std::string& text)
{
    if (std::ranges::find(list, text) == list.end())
        list.push_back(text);
}

// Serves the model itself from the checked bytes in memory, since the file may have changed on disk, and other files
// from the model's folder only. Read-only.
class ModelFiles : public Assimp::IOSystem {
public:
    explicit ModelFiles(Job& job) : job_(job) {} // the job outlives this

    bool Exists(const char* file) const override { return file == job_.canonical || find(file); }
    char getOsSeparator() const override { return '/'; }
    void Close(Assimp::IOStream* stream) override { delete stream; }

    Assimp::IOStream* Open(const char* file, const char* mode) override
    {
        if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos)
            return nullptr;
        if (file == job_.canonical)
            return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(job_.bytes.data()),
                                              job_.bytes.size());
        const auto found = find(file);
        if (!found)
            return nullptr;
        std::error_code error;
        if (fs::file_size(*found, error) > job_.limits.fileBytes) {
            addOnce(job_.tooLarge, file);
            return nullptr;
        }
        auto bytes = readFileBytes(*found, job_.limits.fileBytes);
        return bytes ? new BytesStream(*std::move(bytes)) : nullptr;
    }

private:
    std::optional<fs::path> find(const char* file) const
    {
        bool outside = false;
        auto found = findInFolder(job_.folder, file, outside);
        if (outside)
            addOnce(job_.outside, file);
        return found;
    }

    Job& job_;
};

// ---- reading ---------------------------------------------------------------------------------

Status openModel(Job& job)
{
    COTAN_TRY(bytes, readFileBytes(job.file, job.limits.fileBytes));
    job.bytes = *std::move(bytes);
    std::error_code error;
    job.canonical = fs::canonical(job.file, error);
    if (error)
        failModel("{}", error.message());
    // Textures are beside the target of a link, but the name of the link determines the format.
    job.folder = job.canonical.parent_path();
    job.extension = lowerExtension(job.file);
    job.scene.name = job.file.filename().string();
    return Done{};
}

// Approximate number of bytes that the conversion allocates: two copies of each array.
std::size_t bytesToConvert(const aiScene& source)
{
    std::size_t bytes = 0;
    for (unsigned m = 0; m < source.mNumMeshes; ++m)
        bytes += 64 * std::size_t(source.mMeshes[m]->mNumVertices) + 128 * std::size_t(source.mMeshes[m]->mNumFaces);
    return bytes;
}

// Removes all readers but the one for this extension, so that Assimp does not guess the format by content.
bool keepOneReader(Assimp::Importer& importer, const std::string& extension)
{
    bool found = false;
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const std::string known = fmt::format(" {} ", importer.GetImporterInfo(i)->mFileExtensions);
        if (known.find(fmt::format(" {} ", extension.substr(1))) != std::string::npos) {
            found = true;
            continue;
        }
        Assimp::BaseImporter* other = importer.GetImporter(i);
        importer.UnregisterLoader(other);
        delete other;
    }
    return found;
}

const aiScene* import(Job& job, Assimp::Importer& importer)
{
    importer.SetIOHandler(new ModelFiles(job));
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    const LocaleOfC locale; // Assimp parses the extras of COLLADA by strtod
    return importer.ReadFile(job.canonical.string(), 0);
}

// Assimp's own steps trust the indices and assume that all counted arrays exist.
void checkIndices(const aiScene& source)
{
    constexpr double kMaxClippingCost = 5e9; // one polygon with 70,000 corners, one or two seconds in Assimp
    double clippingCost = 0;                 // sum of squared corner counts, proportional to the time of ear clipping
    for (unsigned m = 0; m < source.mNumMeshes; ++m) {
        const aiMesh& mesh = *source.mMeshes[m];
        const char* const name = mesh.mName.C_Str();
        if ((mesh.mNumVertices > 0 && !mesh.mVertices) || (mesh.mNumFaces > 0 && !mesh.mFaces))
            failModel("mesh {}: expected vertices ({}) and faces ({})", name, mesh.mNumVertices, mesh.mNumFaces);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices > 0 && !face.mIndices)
                failModel("mesh {}: face {}: expected {} indices, found none", name, f, face.mNumIndices);
            clippingCost += face.mNumIndices > 4 ? double(face.mNumIndices) * face.mNumIndices : 0;
            if (clippingCost > kMaxClippingCost)
                failModel("mesh {}: face {}: expected triangles, found {} corners", name, f, face.mNumIndices);
            for (unsigned i = 0; i < face.mNumIndices; ++i)
                if (face.mIndices[i] >= mesh.mNumVertices)
                    failModel("mesh {}: face {}: expected an index below {}, found {}", name, f, mesh.mNumVertices,
                              face.mIndices[i]);
        }
    }
}

// Assimp treats a face without corners as a polygon, and counts it out of bounds if the mesh has other primitive types.
void removeEmptyFaces(const aiScene& source, Job& job)
{
    for (unsigned m = 0; m < source.mNumMeshes; ++m) {
        aiMesh& mesh = *source.mMeshes[m];
        const unsigned all = mesh.mNumFaces;
        const auto empty = [](const aiFace& face) { return face.mNumIndices == 0; };
        mesh.mNumFaces = unsigned(std::remove_if(mesh.mFaces, mesh.mFaces + all, empty) - mesh.mFaces);
        if (mesh.mNumFaces == all)
            continue;
        mesh.mPrimitiveTypes = 0;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            mesh.mPrimitiveTypes |= AI_PRIMITIVE_TYPE_FOR_N_INDICES(mesh.mFaces[f].mNumIndices);
        job.scene.warnings.push_back(fmt::format("mesh {}: {} of {} faces have no corners; left out",
                                                 mesh.mName.C_Str(), all - mesh.mNumFaces, all));
    }
}

void checkCounts(const aiScene& source, const LoadLimits& limits)
{
    std::size_t vertices = 0, triangles = 0;
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        vertices += source.mMeshes[i]->mNumVertices;
        triangles += source.mMeshes[i]->mNumFaces;
    }
    // Each corner has a vertex of its own until equal vertices are merged, hence three times the limit.
    if (vertices / 3 > limits.vertices)
        failModel("over the limit of {} vertices", limits.vertices);
    if (triangles > limits.triangles)
        failModel("over the limit of {} triangles", limits.triangles);
}

std::optional<Result<std::span<const std::byte>>> embeddedImage(const aiScene& source, const std::string& path)
{
    const aiTexture* texture = source.GetEmbeddedTexture(path.c_str());
    if (!texture)
        return std::nullopt;
    if (!texture->pcData || texture->mWidth == 0)
        return inputError("the embedded texture is empty");
    if (texture->mHeight != 0) // 0: a whole image file of mWidth bytes, as in all formats read here
        return inputError("expected an embedded image file, found plain texels");
    return std::as_bytes(std::span(reinterpret_cast<const char*>(texture->pcData), texture->mWidth));
}

void convertMaterials(const aiScene& source, Job& job)
{
    TextureReader textures(job.scene, job.folder, job.limits,
                           [&](const std::string& path) { return embeddedImage(source, path); });
    for (unsigned i = 0; i < source.mNumMaterials; ++i)
        job.scene.materials.push_back(convertMaterial(*source.mMaterials[i], textures, job.scene));
}

// The material of meshes that name none.
int defaultMaterial(Scene& scene, int& cached)
{
    if (cached < 0) {
        cached = int(scene.materials.size());
        Material& material = scene.materials.emplace_back();
        material.name = "default";
        material.baseColor = {0.8f, 0.8f, 0.8f, 1};
        material.metallic = 0;
        material.roughness = 0.7f;
        material.doubleSided = true;
    }
    return cached;
}

std::vector<int> convertMeshes(const aiScene& source, Job& job)
{
    const bool regenerateNormals = job.extension == ".stl";
    std::vector<int> indexOf(source.mNumMeshes, -1);
    int fallback = -1;
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        Mesh mesh = convertMesh(*source.mMeshes[i], regenerateNormals, job.scene);
        if (mesh.indices.empty())
            continue;
        const unsigned material = source.mMeshes[i]->mMaterialIndex;
        mesh.material = material < source.mNumMaterials ? int(material) : defaultMaterial(job.scene, fallback);
        warnAboutTexcoords(mesh, job.scene);
        indexOf[i] = int(job.scene.meshes.size());
        job.scene.meshes.push_back(std::move(mesh));
    }
    return indexOf;
}

void warnAboutSource(const aiScene& source, Job& job)
{
    auto& warnings = job.scene.warnings;
    for (const std::string& file : job.outside)
        warnings.push_back(fmt::format("{} is outside the model's folder; not opened", file));
    for (const std::string& file : job.tooLarge)
        warnings.push_back(fmt::format("{} is over the limit of {} bytes; not opened", file, job.limits.fileBytes));
    if (source.mNumLights > 0)
        warnings.push_back(fmt::format("{} lights are ignored: this format defines no unit", source.mNumLights));
}

} // namespace

Result<Scene> loadWithAssimp(const fs::path& file, const LoadLimits& limits)
try {
    Job job{.file = file, .limits = limits};
    COTAN_CHECK(openModel(job));
    // Checks of the bytes that Assimp would trust.
    if (job.extension == ".ply")
        checkPly(job.bytes, job.limits);
    if (job.extension == ".dae")
        checkCollada(job.bytes);

    Assimp::Importer importer;
    if (!keepOneReader(importer, job.extension))
        failModel("no reader for the extension \"{}\"", job.extension);
    const aiScene* source = import(job, importer);
    if (!source || !source->mRootNode)
        failModel("expected a model that Assimp can read; it reports: {}", oneLine(importer.GetErrorString()));
    checkIndices(*source);
    removeEmptyFaces(*source, job);
    if (job.limits.expect)
        job.limits.expect(bytesToConvert(*source));
    source = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
    if (!source || source->mNumMeshes == 0)
        failModel("expected triangles, found none");
    checkCounts(*source, job.limits);

    warnAboutSource(*source, job);
    convertMaterials(*source, job);
    convertNodes(*source, convertMeshes(*source, job), job.limits, job.scene);
    if (job.scene.instances.empty())
        failModel("expected triangles, found none");
    COTAN_CHECK(checkScene(job.scene, file.string()));
    return std::move(job.scene);
} catch (const Error& problem) {
    return inputError(fmt::format("{}: {}", file.string(), problem.message));
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the model", file.string()));
} catch (const std::exception& e) {
    return inputError(fmt::format("{}: {}", file.string(), oneLine(e.what())));
} catch (...) {
    return inputError(fmt::format("{}: the reader failed", file.string()));
}

} // namespace cotan
