#include "batch/report.hpp"

#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "html.hpp"
#include "page_html.hpp" // kPage: batch/page.html
#include "terminal/shell_words.hpp"

namespace cotan::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxOutput = 1500; // bytes of output shown for a successful job; others show all that was kept

// A path as the URL of a link.
std::string link(const std::string& path)
{
    std::string text;
    for (const char c : path)
        if (isLetter(c) || isDigit(c) || std::string_view("-_./~").find(c) != std::string_view::npos)
            text += c;
        else
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return text;
}

Json rowOf(const JobList& list, const JobResult& result, const fs::path& folder)
{
    const JobRecord& r = result.record;
    const Job& job = list.jobs[result.job];
    const Thumbnail& t = r.thumbnail;
    const bool bad = r.state > JobState::limit;
    auto outputs = Json::array(), inputs = Json::array();
    for (const FileState& output : r.outputs) {
        const fs::path path = (list.folder / output.file).lexically_normal();
        const fs::path relative = path.lexically_relative(folder);
        outputs.push_back({output.file, link((relative.empty() ? path : relative).string())});
    }
    for (const FileState& input : r.inputs)
        inputs.push_back(input.file);
    return {job.name,
            int(r.state),
            r.degrees ? Json(r.degrees->mean) : nullptr,
            r.degrees ? r.degrees->of : "",
            std::round(r.seconds * 1000) / 1000,
            std::round(r.megabytes),
            commandLine(job.words),
            r.reason,
            bad || r.output.size() <= kMaxOutput ? r.output : r.output.substr(0, kMaxOutput) + "...",
            outputs,
            inputs,
            t.jpeg.empty() ? nullptr : Json({t.width, t.height, t.jpeg}),
            result.kept ? 1 : 0};
}

// The page with texts for the names in double brackets.
std::string filled(const std::map<std::string_view, std::string>& texts)
{
    std::string page;
    std::string_view rest = kPage;
    for (std::size_t at = 0; (at = rest.find("[[")) != std::string_view::npos;) {
        const std::size_t end = rest.find("]]", at);
        page.append(rest.substr(0, at)).append(texts.at(rest.substr(at + 2, end - at - 2)));
        rest.remove_prefix(end + 2);
    }
    return page.append(rest);
}

// Escapes JSON for a script element: no text in it may end the element.
std::string scriptJson(const Json& data)
{
    const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

} // namespace

std::string batchPage(const JobList& list, const std::vector<JobResult>& results, const std::string& title,
                      const std::string& footer, const fs::path& folder, std::size_t maxRows)
{
    Json data;
    for (const char* member : {"states", "bad", "warn", "rows"})
        data[member] = Json::array();
    const StateCounts counts = countsOf(results);
    std::string buttons, heads, more;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        data["states"].push_back(name(JobState(i)));
        if (i > 0)
            data[JobState(i) > JobState::skipped ? "bad" : "warn"].push_back(i);
        if (counts[i] > 0) // worst first
            buttons =
                fmt::format("<button data-state=\"{}\">{} {}</button>", i, counts[i], name(JobState(i))) + buttons;
    }
    for (const auto& [column, text, className] : {std::tuple(0, "Job", ""),
                                                  {1, "State", ""},
                                                  {2, "Degrees", "number"},
                                                  {4, "Seconds", "number wide"},
                                                  {5, "MiB", "number wide"}})
        heads += fmt::format(
            "<div role=\"columnheader\" class=\"{}\"><button data-column=\"{}\">{}<span></span></button></div>",
            className, column, text);
    std::vector<std::size_t> order = worstFirst(results);
    if (order.size() > maxRows) {
        more = fmt::format("the worst {} of {}; ", maxRows, order.size());
        order.resize(maxRows);
    }
    for (const std::size_t i : order)
        data["rows"].push_back(rowOf(list, results[i], folder));
    return filled({{"title", escapeHtml(title)},
                   {"buttons", buttons},
                   {"heads", heads},
                   {"footer", escapeHtml(more + footer)},
                   {"data", scriptJson(data)}});
}

} // namespace cotan::app
