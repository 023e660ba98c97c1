#include "batch/run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "core/one_line.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"
#include "files/sandbox/request.hpp"
#include "files/system/system.hpp"

namespace cotan::app {

namespace fs = std::filesystem;

namespace {

constexpr auto kRetryDelay = std::chrono::milliseconds(200); // while all remaining jobs run in other processes
constexpr auto kFileClockStep = std::chrono::milliseconds(1);
constexpr std::size_t kMaxReportBytes = std::size_t(256) << 20;

struct Running {
    std::size_t job;
    fs::path work;
    std::unique_ptr<JobProcess> process;
    Claim claim;
    std::int64_t began; // by fileClockNanoseconds()
};

// The file name for records: relative to the folder of the jobs if it is inside.
std::string nameOf(const fs::path& folder, const std::string& file)
{
    const fs::path path = (folder / file).lexically_normal();
    const fs::path relative = path.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != ".." ? relative.string() : path.string();
}

// The last error message of a command, or its last line.
std::string lastMessage(const std::string& output)
{
    constexpr std::string_view kError = "cotan: error: ";
    if (const std::size_t at = output.rfind(kError); at != std::string::npos)
        return oneLine(output.substr(at + kError.size(), output.find('\n', at) - at - kError.size()), 400);
    const std::size_t end = output.find_last_not_of(" \n\r\t");
    if (end == std::string::npos)
        return "it printed nothing";
    const std::size_t begin = output.rfind('\n', end);
    return oneLine(output.substr(begin == std::string::npos ? 0 : begin + 1, end - begin), 400);
}

// The record of a job that did not run.
JobRecord recordWithoutRun(JobState state, std::string reason, std::optional<int> code = std::nullopt)
{
    JobRecord record;
    record.state = state;
    record.code = code;
    record.reason = std::move(reason);
    return record;
}

// The record of a job that depends on a finished one that is not good; nullopt: it depends on none.
std::optional<JobRecord> skippedRecord(const JobList& list, const Plan& plan, const std::vector<JobResult>& results,
                                       std::size_t job)
{
    for (const std::size_t need : plan.needs[job])
        if (const JobRecord& r = results[need].record; r.state != JobState::notRun && !isGood(r))
            return recordWithoutRun(JobState::skipped,
                                    fmt::format("waits for '{}', which is not done", list.jobs[need].name));
    return std::nullopt;
}

// Whether the files of a record are as they were when it was made.
bool holds(FileStates& states, const JobRecord& record)
{
    return std::ranges::all_of(std::array{&record.inputs, &record.outputs}, [&](const auto* files) {
        return std::ranges::all_of(*files, [&](const FileState& file) { return states.holds(file, record.at); });
    });
}

// The options of the batch with those of one job.
RunOptions optionsOf(RunOptions all, const JobOptions& own)
{
    all.seconds = own.seconds.value_or(all.seconds);
    all.processorSeconds = std::ceil(own.processorSeconds.value_or(all.processorSeconds));
    all.megabytes = own.megabytes.value_or(all.megabytes);
    all.retries = own.retries.value_or(all.retries);
    return all;
}

// Sets the state, the code and the reason.
void judge(const Ending& ending, const RunOptions& limits, JobRecord& record)
{
    const std::string words = lastMessage(record.output);
    const auto is = [&](JobState state, std::string reason) {
        record.state = state;
        record.reason = std::move(reason);
    };
    if (ending.lost) {
        record.code = int(ErrorKind::unavailable);
        return is(JobState::failed, "it ended, but how is unknown: the system has discarded its exit code");
    }
    record.code = ending.code;
    if (ending.signal != 0)
        record.signal = ending.signal;
    const bool noMemory =
        ending.code == kNoMemoryCode || (!ending.code && record.output.find("bad_alloc") != std::string::npos);
    if (ending.late)
        return is(JobState::late, fmt::format("took longer than {:.4g} s and was terminated", limits.seconds));
    if (ending.overWorked)
        return is(JobState::late,
                  fmt::format("took more than {:.4g} s of processor time and was terminated", limits.processorSeconds));
    if (noMemory && limits.megabytes > 0)
        return is(JobState::memory, fmt::format("needed more memory than {} MiB", limits.megabytes));
    if (noMemory)
        return is(JobState::memory, "needed more memory than is available");
    if (ending.killed)
        return is(JobState::crashed,
                  fmt::format("was killed ({}) with {:.0f} MiB in use, perhaps out of memory",
                              ending.crash.substr(0, ending.crash.find(',')), record.megabytes));
    if (!ending.code)
        return is(JobState::crashed,
                  fmt::format("crashed ({}) with {:.0f} MiB in use: {}", ending.crash, record.megabytes, words));
    if (*ending.code == 0)
        return is(JobState::done, "");
    is(*ending.code == int(ErrorKind::limit) ? JobState::limit : JobState::failed, words);
}

// Runs a batch in one thread, which starts processes, waits for them, and stores their results.
class Run {
public:
    Run(const JobList& list, const Plan& plan, std::span<const std::size_t> chosen, Store& store,
        const RunOptions& options, const Progress& progress)
        : list_(list), plan_(plan), chosen_(chosen), store_(store), options_(options), states_(list.folder),
          results_(list.jobs.size()), waitsFor_(list.jobs.size()), waiting_(list.jobs.size()), runs_(list.jobs.size()),
          steps_(progress, chosen.size())
    {
        // A job has at least the priority of the jobs that wait for it.
        for (const Job& job : list.jobs)
            priorities_.push_back(job.options.priority);
        for (auto job = plan.order.rbegin(); job != plan.order.rend(); ++job)
            for (const std::size_t need : plan.needs[*job])
                priorities_[need] = std::max(priorities_[need], priorities_[*job]);
        for (const std::size_t job : chosen) {
            waitsFor_[job] = plan.needs[job].size();
            for (const std::size_t need : plan.needs[job])
                waiting_[need].push_back(job);
            if (waitsFor_[job] == 0)
                addReady(job);
        }
    }

