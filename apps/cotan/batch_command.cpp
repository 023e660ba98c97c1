#include <algorithm>
#include <memory>
#include <thread>

#include "bake_options.hpp"
#include "batch/report.hpp"
#include "batch/run.hpp"
#include "commands.hpp"
#include "core/try.hpp"
#include "files/file_registry.hpp"
#include "files/output.hpp"
#include "files/system/system.hpp"
#include "loading.hpp"

namespace cotan::app {

namespace {

constexpr Named<Thumbnails> kThumbnails[] = {
    {"none", Thumbnails::none}, {"pictures", Thumbnails::pictures}, {"models", Thumbnails::models}};

struct BatchOptions : CommonOptions {
    std::string jobs, shard;
    std::vector<std::string> stores;
    int processes = 0, rows = 50000, memory = -1; // memory: negative: that of the machine / processes
    bool merge = false;
    RunOptions run; // but for what follows from the machine: runOptions
};

// Sets a job's files and flags from its words, by the declarations of all commands. folder: in which jobs run.
Status setFiles(const Arguments& tool, const std::filesystem::path& folder, Job& job)
{
    COTAN_TRY(given, tool.parse(job.words));
    for (const char* name : {"batch", "view"})
        if (given->name == name)
            return usageError(fmt::format("{} cannot run in a batch", name));
    for (const GivenOption& option : given->options) {
        if (option.name == "threads")
            job.threads = true;
        if (option.name == "json")
            job.json = option.values.back();
        if (option.use == FileUse::reads)
            job.inputs.insert(job.inputs.end(), option.values.begin(), option.values.end());
        const bool isDerived = given->name == "bake" && (option.name == "output" || option.name == "mask");
        if (option.use == FileUse::writes && !isDerived)
            job.outputs.insert(job.outputs.end(), option.values.begin(), option.values.end());
    }
    if (given->name == "bake") {
        COTAN_TRY(outputs, bakeOutputsOf(*given, folder));
        job.outputs.insert(job.outputs.end(), outputs->begin(), outputs->end());
    }
    if (job.json == "-")
        return usageError("--json -: expected a file or no --json, as batch reads the report; found standard output");
    return Done{};
}

RunOptions runOptions(const BatchOptions& o)
{
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    RunOptions run = o.run;
    run.processes = o.processes > 0 ? std::size_t(o.processes) : cores;
    run.threads = int(std::max<std::size_t>(1, (o.threads > 0 ? std::size_t(o.threads) : cores) / run.processes));
    run.megabytes = o.memory >= 0 ? std::size_t(o.memory) : std::size_t(machineMemory() / (1 << 20)) / run.processes;
    return run;
}

std::filesystem::path storeOf(const BatchOptions& o)
{
    if (!o.stores.empty())
        return o.stores.front();
    std::filesystem::path folder = o.output;
    return folder.replace_extension(".store");
}

Status checkUsage(const BatchOptions& o)
{
    if (o.output.empty() && o.stores.empty())
        return usageError("expected -o REPORT.html, or --store FOLDER and no report; found neither");
    if (o.merge && (!o.shard.empty() || o.run.again))
        return usageError(
            fmt::format("--merge runs nothing: expected no {} with it", o.run.again ? "--again" : "--shard"));
    if (o.merge && o.output.empty() && o.json.empty())
        return usageError("--merge: expected -o REPORT.html or --json FILE; found neither");
    if (!o.merge && o.stores.size() > 1)
        return usageError("--store: expected one folder (several with --merge); found several");
    return Done{};
}

Result<std::vector<JobResult>> results(const BatchOptions& o, const JobList& list, const Plan& plan, const Shard& shard)
{
    if (o.merge) {
        std::vector<Store> stores;
        for (const std::string& folder : o.stores.empty() ? std::vector{storeOf(o).string()} : o.stores) {
            COTAN_TRY(store, Store::openToRead(folder, COTAN_VERSION));
            stores.push_back(std::move(*store));
        }
        return collect(list, plan, stores);
    }
    COTAN_TRY(store, Store::open(storeOf(o), COTAN_VERSION));
    const std::vector<std::size_t> chosen = jobsOf(plan, shard);
    return withProgress(o, 1, "jobs of " + o.jobs, [&](const Progress& progress) {
        return runJobs(list, plan, chosen, *store, runOptions(o), progress);
    });
}

// The worst result, as the status for the exit code. Jobs over a limit matter only where all others are done.
Status verdict(const JobList& list, const std::vector<JobResult>& all)
{
    const auto bad = [](const JobResult& result) { return !isGood(result.record); };
    const auto over = [](const JobResult& result) { return result.record.state == JobState::limit; };
    const auto failed = std::ranges::count_if(all, bad), limited = std::ranges::count_if(all, over);
    for (const std::size_t i : worstFirst(all)) {
        if (failed > 0 ? !bad(all[i]) : !over(all[i]))
            continue;
        return Error{failed > 0 ? ErrorKind::input : ErrorKind::limit,
                     fmt::format("{} of {} jobs are {}; the worst is '{}': {}", failed > 0 ? failed : limited,
                                 all.size(), failed > 0 ? "not done" : "over a limit", list.jobs[all[i].job].name,
                                 all[i].record.reason)};
    }
    return Done{};
}

// Jobs guard their own inputs. The batch's own outputs must replace no file of a job, and no job the list of jobs or
// the batch's outputs.
Status guardFiles(const JobList& list)
{
    for (const Job& job : list.jobs)
        for (const std::string& output : job.outputs)
            COTAN_CHECK(checkOutput(fmt::format("line {}:", job.line), list.folder / output));
    for (const Job& job : list.jobs)
        for (const std::string& input : job.inputs)
            COTAN_CHECK(noteInput(list.folder / input));
    return Done{};
}

// Likewise, with the files that are known only after a job has run.
Status guardFiles(const JobList& list, const std::vector<JobResult>& results)
{
    for (const JobResult& result : results)
        for (const auto* files : {&result.record.inputs, &result.record.outputs})
            for (const FileState& file : *files)
                COTAN_CHECK(noteInput(list.folder / file.file));
    return Done{};
}

Status run(const Arguments& tool, const BatchOptions& o)
{
    COTAN_CHECK(checkUsage(o));
    COTAN_TRY(shard, parseShard(o.shard.empty() ? "1/1" : o.shard));
    COTAN_CHECK(beginOutputs(o, {{"-o", o.output}}, /*again*/ true));
    Stopwatch watch;
    const std::filesystem::path base = std::filesystem::absolute(o.jobs).parent_path();
    COTAN_TRY(list, readJobs(o.jobs, [&](Job& job) { return setFiles(tool, base, job); }));
    const auto plan = planJobs(*list);
    if (!plan)
        return inputError(fmt::format("{}: {}", o.jobs, plan.error().message));
    COTAN_CHECK(guardFiles(*list));
    COTAN_TRY(all, results(o, *list, *plan, *shard));
    COTAN_CHECK(guardFiles(*list, *all));
    const double seconds = watch.lap();
    const std::string summary = summaryOf(*all) + fmt::format("; {:.1f} s", seconds);
    if (!o.output.empty()) {
        const std::string title = fmt::format("{}{}", o.jobs, o.shard.empty() ? "" : ", shard " + o.shard);
        const auto folder = std::filesystem::absolute(o.output).lexically_normal().parent_path();
        const std::string page =
            batchPage(*list, *all, title, "cotan " COTAN_VERSION ": " + summary, folder, std::size_t(o.rows));
        COTAN_CHECK(writeFileWhole(o.output, page));
    }
    say(o, "{}{}", summary, o.output.empty() ? "" : "; report: " + o.output.string());
    Json j = batchJson(*list, *all);
    j["jobs_file"] = o.jobs;
    j["shard"] = o.shard;
    j["seconds"] = seconds;
    COTAN_CHECK(writeReport(o, j));
    return verdict(*list, *all);
}

void declare(Arguments& a, BatchOptions& o)
{
    a.option("JOBS", o.jobs,
             "file with a job in each line: {\"name\": \"rock\", \"command\": [\"lint\", \"rock.glb\"]}")
        .required()
        .reads();
    a.group(HelpGroup::jobs);
    a.option("--jobs", o.processes, "jobs to run at a time, which share --threads; 0: one per core")
        .within(0, 4096)
        .in("N")
        .main();
    a.option("--store", o.stores, "folder that keeps results; default: beside the report. Several with --merge")
        .in("FOLDER")
        .writes()
        .main();
    a.option("--shard", o.shard, "run part K of N, for farms; jobs that use each other's files stay together")
        .in("K/N");
    a.flag("--merge", o.merge, "run nothing; report what the stores hold");
    a.flag("--again", o.run.again, "run all jobs, also those whose results are kept");
    a.option("--limit-time,--limit-seconds", o.run.seconds, "elapsed time that a job may take").above0().in("S");
    a.option("--limit-processor-time", o.run.processorSeconds,
             "processor time that the process of a job may take, summed over its threads, whatever else the machine "
             "does; whole seconds; 0: no limit")
        .within(0.0, 1e6)
        .in("S");
    a.option("--retries", o.run.retries,
             "how often to retry a job that a limit or a signal ended, or that ended with exit code 3 or 4")
        .within(0, 100)
        .in("N");
    a.option("--limit-memory", o.memory,
             "memory that a process of a job may take, in MiB; 0: no limit; default: the machine's, divided by --jobs")
        .within(0, 1 << 24)
        .in("MIB")
        .withoutDefault();
    a.group(HelpGroup::output);
    a.option("--rows", o.rows, "maximum number of jobs that the page shows, the worst ones; --json has all")
        .within(1, 250000)
        .in("N");
    a.choice("--thumbnails", o.run.thumbnails, kThumbnails,
             "pictures: of the first image that a job writes; models: otherwise a render of the model that it reads; "
             "none");
}

} // namespace

void addBatchCommand(Arguments& tool)
{
    Arguments command = tool.command("batch", "Run many commands, keep their results, and show the worst first.");
    const auto options = std::make_shared<BatchOptions>();
    addCommonOptions(command, *options, "the report: a page with all jobs, worst first");
    declare(command, *options);
    addExamples(command,
                {"cotan batch jobs.jsonl --jobs 2 -o report.html",
                 "cotan batch jobs.jsonl --shard 3/8 --store results --limit-time 600",
                 "cotan batch jobs.jsonl --merge --store results -o report.html"});
    command.does([options, &tool] { return run(tool, *options); });
}

} // namespace cotan::app
