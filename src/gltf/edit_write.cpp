// Writes a document as .glb with everything inside, or as .gltf with .bin and images beside it.
#include <algorithm>
#include <limits>
#include <map>
#include <new>
#include <numeric>
#include <set>
#include <system_error>

#include "core/file_names.hpp"
#include "core/named_values.hpp"
#include "core/one_line.hpp"
#include "core/try.hpp"
#include "edit_state.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"
#include "image/format_table.hpp"

namespace cotan {

namespace fs = std::filesystem;
using namespace gltf_edit;

namespace {

struct WrittenFile {
    fs::path file;
    std::vector<std::byte> bytes;
    ByteBlocks more{}; // follow `bytes`; of the document

    std::size_t size() const
    {
        return std::accumulate(more.begin(), more.end(), bytes.size(), [](auto n, auto& b) { return n + b.size(); });
    }
};

bool isExternal(const Json& image)
{
    return image.contains("uri") && !image["uri"].get_ref<const std::string&>().starts_with("data:");
}

// The image files that the JSON names, by image index; missing files are left out.
std::map<std::size_t, fs::path> imageFiles(const GltfSource& source, const Json& root)
{
    std::map<std::size_t, fs::path> files;
    for (std::size_t i = 0; i < countOf(root, "images"); ++i) {
        const Json& image = root["images"][i];
        if (!isExternal(image))
            continue;
        GltfResource resource = resolveGltfUri(source.file, image["uri"].get_ref<const std::string&>(),
                                               fmt::format("images[{}].uri", i), /*mayMiss*/ true);
        if (!resource.file.empty())
            files.emplace(i, std::move(resource.file));
    }
    return files;
}

std::size_t totalSize(const std::set<fs::path>& files)
{
    std::size_t total = 0;
    for (const fs::path& file : files) {
        std::error_code error;
        const auto size = fs::file_size(file, error);
        total += error ? 0 : std::size_t(size);
    }
    return total;
}

std::size_t sizeBefore(const GltfSource& source)
{
    std::set<fs::path> files;
    for (const auto& [file, bytes] : source.file.bufferFiles)
        files.insert(file);
    for (const auto& [image, file] : imageFiles(source, source.file.json))
        files.insert(file);
    return source.file.modelBytes + totalSize(files);
}

std::vector<std::byte> readOrFail(const GltfSource& source, const fs::path& file, const LoadLimits& limits)
{
    Result<std::vector<std::byte>> bytes = readGltfResource(source.file, file, limits);
    if (!bytes)
        throw bytes.error();
    return std::move(*bytes);
}

// An image file that is used twice is embedded once.
void embedImages(GltfDocument& document, const LoadLimits& limits)
{
    std::map<fs::path, Json> embedded; // the members that replace the image's uri
    for (const auto& [i, file] : imageFiles(*document.source, rootOf(document))) {
        if (!embedded.contains(file)) {
            std::vector<std::byte> bytes = readOrFail(*document.source, file, limits);
            const ImageFormat* const format = imageFormatOf(bytes);
            embedded[file] = nullptr;
            if (format && !format->mime.empty()) // else no image format of glTF
                embedded[file] = {{"mimeType", format->mime}, {"bufferView", addView(document, std::move(bytes))}};
        }
        if (embedded[file].is_null())
            continue;
        rootOf(document)["images"][i].erase("uri");
        rootOf(document)["images"][i].update(embedded[file]);
    }
    for (std::size_t i = 0; i < countOf(rootOf(document), "images"); ++i)
        if (isExternal(rootOf(document)["images"][i]))
            document.notes.push_back(fmt::format("images[{}]: \"{}\" is missing or not an image; its URI is kept", i,
                                                 oneLine(rootOf(document)["images"][i]["uri"].get<std::string>())));
}

// ---- GLB ------------------------------------------------------------------------------------

void appendWord(std::vector<std::byte>& bytes, std::size_t word)
{
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(std::byte(word >> shift & 0xff));
}

WrittenFile makeGlb(const Layout& layout, const fs::path& file)
{
    std::string text = layout.root.dump();
    text.resize(gltf::aligned(text.size()), ' ');
    const std::size_t binary = gltf::aligned(layout.size), total = 12 + 8 + text.size() + (binary > 0 ? 8 + binary : 0);
    if (total > std::numeric_limits<std::uint32_t>::max())
        failGltf("a .glb of {} bytes cannot be written, the limit is 4 GiB; write .gltf", total);
    WrittenFile glb{file, {}, layout.blocks};
    for (const std::size_t word : {std::size_t(kGlbMagic), std::size_t(2), total, text.size(), std::size_t(kGlbJson)})
        appendWord(glb.bytes, word);
    const auto json = std::as_bytes(std::span(text));
    glb.bytes.insert(glb.bytes.end(), json.begin(), json.end());
    if (binary > 0) {
        static constexpr std::byte kZeros[3] = {};
        appendWord(glb.bytes, binary);
        appendWord(glb.bytes, kGlbBinary);
        glb.more.push_back(std::span(kZeros).first(binary - layout.size));
    }
    return glb;
}

// ---- glTF with separate files ---------------------------------------------------------------

std::string encodePercent(const std::string& name)
{
    std::string uri;
    for (const char c : name)
        if (isLetter(c) || isDigit(c) || c == '-' || c == '_' || c == '.' || c == '~')
            uri += c;
        else
            uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return uri;
}

// NAME.bin, or NAME_data.bin if NAME.bin is a buffer of the source file and that file is not replaced.
fs::path binaryBeside(const GltfSource& source, const fs::path& file)
{
    fs::path binary = file;
    binary.replace_extension(".bin");
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(binary, error);
    if (source.file.bufferFiles.contains(canonical) && !fs::equivalent(file, source.path, error))
        binary.replace_filename(file.stem().string() + "_data.bin");
    return binary;
}

// ---- new images -----------------------------------------------------------------------------

// The name of an image, else of the file it was in, else its number.
std::string nameOfImage(const GltfSource& source, const Json& root, std::size_t i)
{
    std::string name = root["images"][i].value("name", std::string());
    if (name.empty() && i < countOf(source.file.json, "images") && isExternal(source.file.json["images"][i]))
        name = fs::path(source.file.json["images"][i]["uri"].get<std::string>()).stem().string();
    return name.empty() ? fmt::format("image{}", i) : name;
}

// The image URIs of an existing model of this name, which is about to be replaced.
std::vector<std::string> ownImages(const fs::path& file, const LoadLimits& limits)
{
    std::vector<std::string> uris;
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        return uris;
    Json root; // an invalid model is replaced too
    if (const auto bytes = readFileBytes(file, limits.fileBytes, /*isInput*/ false))
        try {
            root = parseGltfJson(*bytes);
        } catch (const GltfProblem&) {
            return uris;
        }
    if (const Json* const images = gltf::member(root, "images"); images && images->is_array())
        for (const Json& image : *images)
            if (const Json* const uri = gltf::member(image, "uri"); uri && uri->is_string())
                uris.push_back(uri->get<std::string>());
    return uris;
}

// Makes images that were added to the document files beside the model, MODEL-IMAGE.png. An existing file is overwritten
// only if it belongs to the model that is replaced; otherwise the name gets a number.
void putImagesBeside(GltfDocument& document, const fs::path& file, const LoadLimits& limits,
                     std::vector<WrittenFile>& outputs)
{
    const GltfSource& source = *document.source;
    const std::size_t old = source.views.size();
    const std::vector<std::string> own = ownImages(file, limits);
    std::vector<fs::path> read;
    for (const auto& [i, path] : imageFiles(source, source.file.json))
        read.push_back(path);
    for (std::size_t i = 0; i < countOf(rootOf(document), "images"); ++i) {
        Json& image = rootOf(document)["images"][i];
        if (!image.contains("bufferView") || image["bufferView"].get<std::size_t>() < old)
            continue;
        const auto format =
            std::ranges::find(kImageFormats, image.value("mimeType", std::string("image/png")), &ImageFormat::mime);
        const std::string ending(format == kImageFormats.end() ? ".png" : format->endings[0]);
        const auto targetOf = [&](const std::string& part) {
            return folderOf(file) / (file.stem().string() + "-" + part + ending);
        };
        const auto taken = [&](const std::string& part) {
            std::error_code error;
            const fs::path target = targetOf(part);
            const bool here = std::ranges::any_of(outputs, [&](const WrittenFile& other) {
                return lowerCase(other.file.string()) == lowerCase(target.string());
            });
            const bool input = std::ranges::find(read, fs::weakly_canonical(target, error)) != read.end();
            const bool replaced = std::ranges::find(own, encodePercent(target.filename().string())) != own.end();
            return here || input || (fs::exists(target, error) && !replaced);
        };
        const fs::path target = targetOf(fileNamePart(nameOfImage(source, rootOf(document), i), taken));
        const auto bytes = viewBytes(document, image["bufferView"].get<std::size_t>());
        outputs.push_back({target, {}, {bytes}});
        image.erase("bufferView");
        image["uri"] = encodePercent(target.filename().string());
    }
}

// Copies image files to the same relative path in the new folder. An existing file there must be identical.
void copyImages(const GltfSource& source, const Json& root, const fs::path& folder, const LoadLimits& limits,
                std::vector<WrittenFile>& outputs)
{
    std::error_code error;
    if (fs::equivalent(folder, source.file.folder, error))
        return;
    for (const auto& [i, file] : imageFiles(source, root)) {
        const fs::path target = folder / file.lexically_relative(source.file.folder);
        if (std::ranges::find(outputs, target, &WrittenFile::file) != outputs.end())
            continue;
        std::vector<std::byte> bytes = readOrFail(source, file, limits);
        if (fs::exists(target, error)) {
            const auto there = readFileBytes(target, limits.fileBytes);
            if (!there || *there != bytes)
                throw outputError(
                    fmt::format("{}: a different file exists where an image would be copied", target.string()));
            continue;
        }
        outputs.push_back({target, std::move(bytes)});
    }
}

// Writes all files or none: each is written under a temporary name, and renamed only after the last is complete. The
// first, the model, is renamed last.
Status writeTogether(std::span<const WrittenFile> outputs)
{
    std::vector<OutputFile> files;
    for (std::size_t i = outputs.size(); i-- > 0;) {
        const WrittenFile& output = outputs[i];
        std::error_code error;
        fs::create_directories(folderOf(output.file), error);
        COTAN_TRY(file, OutputFile::begin(output.file));
        files.push_back(*std::move(file));
        ByteBlocks blocks = {output.bytes};
        blocks.insert(blocks.end(), output.more.begin(), output.more.end());
        if (Status written = writeBytes(files.back(), blocks); !written)
            return files.back().failed(written.error());
    }
    return commitTogether(files);
}

GltfWritten write(GltfDocument document, const fs::path& file, const LoadLimits& limits)
{
    const bool binary = lowerExtension(file) == ".glb";
    std::error_code error;
    if (!fs::is_directory(folderOf(file), error))
        throw outputError(fmt::format("{}: the folder {} does not exist", file.string(), folderOf(file).string()));
    GltfWritten written;
    written.bytesBefore = sizeBefore(*document.source);
    std::vector<WrittenFile> outputs{{file, {}}};
    if (binary)
        embedImages(document, limits);
    else
        putImagesBeside(document, file, limits, outputs);
    Layout layout = layOut(document);
    if (binary) {
        outputs[0] = makeGlb(layout, file);
    } else {
        if (layout.size > 0) {
            const fs::path beside = binaryBeside(*document.source, file);
            layout.root["buffers"][0]["uri"] = encodePercent(beside.filename().string());
            outputs.push_back({beside, {}, std::move(layout.blocks)});
        }
        const std::string text = layout.root.dump(2) + "\n";
        const auto bytes = std::as_bytes(std::span(text));
        outputs[0].bytes.assign(bytes.begin(), bytes.end());
    }
    for (const WrittenFile& output : outputs)
        written.bytesAfter += output.size();
    if (!binary)
        copyImages(*document.source, layout.root, folderOf(file), limits, outputs);
    if (Status done = writeTogether(outputs); !done)
        throw done.error();
    std::set<fs::path> images;
    for (const auto& [i, path] : imageFiles(*document.source, layout.root)) {
        const auto isImage = [&, &image = path](const WrittenFile& o) { return fs::equivalent(o.file, image, error); };
        if (std::ranges::none_of(outputs, isImage))
            images.insert(path);
    }
    written.bytesAfter += totalSize(images);
    for (const WrittenFile& output : outputs)
        written.files.push_back(output.file);
    written.notes = std::move(document.notes);
    return written;
}

// Runs `write` and converts its exceptions to errors for the caller.
template<class Write>
auto caughtWriting(const GltfDocument& document, const std::string& name, const Write& write)
    -> Result<decltype(write())>
{
    try {
        return write();
    } catch (const Error& failure) {
        return failure;
    } catch (const GltfProblem& problem) {
        return inputError(fileOf(document) + oneLine(problem.error.message));
    } catch (const std::bad_alloc&) {
        return unavailableError(name + ": not enough memory to write it");
    }
}

} // namespace

Result<std::vector<std::byte>> glbBytes(GltfDocument document, const LoadLimits& limits)
{
    return caughtWriting(document, "the model", [&] {
        embedImages(document, limits);
        WrittenFile glb = makeGlb(layOut(document), {});
        glb.bytes.reserve(glb.size());
        for (const auto& block : glb.more)
            glb.bytes.insert(glb.bytes.end(), block.begin(), block.end());
        return std::move(glb.bytes);
    });
}

Result<GltfWritten> writeGltf(const GltfDocument& document, const fs::path& file, const LoadLimits& limits)
{
    if (lowerExtension(file) != ".glb" && lowerExtension(file) != ".gltf")
        return usageError(fmt::format("{}: expected a name that ends in .glb or .gltf", file.string()));
    return caughtWriting(document, file.string(), [&] { return write(document, file, limits); });
}

} // namespace cotan