    Result<std::vector<JobResult>> all()
    {
        while (finished_ < chosen_.size()) {
            COTAN_CHECK(start());
            COTAN_CHECK(wait());
            if (steps_.stopped())
                return stoppedError();
        }
        std::vector<JobResult> results;
        for (const std::size_t job : chosen_)
            results.push_back(std::move(results_[job]));
        return results;
    }

private:
    void addReady(std::size_t job) { ready_.emplace(priorities_[job], job); }

    // Starts as many jobs as may run at a time.
    Status start()
    {
        const std::size_t most = std::max<std::size_t>(options_.processes, 1);
        std::vector<std::size_t> elsewhere; // claimed by other processes
        Status status = Done{};
        while (status && running_.size() < most && !ready_.empty() && !steps_.stopped()) {
            const std::size_t job = ready_.extract(ready_.begin()).mapped();
            if (auto skipped = skippedRecord(list_, plan_, results_, job)) {
                finish(job, std::move(*skipped), /*kept*/ false);
            } else if (auto kept = keptOf(job)) {
                finish(job, std::move(*kept), /*kept*/ true);
            } else if (auto claim = store_.claim(list_.jobs[job].key())) {
                // Another process may have finished the job meanwhile.
                if (auto done = keptOf(job))
                    finish(job, std::move(*done), true);
                else
                    status = begin(job, std::move(*claim));
            } else {
                elsewhere.push_back(job);
            }
        }
        for (const std::size_t job : elsewhere)
            addReady(job);
        return status;
    }

    std::optional<JobRecord> keptOf(std::size_t job)
    {
        auto record = options_.again ? std::nullopt : store_.find(list_.jobs[job].key());
        return record && repeatable(*record) && holds(states_, *record) ? record : std::nullopt;
    }

    Status begin(std::size_t job, Claim claim)
    {
        const Job& requested = list_.jobs[job];
        COTAN_TRY(folder, store_.workFolder());
        ChildRequest request;
        request.work = *folder / std::to_string(job);
        std::error_code ignored;
        COTAN_CHECK(makeFolder(request.work));
        for (const std::string& output : requested.outputs)
            if (const fs::path within = (list_.folder / output).parent_path(); !isPattern(within.string()))
                fs::create_directories(within, ignored); // else the command reports it
        request.parent = thisProcess();
        const RunOptions limits = optionsOf(options_, requested.options);
        request.megabytes = limits.megabytes;
        request.processorSeconds = std::size_t(limits.processorSeconds);
        request.thumbnails = options_.thumbnails;
        request.words = requested.words;
        if (!requested.threads)
            request.words.insert(request.words.end(), {"--threads", std::to_string(options_.threads)});
        if (requested.json.empty())
            request.words.insert(request.words.end(), {"--json", (request.work / kReportName).string()});
        // Waits until the file clock has passed the last write of the files that it reads: they then have earlier
        // times, and files that change while it runs do not.
        std::int64_t written = began_;
        for (const std::size_t need : plan_.needs[job])
            if (!results_[need].kept) // the clock of another machine may be ahead
                written = std::max(written, results_[need].record.at);
        while (fileClockNanoseconds() <= written)
            std::this_thread::sleep_for(kFileClockStep);
        const std::int64_t began = fileClockNanoseconds();
        auto process =
            JobProcess::start(options_.program, list_.folder, request, requested.options.environment, limits.seconds);
        ++runs_[job];
        if (!process) {
            const Error& error = process.error();
            finish(job, recordWithoutRun(JobState::failed, error.message, int(error.kind)), /*kept*/ false);
            return Done{};
        }
        running_.push_back({job, request.work, std::move(*process), std::move(claim), began});
        return Done{};
    }

