#include "requests.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/try.hpp"
#include "cotan/image.hpp"
#include "files/output.hpp"
#include "image/format_table.hpp"
#include "input.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

// Returns an unused file name: STEM-1.png and so on.
fs::path unusedName(const std::string& stem, const std::string& ending)
{
    std::error_code error;
    for (int i = 1;; ++i)
        if (fs::path file = fmt::format("{}-{}{}", stem, i, ending); !fs::exists(file, error))
            return file;
}

// ---- one function per kind of request ---------------------------------------------------------

Status carryOut(Parts& parts, const request::WriteImage& r)
{
    State& state = parts.state;
    if (!state.model)
        return usageError("picture: expected a model; found none");
    const bool named = !r.file.empty() && r.file != "-" && r.file != ".exr";
    const fs::path file = named ? fs::path(r.file) : unusedName("cotan-picture", r.file == ".exr" ? ".exr" : ".png");
    State wanted = state;
    wanted.size = r.size.x > 0 ? r.size : state.size;
    wanted.moving = wanted.playing = false;
    if (wanted.compare == Compare::divider)
        wanted.compare = Compare::off;
    const bool floats = keepsFloats(file);
    Order order = orderOf(wanted);
    if (floats && showsLight(wanted.show))
        order.first.use = order.second.use = PictureUse::radiance;
    const auto image = parts.pictures.drawNow(order, floats);
    if (!image)
        return app::withOptionNames(image.error());
    COTAN_CHECK(writeImage(file, *image));
    state.message = commandLine(wanted, file.string(), wanted.size);
    app::say(parts.options.common, state.message);
    return Done{};
}

Status carryOut(Parts& parts, const request::WriteWindow& r)
{
    const auto picture = parts.window->showAndRead(interfaceNow(parts), parts.pictures.shown(parts.state));
    return picture ? writeImage(r.file, *picture) : Status(picture.error());
}

Status carryOut(Parts& parts, const request::WriteReport& r) { return writeFileWhole(r.file, reportOf(parts.state)); }

Status carryOut(Parts& parts, const request::Paste&)
{
    const std::string path = pathOf(parts.window->clipboard());
    return path.empty() ? Status(usageError("paste: expected a copied file path; found none"))
                        : perform(parts.state, "drop " + path);
}

Status carryOut(Parts& parts, const request::ChooseFile& r)
{
    parts.chosenFor = r.command;
    parts.dialog.ask(*parts.window, parts.state.picture.model);
    return Done{};
}

Status carryOut(Parts& parts, const request::Copy& r)
{
    parts.window->setClipboard(r.text);
    parts.state.message = "copied: " + r.text;
    if (parts.options.plays)
        app::say(parts.options.common, r.text);
    return Done{};
}

Status carryOut(Parts& parts, const request::Resize& r)
{
    parts.window->resize(r.size.x, r.size.y);
    return Done{};
}

Status carryOut(Parts& parts, const request::LoseSurface&)
{
    parts.window->loseSurface();
    return Done{};
}

Status carryOut(Parts& parts, const request::FindProblemAreas&)
{
    if (parts.state.model)
        parts.loader.findProblemAreas(parts.state.model);
    return Done{};
}

Status carryOut(Parts& parts, const request::RunTask& r)
{
    State& state = parts.state;
    COTAN_TRY(task, taskNamed(state, r.name));
    COTAN_CHECK(parts.tool.start(parts.options.program, task->words));
    parts.task = *std::move(task);
    state.task = parts.task.title;
    state.message = commandLine(parts.task);
    app::say(parts.options.common, state.message);
    return Done{};
}

Status carryOut(Parts& parts, const request::StopTask&)
{
    parts.tool.stop();
    return Done{};
}

Status carryOut(Parts& parts, const request::Quit&)
{
    parts.quits = true;
    return Done{};
}

Status carryOut(Parts& parts, const request::Pose&)
{
    if (parts.state.model)
        parts.loader.pose(parts.state.picture);
    return Done{};
}

