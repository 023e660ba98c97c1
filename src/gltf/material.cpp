#include "gltf_model.hpp"

#include <algorithm>
#include <atomic>

#include "core/loops.hpp"
#include "core/one_line.hpp"
#include "cotan/image.hpp"
#include "files/bytes.hpp"
#include "image/component_types.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

struct ImageSource {
    std::string name; // for messages and Image::name
    GltfResource resource;
    std::span<const std::byte> bytes; // empty where the image is a file
};

std::string imageField(int image) { return fmt::format("images[{}]", image); }

const gltf::Image& imageAt(const GltfModel& model, int image) { return model.structure.images[std::size_t(image)]; }

ImageSource findImage(const GltfModel& model, int image, bool mayMiss = false)
{
    const gltf::Image& entry = imageAt(model, image);
    const std::string field = imageField(image);
    ImageSource source;
    source.name = oneLine(entry.name);
    if (entry.uri.has_value() == (entry.view >= 0))
        failGltf("{}: expected either uri or bufferView", field);
    if (entry.view >= 0) {
        source.bytes = model.views[std::size_t(entry.view)].bytes;
    } else {
        source.resource = resolveGltfUri(model.file, *entry.uri, field + ".uri", mayMiss);
        source.bytes = source.resource.bytes;
        if (!source.resource.file.empty() && !entry.named)
            source.name = source.resource.file.filename().string();
    }
    if (source.name.empty())
        source.name = fmt::format("image {}", image);
    return source;
}

// Decodes an image in one of the formats that glTF and its extensions allow; models cannot make the image library's
// many other decoders run. foreign: set to the format of an image that is left without pixels.
Image decode(const GltfFile& model, ImageSource source, const LoadLimits& limits, std::string& foreign)
{
    if (!source.resource.file.empty())
        source.bytes = source.resource.bytes = valueOrFail(readGltfResource(model, source.resource.file, limits));
    if (limits.pixels != Pixels::all)
        foreign = unreadableFormat(source.bytes, limits);
    if (!foreign.empty()) {
        Image image;
        image.name = fmt::format("{} ({})", source.name, foreign);
        return image;
    }
    if (imageFormatName(source.bytes).empty())
        failGltf("expected PNG or JPEG data in {}", source.name);
    Result<Image> image = decodeImage(source.bytes, source.name, limits);
    if (!image)
        throw GltfProblem{image.error()};
    return std::move(*image);
}

// Subtracts the bytes of an image from `left`, the rest of the budget `all` for the images of one model. Images decoded
// at the same time see the same rest, so memory may exceed the budget by one image per thread before this throws.
void takeFrom(std::atomic<std::size_t>& left, std::size_t bytes, std::size_t all)
{
    std::size_t rest = left.load();
    do {
        if (bytes > rest)
            throw GltfProblem{
                memoryError(fmt::format("all images together take more than the limit of {} bytes", all))};
    } while (!left.compare_exchange_weak(rest, rest - bytes));
}

// Checks an image as far as possible without decoding it. Throws GltfProblem.
void checkUndecodedImage(const GltfModel& model, int image, bool used)
{
    // Signature, chunk length and type, 13 bytes of IHDR, checksum.
    constexpr std::size_t kPngHeader = 33;
    ImageSource source = findImage(model, image, /*mayMiss*/ true);
    if (!source.resource.file.empty()) {
        if (model.file.readFile)
            return; // nothing is fetched only for a check
        std::error_code error;
        const std::uintmax_t size = fs::file_size(source.resource.file, error);
        if (error || size == 0 || size >= kPngHeader)
            return;
        source.bytes = source.resource.bytes =
            valueOrFail(readGltfResource(model.file, source.resource.file, model.limits));
    }
    if (isPng(source.bytes) && source.bytes.size() < kPngHeader)
        failGltf("{}: the PNG {} ends within its header", imageField(image), source.name);
    if (used && !source.bytes.empty() && imageFormatName(source.bytes).empty())
        failGltf("{}: expected PNG or JPEG data in {}", imageField(image), source.name);
}

} // namespace

Texture GltfMaterials::texture(const gltf::TextureUse& use, const Mesh& mesh, const std::string& field)
{
    Texture texture;
    if (use.texture < 0)
        return texture;
    const gltf::Texture& source = model_.structure.textures[std::size_t(use.texture)];
    // the texture's own image, or an extension's image in a format that is not read here
    const int image = source.image >= 0 || model_.limits.pixels == Pixels::all ? source.image : source.foreign;
    if (image < 0) {
        model_.warnings.add(fmt::format("textures[{}]", use.texture), "no PNG or JPEG image; the texture is ignored");
        return texture;
    }
    const int set = use.texcoord;
    if (set < 0 || set > 1 || mesh.texcoords[std::size_t(set)].empty()) {
        model_.warnings.add(
            field,
            fmt::format("requires TEXCOORD_{}, which a mesh with this material lacks; it is ignored there", set));
        return texture;
    }
    texture.texcoord = set;
    if (source.sampler >= 0)
        texture.sampler = model_.structure.samplers[std::size_t(source.sampler)];
    texture.uRow = use.uRow;
    texture.vRow = use.vRow;
    const auto [slot, isNew] = slots_.emplace(firstEqual(image), int(scene_.images.size()));
    if (isNew)
        scene_.images.emplace_back();
    texture.image = slot->second;
    return texture;
}

