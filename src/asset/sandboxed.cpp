#include "sandboxed.hpp"

#include <new>

#include <fmt/format.h>

#include "file_bytes.hpp"
#include "image_limits.hpp"
#include "reader_process.hpp"
#include "scene_check.hpp"
#include "scene_wire.hpp"

namespace cotan {

namespace {

Sandbox& ofProcess()
{
    static Sandbox sandbox;
    return sandbox;
}

// Over a limit that the child should have held.
Status checkLimits(const Scene& scene, const std::string& file, const LoadLimits& limits)
{
    std::size_t vertices = 0, triangles = 0;
    for (const Mesh& mesh : scene.meshes) {
        vertices += mesh.vertexCount();
        triangles += mesh.triangleCount();
    }
    if (vertices > limits.vertices)
        return inputError(fmt::format("{}: over the limit of {} vertices", file, limits.vertices));
    if (triangles > limits.triangles)
        return inputError(fmt::format("{}: over the limit of {} triangles", file, limits.triangles));
    if (scene.instances.size() > limits.vertices)
        return inputError(fmt::format("{}: over the limit of {} instances", file, limits.vertices));
    return Done{};
}

Status checkPicture(const Image& image, const std::string& file, const LoadLimits& limits)
{
    if (auto error = checkImageSize(image.width, image.height, image.type, file, limits))
        return *error;
    if (image.data.size() != image.pixelCount() * image.bytesPerPixel())
        return inputError(fmt::format("{}: expected the bytes of {} x {} pixels, found {}", file, image.width,
                                      image.height, image.data.size()));
    return Done{};
}

class SandboxedRows : public RowReader {
public:
    explicit SandboxedRows(std::unique_ptr<ReaderProcess> process) : process_(std::move(process)) {}

    Status readFacts(const std::string& file, const LoadLimits& limits)
    {
        name = file;
        exchangeRowFacts(process_->answer(), *this);
        if (width <= 0 || height <= 0 || width > limits.imageSide || height > limits.imageSide)
            process_->answer().refuse();
        if (!process_->answer().good())
            return process_->failure();
        return Done{};
    }

    Status read(Image& strip) override
    {
        process_->restartClock();
        process_->question().number(std::int32_t(strip.height));
        process_->question().flush(); // a failure shows in the answer
        if (Status found = process_->await(); !found)
            return found;
        const std::size_t expected = strip.data.size();
        process_->answer().array(strip.data);
        if (strip.data.size() != expected)
            process_->answer().refuse();
        strip.data.resize(expected);
        if (!process_->answer().good())
            return process_->failure();
        return Done{};
    }

private:
    std::unique_ptr<ReaderProcess> process_;
};

} // namespace

void sandboxByDefault(Sandbox sandbox) { ofProcess() = std::move(sandbox); }

Sandbox defaultSandbox() { return ofProcess(); }

Result<Scene> loadSandboxed(const std::filesystem::path& file, const LoadLimits& limits)
try {
    const auto size = usableFileSize(file, limits.fileBytes);
    if (!size)
        return size.error();
    auto process = ReaderProcess::start({.kind = ReaderKind::model, .name = file.string(), .fileBytes = *size, .limits = limits});
    if (!process)
        return process.error();
    if (Status found = (*process)->await(); !found)
        return found.error();
    Scene scene;
    exchangeScene((*process)->answer(), scene);
    if (!(*process)->answer().good())
        return (*process)->failure();
    if (Status sound = checkScene(scene, file.string()); !sound)
        return sound.error();
    if (Status within = checkLimits(scene, file.string(), limits); !within)
        return within.error();
    return scene;
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the model", file.string()));
}

Result<Image> decodeSandboxed(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    auto process = ReaderProcess::start({.kind = ReaderKind::picture,
                                         .name = name,
                                         .bytes = {bytes.begin(), bytes.end()},
                                         .fileBytes = bytes.size(),
                                         .limits = limits});
    if (!process)
        return process.error();
    if (Status found = (*process)->await(); !found)
        return found.error();
    Image image;
    exchangeImage((*process)->answer(), image);
    if (!(*process)->answer().good())
        return (*process)->failure();
    if (Status sound = checkPicture(image, name, limits); !sound)
        return sound.error();
    return image;
}

Result<std::unique_ptr<RowReader>> openRowsSandboxed(const std::filesystem::path& file, const LoadLimits& limits)
{
    auto process = ReaderProcess::start({.kind = ReaderKind::rows, .name = file.string(), .limits = limits});
    if (!process)
        return process.error();
    if (Status found = (*process)->await(); !found)
        return found.error();
    auto rows = std::make_unique<SandboxedRows>(*std::move(process));
    if (Status sound = rows->readFacts(file.string(), limits); !sound)
        return sound.error();
    return std::unique_ptr<RowReader>(std::move(rows));
}

} // namespace cotan
