// `cotan map info` and `detect`: inspects maps.
#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/try.hpp"
#include "image/format_table.hpp"
#include "map_files/inspect.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

namespace fs = std::filesystem;

struct InspectOptions : MapOptions {
    std::vector<std::string> files; // or folders
};

// The result for one file.
struct Inspected {
    std::vector<std::string> lines;
    Json figures;
    std::size_t brief; // number of the lines that are printed if there are several files
};

using Inspect = Result<Inspected> (*)(const InspectOptions& o, const std::string& file);

// The images in a folder and its subfolders, sorted by path.
Result<std::vector<std::string>> imagesIn(const std::string& folder)
{
    std::vector<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (std::error_code ignored; at->is_regular_file(ignored) && imageFormatHas(at->path(), &ImageFormat::reads))
            files.push_back(at->path().string());
    if (error)
        return inputError(fmt::format("{}: cannot be read: {}", folder, error.message()));
    if (files.empty())
        return inputError(fmt::format("{}: expected a folder with images; found none", folder));
    std::ranges::sort(files);
    return files;
}

// The files of the command line, with folders expanded.
Result<std::vector<std::string>> filesOf(const InspectOptions& o)
{
    std::vector<std::string> all;
    for (const std::string& name : o.files) {
        if (std::error_code ignored; !fs::is_directory(name, ignored)) {
            all.push_back(name);
            continue;
        }
        COTAN_TRY(inside, imagesIn(name));
        all.insert(all.end(), inside->begin(), inside->end());
    }
    return all;
}

Status runOne(const InspectOptions& o, const char* command, Inspect inspect)
{
    COTAN_TRY(inspected, inspect(o, o.files.front()));
    for (const std::string& line : inspected->lines)
        say(o, line);
    Json report = {{"command", command}, {"file", o.files.front()}};
    report.update(inspected->figures);
    return writeReport(o, report);
}

// Inspects the files in turn, and continues after those that cannot be read.
Status runAll(const InspectOptions& o, const char* command, Inspect inspect)
{
    COTAN_TRY(files, filesOf(o));
    std::vector<Error> errors;
    Json all = Json::array();
    for (const std::string& file : *files) {
        const auto inspected = inspect(o, file);
        if (const auto refused = firstRefusal()) // the report would overwrite a file
            return *refused;
        Json report = {{"file", file}};
        if (inspected) {
            for (std::size_t i = 0; i < std::min(inspected->brief, inspected->lines.size()); ++i) {
                const std::string& line = inspected->lines[i];
                say(o, line.starts_with(file) ? line : file + ": " + line);
            }
            report.update(inspected->figures);
        } else {
            warn(o, inspected.error().message);
            errors.push_back(inspected.error());
            report["error"] = inspected.error().message;
        }
        all.push_back(std::move(report));
    }
    COTAN_CHECK(writeReport(o, {{"command", command}, {"files", all}}));
    if (errors.empty())
        return Done{};
    return Error{errors.front().kind,
                 fmt::format("{} of {} files cannot be judged; the first: {}", errors.size(), files->size(),
                             errors.front().message)};
}

Status run(const InspectOptions& o, const char* command, Inspect inspect)
{
    COTAN_CHECK(beginOutputs(o, {}));
    std::error_code ignored;
    const bool one = o.files.size() == 1 && !fs::is_directory(o.files.front(), ignored);
    return one ? runOne(o, command, inspect) : runAll(o, command, inspect);
}

Result<Inspected> survey(const InspectOptions& o, const std::string& file)
{
    const auto found = onFiles(o, file, [&](const FileOptions& files) { return surveyFile(file, files); });
    if (!found)
        return found.error();
    const auto lines = linesOf(*found, file);
    return Inspected{lines, toJson(*found), lines.size()};
}

Result<Inspected> detect(const InspectOptions& o, const std::string& file)
{
    const auto found = onFiles(o, file, [&](const FileOptions& files) { return greenOfFile(file, files); });
    if (!found)
        return found.error();
    const auto lines = linesOf(*found, file);
    // Briefly: the verdict and the faults.
    const auto rest = std::find_if(lines.begin() + 1, lines.end(), [](const std::string& line) {
        return !line.starts_with("wrong: ") && !line.starts_with("to fix it: ");
    });
    return Inspected{lines, toJson(*found), std::size_t(rest - lines.begin())};
}

Status runInfo(const InspectOptions& o) { return run(o, "map info", survey); }

Status runDetect(const InspectOptions& o) { return run(o, "map detect", detect); }

void declare(Arguments& a, InspectOptions& o)
{
    addMemoryOption(a, o.memory);
    a.option("FILE", o.files, "maps; of a folder all images in it and below").required().reads();
}

} // namespace

void addMapInfo(Arguments& map)
{
    addCommand<InspectOptions>(map,
                               {"info",
                                "Show the properties of maps: lengths, tilt, centre, channels, and what is wrong.",
                                "",
                                {"cotan map info rocks.png", "cotan map info rocks.png --json rocks.json"}},
                               declare, runInfo);
}

void addMapDetect(Arguments& map)
{
    addCommand<InspectOptions>(
        map,
        {"detect",
         "Detect which way green points, and how sure that is.",
         "",
         {"cotan map detect rocks.png", "cotan map detect rocks.png grain.png --json maps.json"}},
        declare, runDetect);
}

} // namespace cotan::app
