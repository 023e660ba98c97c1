#include "files.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "files/bytes.hpp"
#include "files/json.hpp"
#include "gltf/gltf_file.hpp"
#include "image/format_table.hpp"
#include "model/model_formats.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

constexpr double kPollSeconds = 0.25, kRestSeconds = 0.3; // polling interval, and time without changes; seconds

} // namespace

bool isImageFile(const fs::path& file) { return imageFormatHas(file, &ImageFormat::reads); }

bool isModel(const fs::path& file) { return modelFormatOf(file) != nullptr; }

std::string neighbourOf(const fs::path& file, int step)
{
    if (file.empty())
        return {};
    std::error_code error;
    std::vector<fs::path> models;
    const fs::path folder = folderOf(file);
    for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
         !error && it != end; it.increment(error))
        if (isModel(it->path()) && it->is_regular_file(error))
            models.push_back(it->path().filename());
    std::ranges::sort(models);
    const auto here = std::ranges::find(models, file.filename());
    const auto count = std::ptrdiff_t(models.size());
    if (count == 0 || (count == 1 && here != models.end()))
        return {};
    const std::ptrdiff_t at = here == models.end() ? 0 : here - models.begin() + step;
    const fs::path name = models[std::size_t(((at % count) + count) % count)];
    return (file.has_parent_path() ? folder / name : name).string();
}

std::string pathOf(std::string text)
{
    const auto drop = [&](std::string_view which) {
        while (!text.empty() && which.find(text.back()) != std::string_view::npos)
            text.pop_back();
        text.erase(0, std::min(text.find_first_not_of(which), text.size()));
    };
    text = text.substr(0, text.find('\n'));
    drop(" \t\r");
    drop("'\"");
    constexpr std::string_view kScheme = "file://";
    if (!text.starts_with(kScheme))
        return text;
    const std::size_t start = text.find('/', kScheme.size()); // skip the host name
    return decodePercent(text.substr(std::min(start, text.size())));
}

std::optional<Watch::FileStamp> Watch::stampOf(const fs::path& file)
{
    std::error_code error;
    const FileStamp stamp{fs::last_write_time(file, error), error ? 0 : fs::file_size(file, error)};
    return error ? std::nullopt : std::optional(stamp);
}

void Watch::on(const std::vector<fs::path>& files)
{
    std::vector<File> next;
    for (const fs::path& path : files) {
        const auto before = std::ranges::find(files_, path, &File::path);
        if (path.empty() || std::ranges::find(next, path, &File::path) != next.end())
            continue;
        if (before != files_.end()) {
            next.push_back(*before);
            continue;
        }
        const auto now = stampOf(path);
        next.push_back({path, now, now});
    }
    files_ = std::move(next);
}

bool Watch::changed(File& file, double seconds)
{
    const auto now = stampOf(file.path);
    if (now != file.last) {
        file.last = now;
        file.sinceLast = seconds;
        return false;
    }
    if (!now || now == file.known || seconds - file.sinceLast < kRestSeconds)
        return false;
    file.known = now;
    return true;
}

bool Watch::changed(double seconds)
{
    if (files_.empty() || (polledAt_ >= 0 && seconds < polledAt_ + kPollSeconds))
        return false;
    polledAt_ = seconds;
    bool any = false;
    for (File& file : files_)
        any = changed(file, seconds) || any;
    return any;
}

std::vector<fs::path> filesOf(const fs::path& model, const std::vector<std::string>& pictureNames)
{
    if (model.empty())
        return {};
    std::vector<fs::path> files{model};
    const auto add = [&](const std::string& name) {
        std::error_code ignored;
        if (const fs::path file = model.parent_path() / name; !name.empty() && fs::is_regular_file(file, ignored))
            files.push_back(file);
    };
    if (lowerExtension(model) != ".gltf") {
        for (const std::string& name : pictureNames)
            add(name);
        add(model.stem().string() + ".mtl");
        return files;
    }
    const auto text = readText(model, /*isInput*/ false); // the loader has noted it
    const auto root = Json::parse(text ? *text : "", nullptr, false);
    for (const char* list : {"buffers", "images"})
        if (root.is_object() && root.contains(list) && root[list].is_array())
            for (const auto& entry : root[list])
                if (entry.is_object() && entry.contains("uri") && entry["uri"].is_string())
                    if (const auto uri = entry["uri"].get<std::string>(); !uri.starts_with("data:"))
                        add(decodePercent(uri));
    return files;
}

} // namespace cotan::viewer
