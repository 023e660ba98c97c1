#include "loading.hpp"

#include <string_view>

#include "core/named_values.hpp"
#include "cotan/image.hpp"
#include "cotan/model.hpp"

namespace cotan::app {

Error withOptionNames(const Error& error)
{
    std::string text = error.message;
    constexpr std::string_view kOptions = "options.";
    if (error.field.starts_with(kOptions)) {
        std::string option = "--";
        for (const char c : error.field.substr(kOptions.size()))
            option += isUpper(c) ? std::string("-") + lowerLetter(c) : std::string(1, c);
        text.replace(0, error.field.size(), option);
    }
    // The new error lacks the memory flag, so that another call does not append the hint again.
    return {error.kind, text + (error.memory ? " (--memory raises it)" : "")};
}

Result<Scene> loadSceneWithin(const LoadLimits& limits, const std::filesystem::path& file)
{
    auto scene = loadScene(file, limits);
    return scene ? std::move(scene) : Result<Scene>(withOptionNames(scene.error()));
}

Result<Scene> loadSceneWithin(int memory, const std::filesystem::path& file, Pixels pixels)
{
    return loadSceneWithin(limitsFor(memory, pixels), file);
}

Result<Image> readImageWithin(int memory, const std::filesystem::path& file)
{
    auto image = readImage(file, limitsFor(memory));
    return image ? std::move(image) : Result<Image>(withOptionNames(image.error()));
}

Result<Scene> loadWithProgress(const CommonOptions& common, const LoadLimits& limits, const std::string& file)
{
    const ProgressLine loading(common.quiet, 0, "loading " + file);
    return loadSceneWithin(limits, file);
}

Result<std::unique_ptr<Renderer>> warnOfNote(Result<std::unique_ptr<Renderer>> renderer, const CommonOptions& common)
{
    if (renderer && !(*renderer)->note.empty())
        warn(common, (*renderer)->note);
    return renderer;
}

Result<std::unique_ptr<Renderer>> openDevice(const std::string& device, const CommonOptions& common)
{
    return warnOfNote(openRenderer(device, common.threads), common);
}

} // namespace cotan::app
