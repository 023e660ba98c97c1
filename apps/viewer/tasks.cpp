#include "tasks.hpp"

#include <fmt/format.h>

#include "command_words.hpp"
#include "gltf_open.hpp"
#include "terminal/shell_words.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

bool hasModel(const State& s) { return !s.picture.model.empty(); }
bool hasGltf(const State& s) { return app::namedAsGltf(s.picture.model); }
bool hasMap(const State& s) { return !s.a.normalMap.empty(); }
bool hasPair(const State& s) { return hasModel(s) && !s.high.empty(); }

// A name that is not used yet, beside `file`: "rock-fixed.png", then "rock-fixed-2.png".
std::string nameBeside(const fs::path& file, const std::string& ending, const std::string& extension)
{
    const auto name = [&](const std::string& number) {
        return (file.parent_path() / (file.stem().string() + ending + number + extension)).string();
    };
    std::string free = name("");
    std::error_code error;
    for (int i = 2; fs::exists(fs::symlink_status(free, error)); ++i)
        free = name(fmt::format("-{}", i));
    return free;
}

// The options with which the window itself reads its files.
void addReading(const State& s, std::vector<std::string>& words, bool up)
{
    if (up && s.picture.up != Up::y)
        words.insert(words.end(), {"--up", wordOf(kUps, s.picture.up)});
    if (s.picture.memory != kDefaultMemory)
        words.insert(words.end(), {"--memory", fmt::format("{}", s.picture.memory)});
}

Task checkModel(const State& s)
{
    Task task{"Check model", {"lint", s.picture.model}};
    addReading(s, task.words, /*up*/ true);
    if (hasMap(s))
        task.words.insert(task.words.end(), {"--normal-map", s.a.normalMap});
    if (!s.a.convention.empty())
        task.words.insert(task.words.end(), {"--convention", s.a.convention});
    return task;
}

Task mapTask(const State& s, const char* title, const char* command)
{
    Task task{title, {"map", command, s.a.normalMap}};
    addReading(s, task.words, /*up*/ false);
    return task;
}

// The fixed map is shown: without the user's convention, which was the one of the map before.
Task fixMap(const State& s, const char* title, const std::string& target)
{
    Task task = mapTask(s, title, "convert");
    const std::string file = nameBeside(s.a.normalMap, "-" + target, ".png");
    task.words.insert(task.words.end(), {"--from", "auto", "--to", target, "-o", file});
    task.shows = {"normal-map " + file, "convention " + std::string(target == "opengl" ? "" : target)};
    return task;
}

// The smallest blocks of a device that cost at most half a degree on average, read as the image is.
Task saveBlocks(const State& s, const char* title, const char* device)
{
    Task task = mapTask(s, title, "convert");
    const std::string file = nameBeside(s.a.normalMap, fmt::format("-{}", device), ".ktx2");
    task.words.insert(
        task.words.end(),
        {"--from", "auto", "--to", "opengl", "--max-degrees", "0.5", "--for", device, "--mips", "-o", file});
    task.shows = {"normal-map " + file, "convention "};
    return task;
}

Task convertModel(const State& s, const char* title, std::vector<std::string> words, const char* ending)
{
    Task task{title, std::move(words)};
    task.words.insert(task.words.begin() + 1, s.picture.model);
    task.words.insert(task.words.end(), {"-o", nameBeside(s.picture.model, ending, ".glb")});
    return task;
}

Task bakeTask(const State& s, const char* title, const std::vector<std::string>& maps)
{
    Task task{title, {"bake", "--low", s.picture.model}};
    for (const std::string& file : s.high)
        task.words.insert(task.words.end(), {"--high", file});
    addReading(s, task.words, /*up*/ true);
    if (highUpOf(s) != s.picture.up)
        task.words.insert(task.words.end(), {"--high-up", wordOf(kUps, highUpOf(s))});
    std::string file = nameBeside(s.picture.model, maps.empty() ? "-normal" : "-maps", maps.empty() ? ".png" : "");
    if (!maps.empty()) {
        task.words.insert(task.words.end(), {"--maps", fmt::format("{}", fmt::join(maps, ","))});
        file = (fs::path(file) / "").string(); // a folder
    }
    task.words.insert(task.words.end(), {"-o", file});
    task.shows = {"normal-map " + (maps.empty() ? file : file + "normal.png"), "convention "};
    return task;
}

constexpr TaskEntry kLine{};
constexpr const char* kBlocks = "Blocks for GPUs";
constexpr const char *kNeedsModel = "an open model", *kNeedsMap = "an open normal map",
                     *kNeedsGltf = "an open glTF model", *kNeedsPair = "an open model and its high model";

constexpr TaskEntry kEntries[] = {
    {"check-model", "Check model", kNeedsModel, hasModel, checkModel},
    {"detect", "Check which way green points", kNeedsMap, hasMap,
     [](const State& s) { return mapTask(s, "Check which way green points", "detect"); }},
    {"info", "Properties of map", kNeedsMap, hasMap,
     [](const State& s) { return mapTask(s, "Properties of map", "info"); }},
    kLine,
    {"fix-opengl", "Save fixed map for OpenGL, glTF, Unity, Blender, Godot", kNeedsMap, hasMap,
     [](const State& s) { return fixMap(s, "Save fixed map for OpenGL", "opengl"); }},
    {"fix-directx", "Save fixed map for DirectX, Unreal", kNeedsMap, hasMap,
     [](const State& s) { return fixMap(s, "Save fixed map for DirectX", "directx"); }},
    {"blocks-desktop", "Save map as blocks for desktops", kNeedsMap, hasMap,
     [](const State& s) { return saveBlocks(s, "Save map as blocks for desktops", "desktop"); }, kBlocks},
    {"blocks-mobile", "Save map as blocks for phones", kNeedsMap, hasMap,
     [](const State& s) { return saveBlocks(s, "Save map as blocks for phones", "mobile"); }, kBlocks},
    {"blocks-web", "Save map as blocks for browsers", kNeedsMap, hasMap,
     [](const State& s) { return saveBlocks(s, "Save map as blocks for browsers", "web"); }, kBlocks},
    {"convert", "Save model without tangents", kNeedsGltf, hasGltf,
     [](const State& s) { return convertModel(s, "Save model without tangents", {"convert"}, "-free"); }},
    {"tangents", "Save model with new tangents", kNeedsGltf, hasGltf,
     [](const State& s) {
         return convertModel(s, "Save model with new tangents", {"tangents", "--replace"}, "-tangents");
     }},
    kLine,
    {"bake", "Bake normal map", kNeedsPair, hasPair, [](const State& s) { return bakeTask(s, "Bake normal map", {}); }},
    {"bake-maps", "Bake normal map, occlusion and height", kNeedsPair, hasPair,
     [](const State& s) {
         return bakeTask(s, "Bake normal map, occlusion and height", {"normal", "ao", "height"});
     }},
};

} // namespace

std::span<const TaskEntry> taskEntries() { return kEntries; }

Result<Task> taskNamed(const State& state, const std::string& name)
{
    std::string names;
    for (const TaskEntry& entry : kEntries) {
        if (!entry.name)
            continue;
        names += (names.empty() ? "one of " : ", ") + std::string(entry.name);
        if (entry.name != name)
            continue;
        if (!state.task.empty())
            return expected("run", "no other task", state.task).error();
        if (!entry.usable(state))
            return expected("run " + name, entry.needs, "none").error();
        return entry.make(state);
    }
    return expected("run", names, name).error();
}

std::string commandLine(const Task& task) { return "cotan " + app::commandLine(task.words); }

} // namespace cotan::viewer
