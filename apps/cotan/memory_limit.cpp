#include "memory_limit.hpp"

#include <algorithm>

#include "cotan/image/file.hpp"

namespace cotan::app {

void addMemoryOption(CLI::App& command, int& memory)
{
    command.add_option("--memory", memory, "MiB that one picture may take where it has to be held whole")
        ->check(CLI::Range(1, 1 << 16))->type_name("MIB")->capture_default_str();
}

LoadLimits limitsFor(int memory, Pixels pixels)
{
    LoadLimits limits;
    limits.imageBytes = std::size_t(memory) << 20;
    limits.allImageBytes = std::max(limits.allImageBytes, limits.imageBytes);
    limits.imageSide = 1 << 20; // the memory limit decides
    limits.pixels = pixels;
    return limits;
}

Error withMemoryHint(const Error& error)
{
    const auto says = [&](const char* words) { return error.message.find(words) != std::string::npos; };
    const bool memory = (says("the limit is") && says("pixels")) || says("images together take more than the limit");
    return {error.kind, error.message + (memory ? " (--memory raises it)" : "")};
}

Result<Scene> loadSceneWithin(int memory, const std::filesystem::path& file, Pixels pixels)
{
    auto scene = loadScene(file, limitsFor(memory, pixels));
    return scene ? std::move(scene) : Result<Scene>(withMemoryHint(scene.error()));
}

Result<Image> readImageWithin(int memory, const std::filesystem::path& file)
{
    auto image = readImage(file, limitsFor(memory));
    return image ? std::move(image) : Result<Image>(withMemoryHint(image.error()));
}

} // namespace cotan::app
