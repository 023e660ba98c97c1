#include "batch/job.hpp"

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/one_line.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/json.hpp"
#include "terminal/shell_words.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kMaxBytes = std::size_t(4) << 30;
constexpr std::size_t kMaxNameBytes = 1000;
constexpr double kMaxMegabytes = 1 << 24, kMaxSeconds = 1e6, kMaxPriority = 1e6;

// Lists and objects are not printed, since dumping them recurses once per nesting level.
Error expected(const std::string& member, const std::string& what, const Json& found)
{
    const std::string text = found.is_array() ? "a list"
        : found.is_object()                   ? "an object"
                                              : found.dump(-1, ' ', false, Json::error_handler_t::replace);
    return inputError(fmt::format("\"{}\": expected {}; found {}", member, what, oneLine(text, 60)));
}

// The strings of an array member; empty if the member is absent.
Result<std::vector<std::string>> texts(const Json& job, const char* member)
{
    std::vector<std::string> all;
    if (!job.contains(member))
        return all;
    const Json& list = job[member];
    if (!list.is_array())
        return expected(member, "a list of strings such as [\"lint\", \"model.glb\"]", list);
    for (const Json& item : list) {
        if (!item.is_string())
            return expected(member, "strings only (quote numbers, too)", item);
        all.push_back(item.get<std::string>());
        if (all.back().find('\0') != std::string::npos)
            return expected(member, "strings without the character 0", item);
    }
    return all;
}

void addNew(std::vector<std::string>& all, const std::vector<std::string>& more)
{
    for (const std::string& item : more)
        if (std::ranges::find(all, item) == all.end())
            all.push_back(item);
}

constexpr std::string_view kMembers[] = {
    "name",     "command", "inputs", "outputs", "limit-memory", "limit-time", "limit-processor-time",
    "priority", "retries", "env"};

// Reads a number member, if present.
template<class Number>
Status readNumber(const Json& job, const char* member, double least, double most, std::optional<Number>& number)
{
    if (!job.contains(member))
        return Done{};
    const Json& value = job[member];
    const bool whole = std::is_integral_v<Number>;
    const bool fits = (whole ? value.is_number_integer() : value.is_number()) && value.get<double>() >= least
        && value.get<double>() <= most;
    if (!fits)
        return expected(member,
                        fmt::format("{} from {:.12g} to {:.12g}", whole ? "a whole number" : "a number", least, most),
                        value);
    number = value.get<Number>();
    return Done{};
}

Status readEnvironment(const Json& job, std::map<std::string, std::string>& environment)
{
    if (!job.contains("env"))
        return Done{};
    const Json& value = job["env"];
    if (!value.is_object())
        return expected("env", "an object of strings such as {\"NAME\": \"VALUE\"}", value);
    for (const auto& [name, text] : value.items()) {
        if (!text.is_string() || text.get<std::string>().find('\0') != std::string::npos)
            return expected("env", "strings without the character 0 (quote numbers, too)", text);
        if (name.empty() || name.find_first_of(std::string_view("=\0", 2)) != std::string::npos)
            return expected("env", "names of variables", name);
        environment[name] = text.get<std::string>();
    }
    return Done{};
}

Status readOptions(const Json& job, JobOptions& options)
{
    std::optional<int> priority;
    for (const Status& read : {readNumber(job, "limit-memory", 0, kMaxMegabytes, options.megabytes),
                               readNumber(job, "limit-time", 0.001, kMaxSeconds, options.seconds),
                               readNumber(job, "limit-processor-time", 0, kMaxSeconds, options.processorSeconds),
                               readNumber(job, "retries", 0, 100, options.retries),
                               readNumber(job, "priority", -kMaxPriority, kMaxPriority, priority),
                               readEnvironment(job, options.environment)})
        if (!read)
            return read;
    options.priority = priority.value_or(0);
    return Done{};
}

Result<Job> readJob(std::string_view line, const CheckWords& check)
{
    const Json parsed = Json::parse(line, nullptr, /*allow_exceptions*/ false);
    if (parsed.is_discarded())
        return inputError("expected a JSON object on one line; found text that is not JSON");
    if (!parsed.is_object())
        return inputError("expected a JSON object; found another JSON value");
    for (const auto& [member, value] : parsed.items())
        if (std::ranges::find(kMembers, member) == std::end(kMembers))
            return inputError(fmt::format("expected {}; found \"{}\"", fmt::join(kMembers, ", "), oneLine(member, 60)));
    const auto command = texts(parsed, "command"), inputs = texts(parsed, "inputs"), outputs = texts(parsed, "outputs");
    for (const auto* list : {&command, &inputs, &outputs})
        if (!*list)
            return list->error();
    if (command->empty())
        return inputError("\"command\": expected a list of strings such as [\"lint\", \"model.glb\"]; found none");
    Job job;
    job.words = *command;
    if (parsed.contains("name")) {
        const Json& name = parsed["name"];
        if (!name.is_string() || name.get<std::string>().empty() || name.get<std::string>().size() > kMaxNameBytes)
            return expected("name", fmt::format("a string of 1 to {} bytes", kMaxNameBytes), name);
        job.name = oneLine(name.get<std::string>(), kMaxNameBytes);
    } else {
        job.name = commandLine(job.words, Shell::posix); // the same on every system, where parts of a batch may run
    }
    if (Status good = check(job); !good)
        return inputError(good.error().message);
    COTAN_CHECK(readOptions(parsed, job.options));
    addNew(job.inputs, *inputs);
    addNew(job.outputs, *outputs);
    return job;
}

} // namespace

std::vector<std::string> Job::key() const
{
    std::vector<std::string> all;
    for (const auto& [variable, value] : options.environment)
        all.push_back(variable + "=" + value);
    all.insert(all.end(), words.begin(), words.end());
    return all;
}

Result<JobList> readJobs(const std::filesystem::path& file, const CheckWords& check)
{
    COTAN_TRY(bytes, readFileBytes(file, kMaxBytes));
    std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (text.starts_with("\xef\xbb\xbf")) // byte order mark of UTF-8
        text.remove_prefix(3);
    JobList list;
    list.folder = std::filesystem::absolute(file).lexically_normal().parent_path();
    std::map<std::string, std::size_t> lines; // by job name
    std::string first;                        // error of the first line that is wrong
    std::size_t wrong = 0;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view one = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (one.find_first_not_of(" \t\r") == std::string_view::npos)
            continue;
        auto job = readJob(one, check);
        if (job) {
            job->line = line;
            const auto [known, isNew] = lines.emplace(job->name, line);
            if (!isNew)
                job = inputError(fmt::format("'{}' is also the name of line {}; expected a different name for each job",
                                             oneLine(job->name, 120), known->second));
        }
        if (job)
            list.jobs.push_back(std::move(*job));
        else if (wrong++ == 0)
            first = fmt::format("{}:{}: {}", file.string(), line, job.error().message);
    }
    if (wrong > 0)
        return inputError(first + (wrong > 1 ? fmt::format(" (and {} more lines are wrong)", wrong - 1) : ""));
    if (list.jobs.empty())
        return inputError(file.string() + ": expected a job in each line; found none");
    return list;
}

} // namespace cotan::app