    // Waits briefly for processes to print or end, and handles those that ended.
    Status wait()
    {
        if (running_.empty()) {
            if (!ready_.empty() && finished_ < chosen_.size())
                std::this_thread::sleep_for(kRetryDelay);
            return Done{};
        }
        std::vector<JobProcess*> processes;
        for (const Running& r : running_)
            processes.push_back(r.process.get());
        JobProcess::waitForOne(processes);
        for (auto at = running_.begin(); at != running_.end();) {
            const pid_t number = at->process->number();
            const auto ending = at->process->look();
            if (!ending) {
                ++at;
                continue;
            }
            const std::size_t job = at->job;
            JobRecord record = recordOf(*at, number, *ending);
            std::error_code ignored;
            fs::remove_all(at->work, ignored);
            const bool retry =
                !repeatable(record) && runs_[job] <= optionsOf(options_, list_.jobs[job].options).retries;
            Status kept = retry ? Done{} : store_.keep(list_.jobs[job].key(), record);
            running_.erase(at++); // also releases its claim
            if (retry)
                addReady(job);
            else
                finish(job, std::move(record), false);
            if (!kept)
                return kept;
        }
        return Done{};
    }

    JobRecord recordOf(const Running& r, pid_t number, const Ending& ending)
    {
        const Job& job = list_.jobs[r.job];
        JobRecord record = ending.record;
        record.runs = runs_[r.job];
        judge(ending, optionsOf(options_, job.options), record);
        if (!ending.code || record.state == JobState::memory)
            for (const std::string& output : job.outputs)
                removeParts((list_.folder / output).parent_path(), number);
        const fs::path report = job.json.empty() ? r.work / kReportName : list_.folder / job.json;
        if (isGood(record))
            if (const auto text = readText(report, /*isInput*/ false, kMaxReportBytes))
                record.degrees = degreesIn(*text);
        ChildAnswer answer = readAnswer(r.work);
        record.thumbnail = std::move(answer.thumbnail);
        record.at = nowNanoseconds();
        record.outputs = statesOf(answer.outputs, r.work);
        answer.inputs.insert(answer.inputs.end(), job.inputs.begin(), job.inputs.end());
        record.inputs = statesOf(answer.inputs, r.work);
        // Files that it also writes are no inputs. An input that changed during the run leads to another run next time.
        std::erase_if(record.inputs, [&](const FileState& input) {
            return std::ranges::find(record.outputs, input.file, &FileState::file) != record.outputs.end();
        });
        for (FileState& input : record.inputs)
            if (input.changed >= r.began)
                input.digest = "changed while it was read";
        return record;
    }

    std::vector<FileState> statesOf(const std::vector<std::string>& files, const fs::path& work)
    {
        std::set<std::string> names;
        for (const std::string& file : files)
            if (!(list_.folder / file).lexically_normal().string().starts_with(work.string()))
                names.insert(nameOf(list_.folder, file));
        std::vector<FileState> states;
        for (const std::string& name : names)
            states.push_back(states_.of(name));
        return states;
    }

    void finish(std::size_t job, JobRecord record, bool kept)
    {
        results_[job] = {job, std::move(record), kept};
        ++finished_;
        steps_.step();
        for (const std::size_t next : waiting_[job])
            if (--waitsFor_[next] == 0)
                addReady(next);
    }

    const JobList& list_;
    const Plan& plan_;
    const std::span<const std::size_t> chosen_;
    Store& store_;
    const RunOptions& options_;
    FileStates states_;
    std::vector<JobResult> results_;                // of all jobs, by index
    std::vector<std::size_t> waitsFor_;             // per job: number of unfinished jobs it waits for
    std::vector<std::vector<std::size_t>> waiting_; // per job: jobs that wait for it
    std::vector<int> runs_;                         // per job: number of starts by this process
    std::vector<int> priorities_;
    std::multimap<int, std::size_t, std::greater<>> ready_; // by priority, then in the order in which they became ready
    std::list<Running> running_;
    const std::int64_t began_ = nowNanoseconds();
    std::size_t finished_ = 0;
    CountedSteps steps_;
};

} // namespace

Result<std::vector<JobResult>> runJobs(const JobList& list, const Plan& plan, std::span<const std::size_t> chosen,
                                       Store& store, const RunOptions& options, const Progress& progress)
{
    return Run(list, plan, chosen, store, options, progress).all();
}

std::vector<JobResult> collect(const JobList& list, const Plan& plan, std::span<const Store> stores)
{
    FileStates states(list.folder);
    std::vector<JobResult> results;
    for (std::size_t job = 0; job < list.jobs.size(); ++job) {
        results.push_back(
            {job, recordWithoutRun(JobState::notRun, "no store has a result for these inputs"), /*kept*/ false});
        JobRecord& newest = results.back().record;
        for (const Store& store : stores)
            if (auto record = store.find(list.jobs[job].key());
                record && record->at > newest.at && holds(states, *record))
                newest = std::move(*record);
    }
    for (const std::size_t job : plan.order)
        if (results[job].record.state == JobState::notRun)
            if (auto skipped = skippedRecord(list, plan, results, job))
                results[job].record = std::move(*skipped);
    return results;
}

} // namespace cotan::app
