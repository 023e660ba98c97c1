#include "view_command.hpp"

#include <algorithm>
#include <iterator>

#include "commands.hpp"
#include "core/try.hpp"
#include "files.hpp"
#include "files/bytes.hpp"
#include "files/file_registry.hpp"
#include "files/system/program.hpp"
#include "parse.hpp"
#include "picture.hpp"
#include "session.hpp"

namespace cotan::app {

namespace {

struct ViewCommandOptions : CommonOptions {
    PictureOptions picture;
    std::string frame{kAutoFrame};
    std::string second;
    std::vector<std::string> commands, high;
    std::optional<Up> highUp;
    std::string play, record;
    bool forget = false;
};

// Files that the options name are noted before a window opens; those that a model names are when it is loaded.
Status noteInputs(const PictureOptions& o)
{
    std::vector<std::string> files{o.model, o.environment};
    std::ranges::copy(o.maps.files(), std::back_inserter(files));
    for (const std::string& file : files)
        if (std::filesystem::path(file).has_extension()) // others are built-in environments or empty
            COTAN_CHECK(noteInput(file));
    return Done{};
}

// Restores the state of the window from `file`, where the session will save it.
Status restore(const std::filesystem::path& file, viewer::State& state)
{
    COTAN_CHECK(file.empty() ? Status(Done{}) : planOutput("the window's state in", file));
    const auto text = readText(file, /*isInput*/ false);
    viewer::remember(text ? *text : "", state);
    return Done{};
}

Status run(const ViewCommandOptions& o)
{
    viewer::State state;
    state.picture = o.picture;
    state.size = {o.picture.size.width, o.picture.size.height};
    state.a = {o.frame, o.picture.tangents, o.picture.maps.normal, o.picture.maps.convention};
    state.b = state.a;
    state.b.frame = o.second.empty() ? "mikktspace" : o.second;
    state.show = o.picture.show;
    state.highUp = o.highUp;
    for (const auto& [option, frame] : {std::pair("--frame", state.a.frame), {"--second", state.b.frame}})
        COTAN_CHECK(parseFrameChoice(frame, option));
    COTAN_CHECK(beginOutputs(o, {{"--record", o.record}}, /*again*/ true));
    COTAN_CHECK(noteInputs(o.picture));
    for (const std::string& file : o.high)
        COTAN_CHECK(noteInput(file));
    viewer::SessionOptions session;
    session.common = o;
    session.program = sameProgram();
    if (!o.play.empty()) {
        const auto text = readText(o.play);
        COTAN_TRY(events, text ? viewer::eventsOf(*text, o.play) : text.error());
        session.played = std::move(*events);
        session.plays = true;
    } else if (!o.forget) {
        session.memory = viewer::memoryFile();
        COTAN_CHECK(restore(session.memory, state));
    }
    if (viewer::isImageFile(state.picture.model)) { // a map or an environment without a model
        const std::string file = std::exchange(state.picture.model, {});
        if (state.picture.shape.empty())
            state.picture.shape = "plane";
        COTAN_CHECK(viewer::perform(state, "drop " + file));
        state.b.normalMap = state.a.normalMap;
    }
    if (!o.second.empty())
        state.compare = viewer::Compare::divider;
    if (!o.high.empty())
        state.requests.push_back(viewer::request::LoadHigh{o.high});
    for (const std::string& command : o.commands)
        COTAN_CHECK(viewer::perform(state, command));
    session.record = o.record;
    return viewer::runSession(std::move(state), session);
}

void declare(app::Arguments& a, ViewCommandOptions& o)
{
    addPictureOptions(a, o.picture);
    addFrameOption(a, o.frame);
    a.option("--second", o.second, "a second frame, to compare with the first").in("NAME").offers(frameWords()).main();
    addShowOption(a, o.picture);
    a.option("--high", o.high, "high-poly mesh, to compare with the model; may be given several times")
        .in("FILE")
        .reads()
        .main();
    addHighUpOption(a, o.highUp);
    a.group(HelpGroup::diagnostics);
    a.option("--do", o.commands, "a viewer command to run at the start, such as \"compare angle\"; may be repeated")
        .in("TEXT");
    a.option("--record", o.record, "record the session to a file").in("FILE").writes();
    a.option("--play", o.play, "play a recorded session as fast as possible, then quit").in("FILE").reads();
    a.flag("--forget", o.forget, "neither load nor save the state of the window");
    a.flag("--validate", o.forget, "").unlisted().refused([] { // of earlier versions
        return "unknown option --validate: VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation enables Vulkan's checks";
    });
}

} // namespace

void addViewCommand(app::Arguments& tool)
{
    addCommand<ViewCommandOptions>(
        tool,
        {"view",
         "Open a model or a map in a window; `cotan FILE` is the same.",
         "",
         {"cotan view model.glb", "cotan view statue_low.obj --normal-map rocks.png --second mikktspace",
          "cotan view statue_low.obj --normal-map rocks.png --high statue.obj"}},
        declare, run);
}

} // namespace cotan::app