Status carryOut(Parts& parts, const request::Load& r)
{
    State& state = parts.state;
    PictureOptions options = state.picture;
    options.model = r.model;
    if (!r.model.empty())
        options.shape.clear();
    if (r.model != state.picture.model) { // another model has other animations
        options.variant.clear();
        options.animation.clear();
        options.time = 0;
    }
    parts.loader.read(options);
    state.loading = r.model.empty() ? "the scene" : fileName(r.model);
    state.progress = 0;
    return Done{};
}

Status carryOut(Parts& parts, const request::LoadHigh& r)
{
    PictureOptions options = parts.state.picture;
    options.up = highUpOf(parts.state);
    parts.loader.readHigh(options, r.files);
    parts.state.loading = fileName(r.files.front());
    parts.state.progress = 0;
    return Done{};
}

} // namespace

// Takes over what a task has printed and made, once it has ended.
void takeTask(Parts& parts)
{
    constexpr int kOverLimit = 5; // of lint, whose findings are no failure
    State& state = parts.state;
    const auto end = parts.tool.take();
    if (!end)
        return;
    state.task.clear();
    state.result = {parts.task.title, {}};
    constexpr std::string_view kPrefix = "cotan: ", kWarning = "warning: ";
    std::vector<std::string>& lines = state.result.lines;
    for (std::size_t at = 0; at < end->output.size();) {
        const std::size_t next = std::min(end->output.find('\n', at), end->output.size());
        const std::string line = end->output.substr(at, next - at);
        lines.push_back(line.starts_with(kPrefix) ? line.substr(kPrefix.size()) : line);
        at = next + 1;
    }
    std::stable_partition(lines.begin(), lines.end(),
                          [&](const std::string& line) { return !line.starts_with(kWarning); });
    if (end->code != 0 && end->code != kOverLimit)
        state.result.title += end->code < 0 ? ": ended" : fmt::format(": exit code {}", end->code);
    if (lines.empty())
        lines.push_back("no output");
    state.resultShown = true;
    if (end->code == 0)
        for (const std::string& command : parts.task.shows)
            apply(state, {-1, EventKind::command, 0, 0, command});
}

void beginLoads(Parts& parts)
{
    std::erase_if(parts.state.requests, [&](const Request& request) {
        const auto* load = std::get_if<request::Load>(&request);
        if (load)
            if (const Status begun = carryOut(parts, *load); !begun)
                parts.state.problem = begun.error().message;
        return load || std::holds_alternative<request::Pose>(request); // there is no model to pose yet
    });
}

void watchShown(Parts& parts)
{
    const State& s = parts.state;
    std::vector<std::string> named{fmt::format("{}", s.loads), s.picture.model, s.a.normalMap, s.b.normalMap,
                                   s.picture.environment};
    std::ranges::copy(s.picture.maps.files(), std::back_inserter(named));
    parts.highWatch.on({s.high.begin(), s.high.end()});
    if (named == parts.watched)
        return;
    parts.watched = named;
    std::vector<std::string> pictures;
    if (s.model)
        for (const Image& image : s.model->scene.images)
            pictures.push_back(image.name);
    std::vector<std::filesystem::path> files = filesOf(s.picture.model, pictures);
    for (std::size_t i = 2; i < named.size(); ++i)
        if (std::filesystem::path(named[i]).has_extension()) // others are built-in environments or empty
            files.emplace_back(named[i]);
    parts.watch.on(files);
}

Status carryOutRequests(Parts& parts)
{
    Status first = Done{};
    for (const Request& request : std::exchange(parts.state.requests, {}))
        if (const Status done = std::visit([&](const auto& r) { return carryOut(parts, r); }, request); !done) {
            parts.state.problem = done.error().message;
            first = first ? done : first;
        }
    if (const auto chosen = parts.dialog.take(*parts.window); !chosen)
        parts.state.problem = chosen.error().message;
    else if (!chosen->empty())
        apply(parts.state, {0, EventKind::command, 0, 0, parts.chosenFor + " " + *chosen});
    takeTask(parts);
    watchShown(parts);
    if (parts.watch.changed(secondsNow()))
        parts.state.requests.push_back(request::Load{parts.state.picture.model});
    if (parts.highWatch.changed(secondsNow()))
        parts.state.requests.push_back(request::LoadHigh{parts.state.high});
    return first;
}

} // namespace cotan::viewer
