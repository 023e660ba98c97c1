#include "wishes.hpp"

#include <fstream>

#include <fmt/format.h>

#include "commands.hpp"
#include "cotan/image.hpp"
#include "image/format_table.hpp"
#include "input.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

// A name that is not there yet: picture-1.png and so on.
fs::path freeName(const std::string& stem, const std::string& ending)
{
    std::error_code error;
    for (int i = 1;; ++i)
        if (fs::path file = fmt::format("{}-{}{}", stem, i, ending); !fs::exists(file, error))
            return file;
}

Status writePicture(Parts& parts, const Wish& w)
{
    State& state = parts.state;
    if (!state.model)
        return usageError("picture: expected a model; found none");
    const bool named = !w.text.empty() && w.text != "-" && w.text != ".exr";
    const fs::path file = named ? fs::path(w.text) : freeName("cotan-picture", w.text == ".exr" ? ".exr" : ".png");
    State wanted = state;
    wanted.size = w.size.x > 0 ? w.size : state.size;
    wanted.moving = wanted.playing = false;
    if (wanted.compare == Compare::divider)
        wanted.compare = Compare::off;
    const bool floats = keepsFloats(file);
    Order order = orderOf(wanted);
    if (floats && wanted.show == "shaded")
        order.first.use = order.second.use = PictureUse::radiance;
    const auto image = parts.pictures.drawNow(order, floats);
    if (!image)
        return app::inWords(image.error());
    if (Status done = writeImage(file, *image); !done)
        return done;
    state.said = commandLine(wanted, file.string(), wanted.size);
    app::say(parts.options.common, state.said);
    return Done{};
}

Status writeWindow(Parts& parts, const std::string& file)
{
    if (const Status shown = parts.window->show(interfaceNow(parts), parts.pictures.shown(parts.state)); !shown)
        return shown;
    const auto picture = parts.window->read();
    return picture ? writeImage(file, *picture) : Status(picture.error());
}

Status writeState(const State& state, const std::string& name)
{
    std::ofstream file(name, std::ios::binary);
    file << reportOf(state);
    return file.flush() ? Status(Done{}) : Status(outputError(name + ": cannot be written"));
}

Status paste(Parts& parts)
{
    const std::string path = pathOf(parts.window->clipboard());
    return path.empty() ? Status(usageError("paste: expected the path of a file to have been copied; found none"))
                        : perform(parts.state, "drop " + path);
}

Status fulfilOne(Parts& parts, const Wish& w)
{
    State& state = parts.state;
    switch (w.kind) {
    case Wish::Kind::writeFile: return writePicture(parts, w);
    case Wish::Kind::writeWindow: return writeWindow(parts, w.text);
    case Wish::Kind::writeReport: return writeState(state, w.text);
    case Wish::Kind::paste: return paste(parts);
    case Wish::Kind::chooseFile: parts.dialog.ask(*parts.window, state.picture.model); break;
    case Wish::Kind::copy:
        parts.window->setClipboard(w.text);
        state.said = "copied: " + w.text;
        if (parts.options.plays)
            app::say(parts.options.common, w.text);
        break;
    case Wish::Kind::resize: parts.window->resize(w.size.x, w.size.y); break;
    case Wish::Kind::loseSurface: parts.window->loseSurface(); break;
    case Wish::Kind::findHotSpots:
        if (state.model)
            parts.loader.findHotSpots(state.model);
        break;
    case Wish::Kind::quit: parts.quits = true; break;
    case Wish::Kind::load:
    case Wish::Kind::pose: break; // loadWished
    }
    return Done{};
}

} // namespace

void loadWished(Parts& parts)
{
    State& state = parts.state;
    std::vector<Wish> others;
    for (Wish& w : state.wishes) {
        if (w.kind == Wish::Kind::pose) {
            if (state.model)
                parts.loader.pose(state.picture);
            continue;
        }
        if (w.kind != Wish::Kind::load) {
            others.push_back(std::move(w));
            continue;
        }
        PictureOptions options = state.picture;
        options.model = w.text;
        if (!w.text.empty())
            options.shape.clear();
        if (w.text != state.picture.model) { // another model has other animations
            options.variant.clear();
            options.animation.clear();
            options.time = 0;
        }
        parts.loader.read(options);
        state.loading = w.text.empty() ? "the scene" : fileName(w.text);
        state.progress = 0;
    }
    state.wishes = std::move(others);
}

void watchShown(Parts& parts)
{
    const State& s = parts.state;
    const OwnMaps& maps = s.picture.maps;
    std::vector<std::string> named{fmt::format("{}", s.loads), s.picture.model};
    for (const std::string* file : {&maps.normal, &maps.baseColor, &maps.metallicRoughness, &maps.occlusion,
                                    &s.a.normalMap, &s.b.normalMap, &s.picture.environment})
        named.push_back(*file);
    if (named == parts.watched)
        return;
    parts.watched = named;
    std::vector<std::string> pictures;
    if (s.model)
        for (const Image& image : s.model->scene.images)
            pictures.push_back(image.name);
    std::vector<std::filesystem::path> files = filesOf(s.picture.model, pictures);
    for (std::size_t i = 2; i < named.size(); ++i)
        if (std::filesystem::path(named[i]).has_extension()) // others are names of lights, or nothing
            files.emplace_back(named[i]);
    parts.watch.on(files);
}

Status fulfil(Parts& parts)
{
    loadWished(parts);
    Status first = Done{};
    for (const Wish& w : std::exchange(parts.state.wishes, {}))
        if (const Status done = fulfilOne(parts, w); !done) {
            parts.state.problem = done.error().message;
            first = first ? done : first;
        }
    if (const auto chosen = parts.dialog.take(*parts.window); !chosen)
        parts.state.problem = chosen.error().message;
    else if (!chosen->empty())
        apply(parts.state, {0, EventKind::drop, 0, 0, *chosen});
    watchShown(parts);
    if (parts.watch.changed(secondsNow()))
        parts.state.wishes.push_back({Wish::Kind::load, parts.state.picture.model, {}});
    return first;
}

} // namespace cotan::viewer
