#include "files.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

#include "cotan/files/extension.hpp"
#include "cotan/image/format_table.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

constexpr double kEvery = 0.25, kRest = 0.3; // seconds

template<std::size_t n> bool endsWithOneOf(const fs::path& file, const std::array<std::string_view, n>& endings)
{
    return std::ranges::find(endings, lowerExtension(file)) != endings.end();
}

int digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0'
        : c >= 'a' && c <= 'f'  ? c - 'a' + 10
        : c >= 'A' && c <= 'F'  ? c - 'A' + 10
                                : -1;
}

} // namespace

bool isPicture(const fs::path& file) { return imageFormatHas(file, &ImageFormat::reads); }

bool isModel(const fs::path& file)
{
    constexpr std::array<std::string_view, 8> kEndings = {".gltf", ".glb", ".obj", ".ply",
                                                          ".stl",  ".dae", ".fbx", ".3ds"};
    return endsWithOneOf(file, kEndings);
}

std::string neighbourOf(const fs::path& file, int step)
{
    if (file.empty())
        return {};
    std::error_code error;
    std::vector<fs::path> models;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
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
    std::string path;
    const std::size_t start = text.find('/', kScheme.size()); // past the name of the machine
    for (std::size_t i = std::min(start, text.size()); i < text.size(); ++i)
        if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0) {
            path += char(16 * digit(text[i + 1]) + digit(text[i + 2]));
            i += 2;
        } else {
            path += text[i];
        }
    return path;
}

std::optional<Watch::Look> Watch::lookAt(const fs::path& file)
{
    std::error_code error;
    const Look look{fs::last_write_time(file, error), error ? 0 : fs::file_size(file, error)};
    return error ? std::nullopt : std::optional(look);
}

void Watch::on(const fs::path& file)
{
    file_ = file;
    known_ = last_ = file.empty() ? std::nullopt : lookAt(file);
}

bool Watch::changed(double seconds)
{
    if (file_.empty() || (lookedAt_ >= 0 && seconds < lookedAt_ + kEvery))
        return false;
    lookedAt_ = seconds;
    const auto now = lookAt(file_);
    if (now != last_) {
        last_ = now;
        sinceLast_ = seconds;
        return false;
    }
    if (!now || now == known_ || seconds - sinceLast_ < kRest)
        return false;
    known_ = now;
    return true;
}

} // namespace cotan::viewer