std::optional<Frame> gltfFrame(const std::string& text, const std::string& field, GltfWarnings& warnings)
{
    const std::optional<Frame> frame = frameFromName(text);
    if (!frame && !text.empty())
        warnings.add(fmt::format("{}.extras.{}", field, gltf::kFrameExtra),
                     fmt::format("expected the name of a frame, found '{}'; ignored", oneLine(text)));
    return frame;
}

Material GltfMaterials::make(int index, const Mesh& mesh)
{
    if (index < 0)
        return {};
    const gltf::Json& source = (*materials_)[std::size_t(index)];
    const std::optional<Frame> frame =
        gltfFrame(gltf::frameText(source), fmt::format("materials[{}]", index), model_.warnings);
    Material material = gltf::readMaterial(source, [&](const gltf::Json& owner, const char* slot) {
        return texture(gltf::readTextureUse(gltf::member(owner, slot)), mesh,
                       fmt::format("materials[{}].{}", index, slot));
    });
    material.normalFrame = frame;
    return material;
}

int GltfMaterials::use(int material, const Mesh& mesh)
{
    const int sets = (mesh.texcoords[0].empty() ? 0 : 1) + (mesh.texcoords[1].empty() ? 0 : 2);
    const auto [made, isNew] = made_.try_emplace({material, material < 0 ? 0 : sets}, int(scene_.materials.size()));
    if (isNew)
        scene_.materials.push_back(make(material, mesh));
    return made->second;
}

// ---- images ---------------------------------------------------------------------------------

// Size of the model, its buffers and the image files beside it.
std::uint64_t GltfMaterials::bytesOfFiles() const
{
    std::uint64_t bytes = model_.file.size;
    for (const auto& [image, slot] : slots_) {
        const gltf::Image& entry = imageAt(model_, image);
        if (!entry.uri || entry.uri->starts_with("data:") || model_.file.readFile)
            continue;
        bool outside = false;
        std::error_code error;
        if (const auto file = findInFolder(model_.file.folder, decodePercent(*entry.uri), outside))
            if (const std::uintmax_t size = fs::file_size(*file, error); !error)
                bytes += size;
    }
    return bytes;
}

// The first image whose view has the same bytes. Images with a URI are not compared.
int GltfMaterials::firstEqual(int image)
{
    const gltf::Image& entry = imageAt(model_, image);
    if (entry.uri || entry.view < 0)
        return image;
    const std::span<const std::byte> bytes = model_.views[std::size_t(entry.view)].bytes;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto [known, isNew] = imagesAt_.try_emplace({text.data(), text.size()}, image);
    if (isNew)
        known->second = imagesLike_.try_emplace({text.size(), text}, image).first->second;
    return known->second;
}

std::vector<std::pair<int, int>> GltfMaterials::imagesToDecode() const
{
    if (model_.limits.pixels == Pixels::none)
        return {};
    std::vector<std::pair<int, int>> jobs(slots_.begin(), slots_.end());
    if (model_.limits.pixels == Pixels::normalMaps)
        std::erase_if(jobs, [&](const auto& job) {
            return std::ranges::none_of(scene_.materials, [&](const Material& m) {
                return m.normalMap.image == job.second || m.coat.normalMap.image == job.second;
            });
        });
    return jobs;
}

void GltfMaterials::decodeImages()
{
    const std::vector<std::pair<int, int>> jobs = imagesToDecode();
    std::vector<GltfProblem> problems(jobs.size());
    std::vector<std::string> foreign(jobs.size());
    const std::size_t all = imageBudget(model_.limits, bytesOfFiles());
    std::atomic<std::size_t> left = all;
    const auto decodeOne = [&](std::size_t i) {
        const auto [image, slot] = jobs[i];
        try {
            LoadLimits limits = model_.limits;
            limits.imageBytes = std::min(limits.imageBytes, left.load());
            Image decoded = decode(model_.file, findImage(model_, image), limits, foreign[i]);
            takeFrom(left, decoded.data.size(), all);
            scene_.images[std::size_t(slot)] = std::move(decoded);
        } catch (const GltfProblem& problem) {
            problems[i] = {reworded(problem.error, imageField(image) + ": " + problem.error.message)};
        }
    };
    // Callbacks may not be thread-safe.
    const bool noCallbacks = !model_.limits.decode && !model_.file.readFile;
    withThreads(noCallbacks ? 0 : 1, [&] { parallelFor(std::size_t(0), jobs.size(), decodeOne); });
    for (const GltfProblem& problem : problems) // the first in the file, whichever failed first
        if (!problem.error.message.empty())
            throw problem;
    for (const Material& material : scene_.materials)
        if (material.normalMap.image >= 0)
            completeNormals(scene_.images[std::size_t(material.normalMap.image)]);
    for (std::size_t i = 0; i < jobs.size(); ++i)
        if (!foreign[i].empty() && model_.limits.pixels != Pixels::normalMaps) // else the caller reports them
            model_.warnings.add(imageField(jobs[i].first), fmt::format("{} is not supported", foreign[i]));
}

void GltfMaterials::checkOtherImages() const
{
    const std::vector<std::pair<int, int>> decoded = imagesToDecode();
    for (int i = 0; i < int(model_.structure.images.size()); ++i) {
        if (std::ranges::find(decoded, i, &std::pair<int, int>::first) != decoded.end())
            continue;
        const bool used = slots_.contains(i);
        try {
            checkUndecodedImage(model_, i, used);
        } catch (const GltfProblem& problem) {
            if (used || scene_.instances.empty()) // or the model consists of images only
                throw;
            model_.warnings.add(problem.error.message, "this unused image is ignored");
        }
    }
}

} // namespace cotan
